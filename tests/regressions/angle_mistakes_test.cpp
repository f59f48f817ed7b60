// Mistakes with degrees and radians.

#include "derivatives/error_metric/normal_cone.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>

namespace irradiff {
namespace {

using Eigen::Vector3d;
using Accepts = std::function<bool(const Vector3d& normal, const Vector3d& other)>;

constexpr double kDegree = std::numbers::pi / 180.0;

/// The angle in degrees up to which normals are accepted: the first of a fine row that is not, turned about an axis
/// that is none of the coordinates'.
double widestAccepted(const Accepts& accepts) {
  const Vector3d normal = Vector3d(1.0, 2.0, 3.0).normalized();
  const Vector3d axis = normal.cross(Vector3d(0.3, -0.2, 0.9)).normalized();
  constexpr double kStep = 0.01;
  for (double degrees = kStep; degrees <= 180.0; degrees += kStep) {
    if (!accepts(normal, Eigen::AngleAxisd(degrees * kDegree, axis) * normal)) return degrees - kStep;
  }
  return 180.0;
}

/// The mistake: the user's angle in degrees is converted to degrees once more, and the cosine takes that for radians.
/// 10 become 573, and cos 573 rad is the cosine of 68 degrees.
Accepts acceptingDegreesOfDegrees(double degrees) {
  const double cosine = std::cos(degrees / kDegree);
  return [cosine](const Vector3d& normal, const Vector3d& other) { return normal.dot(other) >= cosine; };
}

Accepts acceptingByTheLibrary(double degrees) {
  const NormalCone cone = NormalCone::ofDegrees(degrees);
  return [cone](const Vector3d& normal, const Vector3d& other) { return cone.contains(normal, other); };
}

TEST(Regressions, TenDegreesThatAreSixtyEight) {
  for (const double degrees : {1.0, 10.0, 45.0, 120.0}) {
    EXPECT_NEAR(widestAccepted(acceptingByTheLibrary(degrees)), degrees, 0.015);
  }
  const double mistaken = widestAccepted(acceptingDegreesOfDegrees(10.0));
  std::cout << "10 degrees, converted the wrong way: " << mistaken << " degrees\n";
  EXPECT_NEAR(mistaken, 68.0, 1.0);
}

}  // namespace
}  // namespace irradiff
