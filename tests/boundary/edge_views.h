#pragma once

#include "derivatives/boundary/double_word.h"
#include "derivatives/boundary/vector.h"
#include "verification/checks/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace irradiff {

/// An edge as a receiver sees it: its ends relative to the receiver, and their heights over the horizon, at least 0.
struct EdgeView {
  Vector3<double> start, end;
  double start_height, end_height;
  Vector3<double> normal;
  double angle;  ///< radians
};

/// What an EdgeView is made of: 0, 1 the angles of the ends from the foot of the perpendicular, through tanh; 2 to 5 a
/// rotation; 6 log2 of the distance to the line; 7, 8 heights of the ends, none where negative; 9 the normal's part
/// along the arc's plane normal, through sinh.
using EdgeParameters = std::array<double, 10>;

/// Roughly normally distributed.
inline double bellShaped(KeyedRandom& random) {
  return random.between(-1.0, 1.0) + random.between(-1.0, 1.0) + random.between(-1.0, 1.0);
}

inline EdgeParameters drawEdgeParameters(KeyedRandom& random) {
  EdgeParameters parameters{};
  for (double& parameter : parameters) {
    parameter = bellShaped(random);
  }
  parameters[6] *= 3.0;
  if (random.below(3) == 0) {
    // A long arc with the foot between its ends.
    parameters[0] = -std::abs(parameters[0]) - 0.4;
    parameters[1] = std::abs(parameters[1]) + 0.4;
  }
  if (random.below(4) == 0) {
    parameters[1] = parameters[0] + random.decade(-5.0, -1.0);
  }
  if (random.below(3) == 0) {
    parameters[7 + random.below(2)] = 0.0;
  }
  return parameters;
}

/// Nothing for an arc too short to be drawn exactly or wholly on the horizon, or a parameter beyond 64.
inline std::optional<EdgeView> edgeView(const EdgeParameters& parameters) {
  using Eigen::Vector3d;
  const double kNearlyQuarterTurn = 0.5 * std::numbers::pi - 1e-4;
  const double angle0 = kNearlyQuarterTurn * std::tanh(parameters[0]);
  const double angle1 = kNearlyQuarterTurn * std::tanh(parameters[1]);
  const double first = std::min(angle0, angle1);
  const double last = std::max(angle0, angle1);
  const double height0 = std::max(0.0, parameters[7]);
  const double height1 = std::max(0.0, parameters[8]);
  const auto exceedsRange = [](double parameter) { return std::abs(parameter) > 64.0; };
  if (std::ranges::any_of(parameters, exceedsRange) || last - first < 1e-6 || height0 + height1 < 1e-3) {
    return std::nullopt;
  }
  const Eigen::Quaterniond rotation =
      Eigen::Quaterniond(parameters[2], parameters[3], parameters[4], parameters[5]).normalized();
  const Vector3d foot = rotation * Vector3d::UnitX();
  const Vector3d along = rotation * Vector3d::UnitY();
  const Vector3d plane_normal = rotation * Vector3d::UnitZ();
  const double distance = std::exp2(parameters[6]);
  const Vector3d start = distance * (foot + std::tan(first) * along);
  const Vector3d end = distance * (foot + std::tan(last) * along);
  const Vector3d w0 = start.normalized();
  const Vector3d w1 = end.normalized();
  const Vector3d dual0 = w1.cross(plane_normal) / w1.cross(plane_normal).dot(w0);
  const Vector3d dual1 = w0.cross(plane_normal) / w0.cross(plane_normal).dot(w1);
  const Vector3d in_plane = height0 * dual0 + height1 * dual1;
  const Vector3d normal = (in_plane.normalized() + std::sinh(parameters[9]) * plane_normal).normalized();
  const auto height = [&normal](const Vector3d& r) {
    const auto exact =
        static_cast<double>(dot(widen<DoubleWord<double>, double, 3>(normal), widen<DoubleWord<double>, double, 3>(r)));
    // What the rounding of the normal leaves of an end meant to be on the horizon.
    return exact < 1e-12 * r.norm() ? 0.0 : exact;
  };
  const EdgeView view{start, end, height(start), height(end), normal, last - first};
  if (view.start_height == 0.0 && view.end_height == 0.0) {
    return std::nullopt;
  }
  return view;
}

}  // namespace irradiff
