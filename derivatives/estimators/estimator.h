#pragma once

#include "derivatives/estimators/irradiance_estimate.h"
#include "derivatives/samples/hemisphere_samples.h"

#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace irradiff {

/// An estimator of irradiance derivatives for one stratification and shape, with the tables that depend on nothing
/// else. `estimate` may be called from several threads at once.
class Estimator {
 public:
  virtual ~Estimator() = default;
  Estimator(const Estimator&) = delete;
  Estimator& operator=(const Estimator&) = delete;

  /// Requires samples of the stratification and shape that the estimator was made for, and that meet HemisphereSamples'
  /// conditions. An estimator of makeEstimator throws std::invalid_argument naming both grids if they differ, and
  /// std::overflow_error naming the nearest and the brightest sample if a number is beyond the range of double: every
  /// number that it returns is finite.
  virtual IrradianceEstimate estimate(const HemisphereSamples& samples) const = 0;

 protected:
  Estimator() = default;
};

/// An estimator by its name, as on the command line.
struct EstimatorDescription {
  std::string_view name;
  std::string_view source;  ///< paper and equation
};

/// In the order of tables.
std::span<const EstimatorDescription> estimatorDescriptions();

/// Throws std::invalid_argument naming the estimator, the stratification or the shape and the rule: an unknown name
/// (the message lists those that exist), or a stratification that the estimator does not work with.
std::unique_ptr<Estimator> makeEstimator(std::string_view name, Stratification stratification, GridShape shape);

}  // namespace irradiff
