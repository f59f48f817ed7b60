#include "experiments/atlas/safe_region.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace irradiff {
namespace {

constexpr std::size_t kCells = 24;

/// A map from 1e-6 to 1e6 in both sizes.
StabilityMap emptySquare() {
  StabilityMap map;
  map.file = "square";
  map.x = {"a", 1e-6, 1e6};
  map.y = {"b", 1e-6, 1e6};
  map.cells = kCells;
  return map;
}

/// The largest error in each cell of a law that is monotone in both sizes.
std::vector<double> errorsOf(const StabilityMap& map, const std::function<double(double, double)>& law) {
  std::vector<double> errors;
  const auto corner = [&](std::size_t i) { return std::pow(10.0, -6.0 + 12.0 * static_cast<double>(i) / kCells); };
  for (std::size_t row = 0; row < map.cells; ++row) {
    for (std::size_t column = 0; column < map.cells; ++column) {
      double worst = 0.0;
      for (const std::size_t r : {row, row + 1}) {
        for (const std::size_t c : {column, column + 1}) worst = std::max(worst, law(corner(c), corner(r)));
      }
      errors.push_back(worst);
    }
  }
  return errors;
}

TEST(SafeRegion, IsEverywhereOrNowhere) {
  const StabilityMap map = emptySquare();
  const std::vector<double> small(kCells * kCells, 1e-9);
  const auto everywhere = largestSafeRegion(map, small, 1e-6);
  ASSERT_TRUE(everywhere);
  EXPECT_TRUE(everywhere->inequalities.empty());
  EXPECT_EQ(everywhere->share, 1.0);
  EXPECT_EQ(textOf(everywhere, map.x, map.y), "everywhere");
  EXPECT_FALSE(largestSafeRegion(map, small, 1e-9)) << "no margin";
  EXPECT_EQ(textOf(std::nullopt, map.x, map.y), "nowhere");
  const std::vector<double> failed(kCells * kCells, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(largestSafeRegion(map, failed, 1e-3));
  const std::vector<double> not_held(kCells * kCells, std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(largestSafeRegion(map, not_held, 1e-3));
}

TEST(SafeRegion, FindsALowerBound) {
  const StabilityMap map = emptySquare();
  // 0.9e-6 a^-2 is 1e-3 at a = 0.03; with the margin and a cell of half a decade the bound is near above.
  const auto region = largestSafeRegion(map, errorsOf(map, [](double a, double) { return 0.9e-6 / (a * a); }), 1e-3);
  ASSERT_TRUE(region);
  ASSERT_EQ(region->inequalities.size(), 1U);
  const SizeInequality& bound = region->inequalities[0];
  EXPECT_EQ(bound.x_power, 1);
  EXPECT_EQ(bound.y_power, 0);
  EXPECT_TRUE(bound.is_at_least);
  EXPECT_GE(bound.bound, 0.03 * std::sqrt(kSafetyMargin));
  EXPECT_LE(bound.bound, 0.03 * std::sqrt(kSafetyMargin) * 3.3);
  EXPECT_FALSE(region->contains(0.9 * bound.bound, 1.0));
  EXPECT_TRUE(region->contains(bound.bound, 1e-6));
}

TEST(SafeRegion, FindsASlantedBound) {
  const StabilityMap map = emptySquare();
  const auto law = [](double a, double b) { return 1e-9 / (a * b); };
  const auto region = largestSafeRegion(map, errorsOf(map, law), 1e-6);
  ASSERT_TRUE(region);
  ASSERT_EQ(region->inequalities.size(), 1U) << textOf(region, map.x, map.y);
  EXPECT_EQ(region->inequalities[0].x_power, 1);
  EXPECT_EQ(region->inequalities[0].y_power, 1);
  EXPECT_GE(region->inequalities[0].bound, 1e-3 * kSafetyMargin);
  EXPECT_LE(region->inequalities[0].bound, 1e-1);
  EXPECT_EQ(textOf(region, map.x, map.y).substr(0, 9), "a * b >= ");
  const auto inverse = largestSafeRegion(map, errorsOf(map, [](double a, double b) { return 1e-9 * a * b; }), 1e-6);
  ASSERT_TRUE(inverse);
  EXPECT_EQ(textOf(inverse, map.x, map.y).substr(0, 9), "a * b <= ");
}

/// Whether nothing in the region breaks the tolerance: on a grid of its own, finer than the map's.
bool isSafe(const SafeRegion& region, const std::function<double(double, double)>& law, double tolerance) {
  for (int i = 0; i <= 240; ++i) {
    for (int j = 0; j <= 240; ++j) {
      const double a = std::pow(10.0, -6.0 + 12.0 * i / 240.0);
      const double b = std::pow(10.0, -6.0 + 12.0 * j / 240.0);
      if (region.contains(a, b) && law(a, b) > tolerance) return false;
    }
  }
  return true;
}

TEST(SafeRegion, IsSafeForEveryLaw) {
  const StabilityMap map = emptySquare();
  const std::vector<std::function<double(double, double)>> laws = {
      [](double a, double b) { return 1e-10 * std::pow(a, -1.5) * std::pow(b, -0.7); },
      [](double a, double b) { return 1e-12 * a * a / b; },
      [](double a, double b) { return 1e-16 / (a * a * a) + 1e-12 * b; },
      [](double a, double) { return a < 0.013 ? std::numeric_limits<double>::infinity() : 1e-16; },
      [](double a, double b) { return 1e-16 * (1.0 + 1e3 * a / b + 1e3 * b / a); },
  };
  for (const auto& law : laws) {
    const auto region = largestSafeRegion(map, errorsOf(map, law), 1e-6);
    ASSERT_TRUE(region);
    EXPECT_TRUE(isSafe(*region, law, 1e-6)) << textOf(region, map.x, map.y);
    EXPECT_GT(region->share, 0.1);
    SafeRegion larger = *region;
    for (SizeInequality& i : larger.inequalities) i.bound *= i.is_at_least ? 1e-5 : 1e5;
    EXPECT_FALSE(isSafe(larger, law, 1e-6)) << "the bad twin of " << textOf(region, map.x, map.y);
  }
}

TEST(SafeRegion, IsTextForCode) {
  SafeRegion region;
  region.inequalities = {{1, 0, true, 0.032}, {0, 1, false, 20.0}, {2, -1, true, 1e-5}, {-1, 1, true, 3.0}};
  EXPECT_EQ(textOf(region, {"size", 0, 1}, {"sine", 0, 1}),
            "size >= 0.032 and sine <= 20 and (size)^2 / (sine) >= 1e-05 and sine / (size) >= 3");
  EXPECT_TRUE(region.contains(1.0, 4.0));
  EXPECT_FALSE(region.contains(1.0, 2.0));
  EXPECT_FALSE(region.contains(0.01, 4.0));
}

}  // namespace
}  // namespace irradiff
