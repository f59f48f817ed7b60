#pragma once

#include "experiments/cache/record_field.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace irradiff::cache_test {

/// Height and width of one Gaussian in the plane.
struct Bump {
  Eigen::Vector2d middle;
  double height;  ///< W/m^2
  double width;   ///< standard deviation, m
};

/// E and its derivatives in closed form.
struct PlaneIrradiance {
  double irradiance;
  Eigen::Vector2d gradient;
  Eigen::Matrix2d hessian;
};

/// 1 W/m^2 and the bumps.
PlaneIrradiance bumpyIrradiance(const std::vector<Bump>& bumps, const Eigen::Vector2d& position);

/// Four bumps in the unit square, of different heights and widths.
std::vector<Bump> fourBumps();

/// `width` x `width` receivers in the middles of the pixels of the unit square of z = 0, normals along z, rows along x
/// with growing y. Irradiance has the bumps, so that everything is known without a scene. Metrics:
///
/// - "hessian": errorEllipse of the Hessian at the record, with the options of the choice;
/// - "steep": the same with the 16th power of the threshold, "flat": with its 16th root;
/// - "circle": circles with the threshold as their radius, m;
/// - "bright": circles with the threshold times E as their radius, m.
///
/// All of them keep the limits of the choice.
RecordField bumpyField(std::size_t width, const std::vector<Bump>& bumps = fourBumps());

/// E = c + a.x + v.n, of which both gradients are known: a and n x v.
struct AffineIrradiance {
  double constant = 2.0;
  Eigen::Vector3d slope = Eigen::Vector3d(0.3, -0.2, 0.5);
  Eigen::Vector3d source = Eigen::Vector3d(0.2, 0.4, 0.6);  ///< a distant lamp's direction times its irradiance

  double at(const Receiver& receiver) const;
  /// With a circle of this radius.
  CacheRecord record(const Receiver& receiver, double radius) const;
};

/// Receivers on a cap of the unit sphere about z, up to 60 degrees from it, `width` x `width` pixels seen along -z.
/// Metric "circle" as above. Pixels beside the cap have no receiver.
RecordField capField(std::size_t width, const AffineIrradiance& irradiance);

/// A choice that leaves all but these as it is.
MetricChoice choiceOf(const std::string& metric, double threshold);

/// What std::invalid_argument says that the action throws; "nothing refused" if it throws none.
std::string refusal(const std::function<void()>& action);

}  // namespace irradiff::cache_test
