#pragma once

#include "verification/checks/candidate.h"

#include <cstddef>
#include <string>
#include <vector>

namespace irradiff {

/// The outcome of one check of one quantity over one family of inputs.
struct Verdict {
  std::string candidate;
  std::string check;   ///< oracle or invariant
  std::string family;  ///< family of inputs
  Quantity quantity = Quantity::kFormFactor;
  bool passed = false;
  std::size_t inputs = 0;
  double peak =
      0.0;  ///< largest error, relative to the max norm of the expected value (to that of the summands for closure)
  double rms = 0.0;
  double uncertainty =
      0.0;  ///< largest of the oracle's own, in the same unit; what exceeds it counts against the candidate
  double tolerance = 0.0;   ///< what the peak may be, above the oracle's own uncertainty
  std::string rule;         ///< where the tolerance comes from
  std::string worst_input;  ///< a scene file of one line: what `irradiff evaluate` reads
  std::string expected;     ///< at the worst input
  std::string actual;
  std::string likely_cause;  ///< what usually makes this check fail; empty if it passed
};

/// Several lines like a compiler's message: what failed, where, expected, actual, how far, what usually causes it, and
/// a line to reproduce it.
std::string describe(const Verdict& verdict);

/// Those that failed.
std::vector<Verdict> failures(const std::vector<Verdict>& verdicts);

}  // namespace irradiff
