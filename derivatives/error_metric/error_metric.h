#pragma once

#include "derivatives/error_metric/error_ellipse.h"

#include <Eigen/Core>

#include <limits>
#include <optional>
#include <span>
#include <string_view>

namespace irradiff {

/// What is known of a cache record when its region is chosen. Who made it decides what the metric is worth: the Hessian
/// of an estimator, or that of the scene.
struct RecordDerivatives {
  Irradiance<double> irradiance;
  std::optional<Eigen::Vector2d> tangential_gradient;  ///< in the frame of the Hessian; W/m^3
  std::optional<TangentialHessian<double>> tangential_hessian;
  std::optional<double> harmonic_mean_distance;  ///< m; infinite where nothing is near
};

/// The same in flatland, along the tangent.
struct FlatlandRecordDerivatives {
  Irradiance<double> irradiance;                 ///< W/m
  std::optional<double> tangential_gradient;     ///< W/m^2
  std::optional<double> tangential_hessian;      ///< W/m^3
  std::optional<double> harmonic_mean_distance;  ///< m; infinite where nothing is near
};

/// A metric by its name, as on the command line and in Figure 1 of [Schwarzhaupt et al. 2012].
struct ErrorMetricDescription {
  std::string_view name;
  std::string_view source;     ///< paper and equation
  std::string_view estimator;  ///< the published one of the derivatives that it takes; empty: none
  bool takes_distance;
  bool takes_gradient;
  bool takes_hessian;
};

/// In the order of tables.
std::span<const ErrorMetricDescription> errorMetricDescriptions();

struct ErrorMetricOptions {
  double threshold = 0.0;  ///< unit: see errorEllipse; of the split-sphere metrics the share of the distance, 1
  EllipseOptions ellipse;  ///< of the Hessian metrics
  /// Limits of every half-axis, the last word of every metric; m.
  double smallest_radius = 0.0;
  double largest_radius = std::numeric_limits<double>::infinity();
};

/// An error metric of irradiance caching: from a record's derivatives to where it may be used.
///
/// The split-sphere metrics give circles with the radius eps R. Of `split-sphere` R is the harmonic mean distance
/// (Ward, Rubinstein, Clear 1988); `bounded-split-sphere` takes the lesser of that and E/|grad E|, over which the
/// irradiance changes by its own size (Křivánek and Gautron 2009), and needs limits of the radius. The Hessian metrics
/// share errorEllipse and differ in whose Hessian they are meant for. docs/derivations/error_metrics.md.
class ErrorMetric {
 public:
  /// Throws std::invalid_argument naming the thing, its value and the rule: an unknown metric (with the names that
  /// there are), a threshold that is not finite or not positive, an aspect below 1, the printed ellipse for the mean
  /// error, limits that are not 0 <= smallest <= largest with largest > 0, and for bounded-split-sphere limits that are
  /// not positive and finite.
  ErrorMetric(std::string_view name, const ErrorMetricOptions& options);

  const ErrorMetricDescription& description() const { return *description_; }

  /// Half-axes are positive; infinite where nothing limits them: a Hessian of zero, whatever the irradiance, or an
  /// infinite distance. Throws std::invalid_argument naming the quantity if the record lacks what the metric takes, or
  /// has a negative irradiance, a distance that is not positive or a number that is not finite; as errorEllipse does
  /// where the irradiance is 0 and the Hessian not; and std::range_error naming threshold and metric if a half-axis is
  /// too small for double.
  ValidRegion region(const RecordDerivatives& record) const;

  /// In flatland: half the length of the interval about the record, by errorInterval; rule and aspect of the ellipse do
  /// not matter. m. Positive, infinite and throws as `region`.
  double halfLength(const FlatlandRecordDerivatives& record) const;

 private:
  double splitSphereRadius(const RecordDerivatives& record) const;
  double limited(double radius) const;

  const ErrorMetricDescription* description_;
  ErrorMetricOptions options_;
};

}  // namespace irradiff
