#include "experiments/cache/irradiance_cache.h"

#include "tests/cache/synthetic_field.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using cache_test::AffineIrradiance;
using cache_test::refusal;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kRounding = std::numeric_limits<double>::epsilon() / 2.0;

Eigen::Vector3d randomDirection(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random);
  const double y = normal(random);
  return Eigen::Vector3d(x, y, normal(random)).normalized();
}

Receiver randomReceiver(std::mt19937_64& random) {
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  const double x = coordinate(random);
  const double y = coordinate(random);
  return {{x, y, coordinate(random)}, randomDirection(random)};
}

/// `normal` turned by an angle about a direction that is orthogonal to it.
Eigen::Vector3d turned(const Eigen::Vector3d& normal, double angle) {
  return std::cos(angle) * normal + std::sin(angle) * normal.unitOrthogonal();
}

/// A record at the origin, normal along z, with an ellipse along x and y.
CacheRecord recordOf(double irradiance, double first_half_axis, double second_half_axis) {
  CacheRecord record;
  record.receiver = {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()};
  record.irradiance = irradiance;
  record.gradient.setZero();
  record.rotational_gradient.setZero();
  record.first_axis = Eigen::Vector3d::UnitX();
  record.second_axis = Eigen::Vector3d::UnitY();
  record.half_axes = {first_half_axis, second_half_axis};
  return record;
}

Receiver above(double x, double y, double z) { return {{x, y, z}, Eigen::Vector3d::UnitZ()}; }

// Eqs. (16) to (18) at points where they can be told by hand.
TEST(Weight, IsATentOverTheEllipse) {
  const CacheRecord record = recordOf(1.0, 2.0, 4.0);
  EXPECT_EQ(weight(record, above(0.0, 0.0, 0.0), 0.2), 1.0);
  EXPECT_EQ(weight(record, above(1.0, 0.0, 0.0), 0.2), 0.5);
  EXPECT_EQ(weight(record, above(0.0, 1.0, 0.0), 0.2), 0.75);
  // In units of the shorter half-axis, whichever comes first.
  EXPECT_EQ(weight(record, above(0.0, 0.0, 1.0), 0.2), 0.5);
  EXPECT_EQ(weight(recordOf(1.0, 4.0, 2.0), above(0.0, 0.0, 1.0), 0.2), 0.5);
  EXPECT_NEAR(weight(record, above(0.6, 1.6, 0.0), 0.2), 0.5, 2.0 * kRounding);
}

TEST(Weight, EndsAtTheBorder) {
  const CacheRecord record = recordOf(1.0, 2.0, 4.0);
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(2, 0, 0), Eigen::Vector3d(0, -4, 0), Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(1.2, 3.2, 0)}) {
    EXPECT_NEAR(translationalDistance(record, direction), 1.0, 2.0 * kRounding);
    EXPECT_GT(weight(record, {0.999 * direction, Eigen::Vector3d::UnitZ()}, 0.2), 0.0);
    EXPECT_EQ(weight(record, {1.001 * direction, Eigen::Vector3d::UnitZ()}, 0.2), 0.0);
  }
}

TEST(Weight, EndsAtTheDeviationOfNormals) {
  const CacheRecord record = recordOf(1.0, 1.0, 1.0);
  const auto at = [&](double angle, double deviation) {
    return weight(record, {Eigen::Vector3d::Zero(), turned(Eigen::Vector3d::UnitZ(), angle)}, deviation);
  };
  EXPECT_NEAR(at(0.1, 0.2), (std::cos(0.1) - std::cos(0.2)) / (1.0 - std::cos(0.2)), 64.0 * kRounding);
  EXPECT_GT(at(0.1999, 0.2), 0.0);
  EXPECT_EQ(at(0.2001, 0.2), 0.0);
  EXPECT_EQ(at(3.0, 0.2), 0.0);
  // Where the cosines of Eq. (16) are all 1 in double, 0/0.
  EXPECT_EQ(at(0.0, 1e-9), 1.0);
  EXPECT_NEAR(at(0.5e-9, 1e-9), 0.75, 1e-6);
}

// Beyond both limits the product of the two tents would be positive again.
TEST(Weight, IsZeroWhereBothTentsAreNegative) {
  const CacheRecord record = recordOf(1.0, 1.0, 1.0);
  EXPECT_EQ(weight(record, {{3.0, 0.0, 0.0}, -Eigen::Vector3d::UnitZ()}, 0.2), 0.0);
}

TEST(Weight, OfAnInfiniteRegionIsTheNormalsAlone) {
  const CacheRecord record = recordOf(1.0, kInfinite, kInfinite);
  EXPECT_EQ(weight(record, above(1e6, -1e9, 1e300), 0.2), 1.0);
  const CacheRecord stripe = recordOf(1.0, 2.0, kInfinite);
  EXPECT_EQ(weight(stripe, above(1.0, 1e9, 0.0), 0.2), 0.5);
  EXPECT_EQ(weight(stripe, above(2.1, 0.0, 0.0), 0.2), 0.0);
}

