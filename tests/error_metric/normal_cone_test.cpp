#include "derivatives/error_metric/normal_cone.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <stdexcept>

namespace irradiff {
namespace {

using Eigen::Vector3d;

Vector3d turnedBy(double degrees) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Vector3d::UnitX()) * Vector3d::UnitZ();
}

TEST(NormalCone, ContainsWhatIsWithinItsAngle) {
  for (const double degrees : {1e-7, 0.1, 10.0, 60.0, 90.0, 135.0, 179.0}) {
    const NormalCone cone = NormalCone::ofDegrees(degrees);
    EXPECT_TRUE(cone.contains(Vector3d::UnitZ(), turnedBy(degrees * (1.0 - 1e-6)))) << degrees;
    EXPECT_FALSE(cone.contains(Vector3d::UnitZ(), turnedBy(degrees * (1.0 + 1e-6)))) << degrees;
  }
  EXPECT_TRUE(NormalCone::ofDegrees(0.0).contains(Vector3d::UnitZ(), Vector3d::UnitZ()));
  EXPECT_FALSE(NormalCone::ofDegrees(0.0).contains(Vector3d::UnitZ(), turnedBy(1e-6)));
  EXPECT_TRUE(NormalCone::ofDegrees(180.0).contains(Vector3d::UnitZ(), -Vector3d::UnitZ()));
}

TEST(NormalCone, RefusesWhatIsNoAngle) {
  for (const double degrees : {-1.0, 180.5, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT([degrees] { NormalCone::ofDegrees(degrees); },
                testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("must be between 0 and 180")));
  }
}

}  // namespace
}  // namespace irradiff
