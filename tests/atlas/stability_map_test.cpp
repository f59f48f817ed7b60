#include "experiments/atlas/stability_map.h"

#include "tests/cli/program_run.h"
#include "verification/checks/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace irradiff {
namespace {

AtlasPlan smallPlan() {
  AtlasPlan plan;
  plan.cells = 3;
  plan.samples = 1;
  return plan;
}

/// Bit by bit: NaN is NaN.
bool areSame(const std::vector<StabilityMap>& a, const std::vector<StabilityMap>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t m = 0; m < a.size(); ++m) {
    for (std::size_t v = 0; v < a[m].variants.size(); ++v) {
      for (std::size_t q = 0; q < kAtlasQuantities; ++q) {
        const std::vector<double>& first = a[m].variants[v].peak[q];
        const std::vector<double>& second = b[m].variants[v].peak[q];
        if (first.size() != second.size()) return false;
        if (std::memcmp(first.data(), second.data(), first.size() * sizeof(double)) != 0) return false;
      }
    }
  }
  return true;
}

TEST(StabilityMap, IsTheSameForAnyNumberOfThreadsAndFromFinishedRows) {
  const std::vector<StabilityMap> maps = polygonStability(smallPlan(), 1, nullptr, {});
  EXPECT_TRUE(areSame(maps, polygonStability(smallPlan(), 3, nullptr, {})));
  const ScratchFolder scratch;
  {
    const TileStore half(scratch.file("rows"), "plan");
    polygonStability(smallPlan(), 1, &half, {});
    // What a killed run leaves is some of the rows.
    std::filesystem::remove(*std::ranges::find_if(
        std::filesystem::directory_iterator(scratch.file("rows")), std::filesystem::directory_iterator(),
        [](const auto& entry) { return entry.path().filename().string().starts_with("tile-"); }));
  }
  const TileStore rest(scratch.file("rows"), "plan");
  EXPECT_TRUE(areSame(maps, polygonStability(smallPlan(), 2, &rest, {})));
  AtlasPlan other = smallPlan();
  other.seed = 2;
  EXPECT_FALSE(areSame(maps, polygonStability(other, 1, nullptr, {})));
}

/// The variant's errors at one input of the first map.
AtlasErrors errorsOf(const char* name, double size) {
  const PolygonMap& map = polygonMaps()[0];
  KeyedRandom random(3, "probe", 0);
  const ErrorProbe probe = probeAt(map, map.draw(random, size, 0.5), size, 0.5, formulaVariants());
  const auto variant = std::ranges::find(formulaVariants(), std::string(name), &FormulaVariant::name);
  return probe.errors.at(static_cast<std::size_t>(variant - formulaVariants().begin()));
}

// That the errors are those of the formulas: known from their error laws.
TEST(StabilityMap, ShowsWhatTheLawsSay) {
  EXPECT_LT(errorsOf("boundary, endpoint weights, double", 1.0)[2], 1e-14);
  EXPECT_GT(errorsOf("boundary, endpoint weights, float", 1.0)[2], 1e-9) << "float is float";
  EXPECT_LT(errorsOf("boundary, endpoint weights, long double", 1.0)[2], 1e-17);
  EXPECT_GT(errorsOf("appendix, atan2, double", 1e-7)[2], 1e-3) << "u (distance/edge)^2";
  EXPECT_LT(errorsOf("area rule, double", 1e-7)[2], 1e-14);
  EXPECT_GT(errorsOf("area rule, double", 1e3)[2], 1e-3) << "quadrature";
  EXPECT_LT(errorsOf("evaluatePolygon, double", 1e-7)[2], 1e-14);
}

TEST(WorseError, KeepsWhatNothingMakesGood) {
  EXPECT_EQ(worseError(1.0, 2.0), 2.0);
  EXPECT_TRUE(std::isnan(worseError(std::nan(""), 2.0)));
  EXPECT_TRUE(std::isnan(worseError(2.0, std::nan(""))));
}

}  // namespace
}  // namespace irradiff