TEST(IrradianceCache, IsExactWhereIrradianceIsAffine) {
  std::mt19937_64 random(1);
  const AffineIrradiance truth;
  IrradianceCache cache;
  const Eigen::Vector3d normal = randomDirection(random);
  std::vector<Receiver> receivers(400);
  for (Receiver& receiver : receivers) receiver = {randomReceiver(random).position, normal};
  for (std::size_t i = 0; i < 40; ++i) cache.add(truth.record(receivers[i], 0.8));
  double worst = 0.0;
  int served = 0;
  for (const Receiver& receiver : receivers) {
    const std::optional<double> result = cache.interpolate(receiver);
    if (!result) continue;
    ++served;
    worst = std::max(worst, std::abs(*result - truth.at(receiver)));
  }
  EXPECT_GT(served, 200);
  // About ten roundings of numbers up to 4, and as many of their mean.
  std::cout << "affine irradiance: largest error " << worst / kRounding << " u\n";
  EXPECT_LT(worst, 64.0 * kRounding);
}

// On a curved surface, E = v.n. Along a turn by theta about any tangent, v.n = v.n_i cos(theta) + slope sin(theta):
// what the first order leaves out is v.n_i (1 - cos theta), exactly, since |n_i x n| = sin(theta).
TEST(IrradianceCache, HasTheRotationPairOfItsGradient) {
  std::mt19937_64 random(2);
  const AffineIrradiance truth;
  double worst = 0.0;
  double worst_flipped = kInfinite;
  for (int i = 0; i < 200; ++i) {
    const Receiver at = randomReceiver(random);
    CacheRecord record = truth.record(at, 1.0);
    record.gradient = truth.slope;
    const double angle = std::uniform_real_distribution<double>(0.05, 0.19)(random);
    Eigen::Vector3d tangent = at.normal.cross(randomDirection(random)).normalized();
    // Where the turn matters.
    if (std::abs(truth.source.dot(tangent)) < 0.2) continue;
    const Receiver receiver{at.position + 0.1 * tangent, std::cos(angle) * at.normal + std::sin(angle) * tangent};
    const double left_out = truth.source.dot(at.normal) * (1.0 - std::cos(angle));
    worst = std::max(worst, std::abs(extrapolated(record, receiver) - left_out - truth.at(receiver)));
    record.rotational_gradient *= -1.0;
    worst_flipped = std::min(worst_flipped, std::abs(extrapolated(record, receiver) - left_out - truth.at(receiver)));
  }
  std::cout << "rotation pair: largest error " << worst / kRounding << " u, with n x n_i at least " << worst_flipped
            << '\n';
  EXPECT_LT(worst, 64.0 * kRounding);
  EXPECT_GT(worst_flipped, 2.0 * 0.2 * std::sin(0.05) - 1e-12);
}

TEST(IrradianceCache, AddsTheSecondOrderOfARecord) {
  CacheRecord record = recordOf(1.0, 2.0, 2.0);
  record.gradient = {0.5, 0.0, 0.0};
  record.hessian.diagonal() << 2.0, 4.0, 0.0;
  EXPECT_EQ(extrapolated(record, above(1.0, 0.5, 0.0)), 1.0 + 0.5 + 0.5 * (2.0 + 1.0));
}

// Eq. (15) over all records, one after the other: the tree changes no bit, in whatever order boxes were added.
TEST(IrradianceCache, InterpolatesAsASumOverAllRecords) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> half_axis(0.05, 0.9);
  IrradianceCache cache(1.2);
  std::vector<CacheRecord> records;
  for (int i = 0; i < 300; ++i) {
    CacheRecord record = AffineIrradiance{}.record(randomReceiver(random), 1.0);
    record.half_axes = {half_axis(random), half_axis(random)};
    if (i % 50 == 7) record.half_axes(1) = kInfinite;
    if (i % 100 == 9) record.half_axes.setConstant(kInfinite);
    record.irradiance = half_axis(random);
    cache.add(record);
    records.push_back(record);
  }
  int served = 0;
  for (int i = 0; i < 2000; ++i) {
    const Receiver receiver = randomReceiver(random);
    double weighted = 0.0;
    double weights = 0.0;
    for (const CacheRecord& record : records) {
      const double w = weight(record, receiver, 1.2);
      if (w > 0.0) {
        weighted += w * extrapolated(record, receiver);
        weights += w;
      }
    }
    const std::optional<double> result = cache.interpolate(receiver);
    ASSERT_EQ(result.has_value(), weights > 0.0);
    ASSERT_EQ(cache.serves(receiver), weights > 0.0);
    if (result) {
      ++served;
      ASSERT_EQ(*result, std::max(0.0, weighted / weights));
    }
  }
  EXPECT_GT(served, 1000);
}

