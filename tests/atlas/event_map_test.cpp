#include "experiments/atlas/event_map.h"

#include "derivatives/visibility/scene_evaluation.h"
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

TEST(EventMap, MeasuresEveryEvaluator) {
  for (std::size_t i = 0; i < 20; ++i) {
    KeyedRandom random(5, "evaluators", i);
    const OccludedScene scene = drawNearEvent(random, 1e-3, 0.5);
    const ErrorProbe probe = probeScene(scene, 1e-3, 0.5);
    ASSERT_EQ(probe.errors.size(), emptyEventMap({}).variants.size());
    for (const AtlasErrors& errors : probe.errors) {
      for (const double error : errors) EXPECT_LT(error, 1e-12) << sceneLine(scene);
    }
    for (const AtlasErrors& errors : probeScene(scene, 1e-2, 0.5).errors) {
      EXPECT_TRUE(std::isnan(errors[2])) << "it is at another place";
    }
  }
}

// The bad twin: the evaluation of a scene whose screen is a millionth of a metre aside.
TEST(EventMap, TellsAWrongEvaluation) {
  KeyedRandom random(5, "evaluators", 0);
  OccludedScene scene = drawNearEvent(random, 1e-3, 0.5);
  const SceneEvaluation<3> truth = SceneEvaluator(scene.polygons).evaluate(scene.receiver);
  for (Eigen::Vector3d& vertex : scene.polygons[1].vertices) vertex += 1e-6 * Eigen::Vector3d::Ones();
  const SceneEvaluation<3> moved = SceneEvaluator(scene.polygons).evaluate(scene.receiver);
  for (const double error : sceneErrors(truth, truth)) EXPECT_EQ(error, 0.0);
  for (const double error : sceneErrors(moved, truth)) EXPECT_GT(error, 1e-9);
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
