#include "experiments/atlas/event_map.h"

#include "verification/checks/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace irradiff {
namespace {

TEST(EventMap, DrawsScenesWithACrossingWhereItShouldBe) {
  for (std::size_t i = 0; i < 200; ++i) {
    KeyedRandom random(5, "events", i);
    const double along = random.decade(-9.0, -1.0);
    const double sine = random.decade(-4.0, 0.0);
    const OccludedScene scene = drawNearEvent(random, along, sine);
    const std::array<double, 2> place = measureNearEvent(scene);
    EXPECT_NEAR(place[0] / along, 1.0, 1e-2) << sceneLine(scene);
    EXPECT_NEAR(place[1] / sine, 1.0, 1e-2) << sceneLine(scene);
    for (std::size_t p = 0; p < scene.polygons.size(); ++p) EXPECT_NO_THROW(validate(scene.polygons[p], p));
  }
}

// A tenth of the screen's position moved by a millionth of its edge: the bad twin is off by more than rounding.
TEST(EventMap, TellsAWrongScene) {
  KeyedRandom random(5, "twin", 0);
  const OccludedScene scene = drawNearEvent(random, 1e-3, 0.5);
  const ErrorProbe right = probeScene(scene, 1e-3, 0.5);
  for (const double error : right.errors[0]) EXPECT_LT(error, 1e-12);
  EXPECT_TRUE(std::isnan(probeScene(scene, 1e-2, 0.5).errors[0][2])) << "another place";
}

TEST(EventMap, IsTheSameForAnyNumberOfThreads) {
  AtlasPlan plan;
  plan.event_cells = 4;
  plan.event_samples = 1;
  const StabilityMap one = eventStability(plan, 1, nullptr, {});
  const StabilityMap three = eventStability(plan, 3, nullptr, {});
  for (std::size_t q = 0; q < kAtlasQuantities; ++q) {
    for (std::size_t i = 0; i < one.variants[0].peak[q].size(); ++i) {
      const double a = one.variants[0].peak[q][i];
      const double b = three.variants[0].peak[q][i];
      EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b)));
    }
  }
}

}  // namespace
}  // namespace irradiff
