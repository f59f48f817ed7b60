#pragma once

#include "verification/checks/candidate.h"
#include "verification/checks/verdict.h"
#include "verification/report/sweep_inputs.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace irradiff {

/// Relative errors, norm-wise, of one formula over the inputs of one size.
struct SweepPoint {
  double size = 0.0;
  double median = 0.0;
  double peak = 0.0;   ///< infinite where the formula gave NaN or an exception
  double bound = 0.0;  ///< largest claimed relative bound; 0 if none is claimed
};

struct SweepCurve {
  std::string formula;
  Quantity quantity = Quantity::kGradient;
  std::vector<SweepPoint> points;
};

/// Error against size, for gradient and Hessian of each formula, against 200-digit values.
struct ErrorSweep {
  const SweepInputs* inputs = nullptr;
  std::size_t samples_for_each_size = 0;
  std::vector<SweepCurve> curves;
  std::vector<Verdict> verdicts;  ///< of the promised formula: its promise and its claimed bounds
  std::vector<Verdict> unjudged;  ///< its errors where it promises its claimed bound alone
};

/// `promised` is held to the sweep's promises and to its own bounds, the others are for comparison. Two sizes a decade.
ErrorSweep sweepErrors(const SweepInputs& inputs, const Candidate& promised, const std::vector<Candidate>& comparisons,
                       std::size_t samples_for_each_size, std::uint64_t seed);

}  // namespace irradiff
