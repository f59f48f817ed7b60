#pragma once

#include "verification/checks/candidate.h"

#include <cstddef>
#include <string>
#include <vector>

namespace irradiff {

/// The outcome of one check of one quantity over one family of inputs, polygons or whole scenes.
struct Verdict {
  std::string candidate;
  std::string check;   ///< oracle or invariant
  std::string family;  ///< family of inputs
  Quantity quantity = Quantity::kFormFactor;
  bool passed = false;
  std::size_t inputs = 0;
  std::size_t wrong_inputs = 0;  ///< how many of them miss the tolerance
  double peak =
      0.0;  ///< largest error, relative to the max norm of the expected value (to that of the summands for closure)
  double rms = 0.0;
  double uncertainty =
      0.0;  ///< largest of the oracle's own, in the same unit; what exceeds it counts against the candidate
  double tolerance = 0.0;   ///< what the peak may be, above the oracle's own uncertainty
  std::string rule;         ///< where the tolerance comes from, and what errors are relative to if to something else
  std::string worst_input;  ///< a scene file of one line: what `irradiff evaluate` reads
  std::string worst_input_in_words;
  std::string expected;  ///< at the worst input
  std::string actual;
  std::string worst_entry;   ///< of a vector or matrix: "x", "x, y"; of what is in the tangent plane "t, b"
  std::string likely_cause;  ///< what usually makes this check fail; empty if it passed, or if nothing is recognised
  /// How many wrong inputs look like the cause; 0 if it is only what usually makes this check fail.
  std::size_t inputs_of_cause = 0;
};

/// Several lines like a compiler's message: what failed, where, expected, actual, how far, what usually causes it, and
/// a command to repeat it. One line if it passed.
std::string describe(const Verdict& verdict);

/// For people: how many checks failed; one message for each quantity, with the names of further checks that found the
/// same; a line for each check that failed otherwise; and the checks that passed. Ends with a new line.
std::string summarize(const std::vector<Verdict>& verdicts);

/// Those that failed.
std::vector<Verdict> failures(const std::vector<Verdict>& verdicts);

}  // namespace irradiff