TEST(IrradianceCache, FindsWhoIsAround) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> half_axis(0.05, 0.5);
  IrradianceCache cache;
  for (int i = 0; i < 200; ++i) {
    CacheRecord record = AffineIrradiance{}.record(randomReceiver(random), 1.0);
    record.half_axes = {half_axis(random), half_axis(random)};
    cache.add(record);
  }
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d position = randomReceiver(random).position;
    std::vector<std::size_t> around;
    for (std::size_t j = 0; j < cache.records().size(); ++j) {
      if (translationalDistance(cache.records()[j], position) < 1.0) around.push_back(j);
    }
    EXPECT_EQ(cache.recordsAround(position), around);
  }
}

// The two sides of a thin wall are within each other's regions, but for the normals.
TEST(IrradianceCache, ServesOneSideOfAThinWall) {
  IrradianceCache cache(0.5 * std::numbers::pi);
  cache.add(recordOf(1.0, 1.0, 1.0));
  EXPECT_TRUE(cache.serves({{0.1, 0.0, -1e-6}, Eigen::Vector3d::UnitZ()}));
  EXPECT_FALSE(cache.serves({{0.1, 0.0, -1e-6}, -Eigen::Vector3d::UnitZ()}));
  EXPECT_THAT(cache.recordsAround({0.1, 0.0, -1e-6}), ElementsAre(0U));
}

TEST(IrradianceCache, HasNothingForAReceiverOutside) {
  IrradianceCache cache;
  EXPECT_EQ(cache.interpolate(above(0.0, 0.0, 0.0)), std::nullopt);
  cache.add(recordOf(1.0, 1.0, 2.0));
  EXPECT_EQ(cache.interpolate(above(0.0, 0.0, 0.0)), 1.0);
  EXPECT_EQ(cache.interpolate(above(0.0, 2.5, 0.0)), std::nullopt);
  EXPECT_EQ(cache.interpolate(above(1.5, 0.0, 0.0)), std::nullopt);
  EXPECT_THAT(cache.recordsAround({0.0, 3.0, 0.0}), IsEmpty());
}

TEST(IrradianceCache, HasNoNegativeIrradiance) {
  IrradianceCache cache;
  CacheRecord record = recordOf(1.0, 10.0, 10.0);
  record.gradient = {-1.0, 0.0, 0.0};
  cache.add(record);
  EXPECT_EQ(cache.interpolate(above(0.5, 0.0, 0.0)), 0.5);
  EXPECT_EQ(cache.interpolate(above(2.0, 0.0, 0.0)), 0.0);
}

TEST(IrradianceCache, ShrinksARegionInItsShape) {
  IrradianceCache cache;
  cache.add(recordOf(1.0, 2.0, 4.0));
  cache.add(recordOf(1.0, kInfinite, kInfinite));
  cache.shrink(0, 1.0);
  cache.shrink(0, 3.0);
  cache.shrink(1, 1.5);
  EXPECT_EQ(cache.records()[0].half_axes, Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(cache.records()[1].half_axes, Eigen::Vector2d(1.5, 1.5));
  EXPECT_THAT(cache.recordsAround({0.0, 1.9, 0.0}), ElementsAre(0U));
  EXPECT_THAT(cache.recordsAround({1.4, 0.0, 0.0}), ElementsAre(1U));
  EXPECT_FALSE(cache.serves(above(3.0, 0.0, 0.0)));
}

TEST(IrradianceCache, RefusesRecordsThatWouldNotServeTheirOwnReceiver) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  IrradianceCache cache;
  cache.add(recordOf(1.0, 1.0, 1.0));
  const auto refused = [&](const CacheRecord& record) { return refusal([&] { cache.add(record); }); };
  EXPECT_EQ(refused(recordOf(1.0, 0.0, 1.0)),
            "cache record 1: the half-axes of its region are (0, 1), must be positive");
  EXPECT_THAT(refused(recordOf(1.0, 1.0, kNaN)), HasSubstr("(1, nan), must be positive"));
  EXPECT_THAT(refused(recordOf(kNaN, 1.0, 1.0)), HasSubstr("the irradiance is nan, must be finite"));
  CacheRecord record = recordOf(1.0, 1.0, 1.0);
  record.receiver.position(1) = kInfinite;
  EXPECT_THAT(refused(record), HasSubstr("position (0, inf, 0)"));
  record = recordOf(1.0, 1.0, 1.0);
  record.rotational_gradient(0) = kNaN;
  EXPECT_THAT(refused(record), HasSubstr("(nan, 0, 0)"));
  record = recordOf(1.0, 1.0, 1.0);
  record.second_axis(0) = kNaN;
  EXPECT_THAT(refused(record), HasSubstr("axes"));
  EXPECT_EQ(cache.records().size(), 1U);
}

TEST(IrradianceCache, RefusesADeviationOfNormalsOutOfRange) {
  EXPECT_EQ(refusal([] { IrradianceCache cache(0.0); }),
            "the largest deviation of normals is 0 rad, must be in (0, pi/2]");
  EXPECT_THAT(refusal([] { IrradianceCache cache(10.0); }), HasSubstr("10 rad"));
  EXPECT_THAT(refusal([] { IrradianceCache cache(std::numeric_limits<double>::quiet_NaN()); }), HasSubstr("nan rad"));
}

}  // namespace
}  // namespace irradiff
