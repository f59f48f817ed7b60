#pragma once

#include "experiments/figures/derivative_map.h"
#include "experiments/figures/estimate_map.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace irradiff {

/// What of an estimate is compared with the truth, norm-wise.
enum class Compared {
  kGradient,     ///< dE/dx and dE/dy: those that all estimators of a gradient know
  kHessian,      ///< the tangential Hessian
  kEigenvalues,  ///< of the Hessian in space
};

struct ComparedQuantity {
  Compared compared;
  const char* name;  ///< of channels, "gradient"
  const char* unit;  ///< of the quantity itself
  std::vector<EstimateValue> values;
  std::vector<const char*> truth;  ///< the channels of a DerivativeMap
  const char* bound;               ///< and that of the truth's own error
};
const ComparedQuantity& quantityOf(Compared compared);
inline constexpr std::array<Compared, 3> kAllCompared{Compared::kGradient, Compared::kHessian, Compared::kEigenvalues};

/// The relative error max|estimate - truth| / max|truth| at each receiver, over the components of the quantity. NaN
/// where the truth does not exist, where it is 0 to within its own error bound, and where there is no estimate.
std::vector<double> relativeErrors(const EstimateMap& estimate, const DerivativeMap& truth, Compared compared);

/// That of one estimate, the truth being at `place` of its map.
double relativeError(const EstimateValues& estimate, const DerivativeMap& truth, std::size_t place, Compared compared);

/// Whether the estimator has this quantity at all.
bool knows(const EstimateMap& estimate, Compared compared);

/// The errors over a map.
struct ErrorSummary {
  std::size_t compared = 0;     ///< receivers
  std::size_t no_truth = 0;     ///< those left out as the truth does not exist
  std::size_t zero_truth = 0;   ///< or is 0 to within its error bound
  std::size_t no_estimate = 0;  ///< or the estimator gave none
  double median = 0.0;          ///< of the relative error
  double percentile99 = 0.0;    ///< likewise: 99 % of the receivers have at most this
  double rms = 0.0;             ///< root mean square of max|estimate - truth| over that of max|truth|
};
/// All three are NaN where nothing can be compared.
ErrorSummary summarise(const EstimateMap& estimate, const DerivativeMap& truth, Compared compared);

/// The value below which a share of the sorted values lies, the least one that has it. Requires values.
double percentile(const std::vector<double>& sorted, double share);

/// An error as people read it, two digits.
std::string errorNumber(double error);

}  // namespace irradiff
