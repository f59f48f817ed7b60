// The division of the half circle into strata.

#include "derivatives/flatland/flatland_strata.h"

#include "derivatives/flatland/flatland_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector2d;
using testing::AllOf;
using testing::HasSubstr;

constexpr double kRoundoff = 0x1p-53;
constexpr FlatlandStratification kAll[] = {FlatlandStratification::kCosine, FlatlandStratification::kSquare};

TEST(FlatlandStrata, CosineStrataHaveEqualProjectedAngles) {
  for (const std::size_t count : {1u, 2u, 7u, 64u, 1000u}) {
    const std::vector<Vector2d> borders = FlatlandStrata(FlatlandStratification::kCosine, count).borders();
    ASSERT_EQ(borders.size(), count + 1);
    for (std::size_t i = 0; i < count; ++i) {
      // The integral of sin(phi) between the borders' angles; both have a few roundings of numbers up to 1.
      const double projected = borders[i].x() - borders[i + 1].x();
      EXPECT_NEAR(projected, 2.0 / static_cast<double>(count), 8.0 * kRoundoff);
    }
  }
}

/// How far counterclockwise along the half square a direction meets it, from 0 to 4.
double alongSquare(const Vector2d& w) {
  const Vector2d p = w / std::max(std::abs(w.x()), w.y());
  if (p.x() >= 1.0) return p.y();
  return p.x() <= -1.0 ? 4.0 - p.y() : 2.0 - p.x();
}

TEST(FlatlandStrata, SquareTexelsAreEquallyLong) {
  for (const std::size_t count : {4u, 8u, 12u, 400u}) {
    const std::vector<Vector2d> borders = FlatlandStrata(FlatlandStratification::kSquare, count).borders();
    ASSERT_EQ(borders.size(), count + 1);
    for (std::size_t i = 0; i <= count; ++i) {
      const double expected = 4.0 * static_cast<double>(i) / static_cast<double>(count);
      EXPECT_NEAR(alongSquare(borders[i]), expected, 16.0 * kRoundoff);
    }
    EXPECT_NEAR(borders[count / 4].x(), borders[count / 4].y(), kRoundoff);
  }
  // The cosine strata are no texels.
  const std::vector<Vector2d> other = FlatlandStrata(FlatlandStratification::kCosine, 8).borders();
  EXPECT_GT(std::abs(alongSquare(other[1]) - 0.5), 0.1);
}

TEST(FlatlandStrata, FollowEachOtherCounterclockwiseFromOneEndOfTheHorizonToTheOther) {
  for (const FlatlandStratification stratification : kAll) {
    const FlatlandStrata strata(stratification, 20);
    const std::vector<Vector2d> borders = strata.borders();
    EXPECT_EQ(borders.front(), Vector2d(1.0, 0.0));
    EXPECT_EQ(borders.back(), Vector2d(-1.0, 0.0));
    double angle = -1e-9;
    for (std::size_t i = 0; i < strata.count(); ++i) {
      for (const double along : {0.0, 0.3, 0.7}) {
        const Vector2d w = strata.direction(i, along);
        EXPECT_NEAR(w.norm(), 1.0, 4.0 * kRoundoff);
        EXPECT_GE(w.y(), 0.0);
        EXPECT_GT(std::atan2(w.y(), w.x()), angle);
        angle = std::atan2(w.y(), w.x());
        const Vector2d mirrored = strata.direction(strata.count() - 1 - i, 1.0 - along);
        EXPECT_NEAR(mirrored.x(), -w.x(), 4.0 * kRoundoff);
        EXPECT_NEAR(mirrored.y(), w.y(), 4.0 * kRoundoff);
      }
    }
  }
}

std::string refusalOf(FlatlandStratification stratification, std::size_t count) {
  try {
    FlatlandStrata(stratification, count);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(FlatlandStrata, RefusesImpossibleCounts) {
  for (const FlatlandStratification stratification : kAll) {
    EXPECT_THAT(refusalOf(stratification, 0), AllOf(HasSubstr("0 flatland strata"), HasSubstr("from 1 to")));
    EXPECT_THAT(refusalOf(stratification, kMostFlatlandStrata + 4), HasSubstr(std::to_string(kMostFlatlandStrata)));
    EXPECT_EQ(refusalOf(stratification, kMostFlatlandStrata), "");
  }
  EXPECT_THAT(refusalOf(FlatlandStratification::kSquare, 6),
              AllOf(HasSubstr("6 flatland strata"), HasSubstr("a multiple of 4")));
  EXPECT_EQ(refusalOf(FlatlandStratification::kCosine, 6), "");
}

TEST(SampleHalfCircle, CastsOneRayThroughEachStratumAtItsOffset) {
  const FlatlandStrata strata(FlatlandStratification::kCosine, 3);
  const std::vector<double> offsets{0.25, 1.0, 0.0};
  std::vector<Vector2d> cast;
  const FlatlandSamples samples = sampleHalfCircle(strata, offsets, [&cast](const Vector2d& w) {
    cast.push_back(w);
    return FlatlandHit{static_cast<double>(cast.size()), 10.0 * static_cast<double>(cast.size())};
  });
  ASSERT_EQ(samples.size(), 3u);
  EXPECT_EQ(samples.directions, cast);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(cast[i], strata.direction(i, offsets[i]));
    EXPECT_EQ(samples.hits[i].inverse_distance, static_cast<double>(i + 1));
    EXPECT_EQ(samples.hits[i].radiance, 10.0 * static_cast<double>(i + 1));
  }
}

TEST(FlatlandFrame, IsRightHanded) {
  EXPECT_EQ(flatlandFrame({0.0, 1.0}), Eigen::Matrix2d::Identity());
  const Eigen::Matrix2d axes = flatlandFrame({0.6, 0.8});
  EXPECT_EQ(axes.col(0), Vector2d(0.8, -0.6));
  EXPECT_EQ(axes.col(1), Vector2d(0.6, 0.8));
}

}  // namespace
}  // namespace irradiff
