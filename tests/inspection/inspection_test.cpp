#include "experiments/inspection/evaluation_cost.h"
#include "experiments/inspection/point_inspection.h"
#include "experiments/inspection/scene_inspection.h"
#include "verification/certified/certified_scene.h"
#include "verification/checks/input_families.h"
#include "verification/checks/random.h"
#include "verification/occlusion/scene_families.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::uint64_t kSeed = 20121106;
const Vector3d kUp(0.0, 0.0, 1.0);

Polygon squareAt(const std::string& name, double height, double half_width, double radiance) {
  return {name,
          {{-half_width, -half_width, height},
           {half_width, -half_width, height},
           {half_width, half_width, height},
           {-half_width, half_width, height}},
          radiance};
}

PointInspection<3> inspectAt(const std::vector<Polygon>& scene, const Vector3d& position) {
  return inspectPoint(SceneEvaluator(scene), {position, kUp}, kDefaultTolerance);
}

/// A lamp behind a screen. From (x, 0, 0) the screen's left corners meet the lamp's left edge in the plane z = (4 x -
/// 2)/3, whose normal is (0.8, 0, -0.6): at x = 0.5.
const std::vector<Polygon> kScreened = {squareAt("lamp", 2.0, 1.0, 1.0), squareAt("screen", 1.0, 0.25, 0.0)};

TEST(HessianUse, DependsOnTheDistanceToAnEvent) {
  const PointInspection<3> middle = inspectAt(kScreened, {0.0, 0.0, 0.0});
  EXPECT_EQ(middle.hessian, HessianUse::kGood);
  ASSERT_TRUE(middle.jump);
  EXPECT_NEAR(middle.jump->distance, 0.4, 1e-14);
  const double range = middle.promised_range;
  EXPECT_GT(range, 0.05);
  EXPECT_LT(range, 0.4);
  // The range hardly changes on the way to the event; the use does at half of it.
  EXPECT_EQ(inspectAt(kScreened, {0.5 - 1.25 * 0.9 * range, 0.0, 0.0}).hessian, HessianUse::kGood);
  const PointInspection<3> close = inspectAt(kScreened, {0.5 - 1.25 * 0.3 * range, 0.0, 0.0});
  EXPECT_EQ(close.hessian, HessianUse::kShort);
  EXPECT_THAT(close.jump->what, HasSubstr("a vertex of polygons[1] \"screen\" meets an edge of polygons[0] \"lamp\""));
  EXPECT_EQ(inspectAt(kScreened, {0.5 - 1e-12, 0.0, 0.0}).hessian, HessianUse::kShort);
  // A few units of roundoff of the coordinates' size.
  EXPECT_EQ(inspectAt(kScreened, {0.5 - 0x1p-52, 0.0, 0.0}).hessian, HessianUse::kUndecided);
  const PointInspection<3> at = inspectAt(kScreened, {0.5, 0.0, 0.0});
  EXPECT_EQ(at.hessian, HessianUse::kMissing);
  EXPECT_EQ(at.promised_range, 0.0);
  EXPECT_EQ(at.event->distance, 0.0);
}

// As polygons scale, so do ranges and distances.
TEST(HessianUse, DoesNotDependOnTheUnitOfLength) {
  for (const double x : {0.1, 0.4, 0.4999, 0.5 - 0x1p-52, 0.5}) {
    std::vector<Polygon> scaled = kScreened;
    for (Polygon& polygon : scaled) {
      for (Vector3d& v : polygon.vertices) v *= 0x1p-30;
    }
    const PointInspection<3> in_metres = inspectAt(kScreened, {x, 0.0, 0.0});
    const PointInspection<3> in_another = inspectAt(scaled, {0x1p-30 * x, 0.0, 0.0});
    EXPECT_EQ(in_metres.hessian, in_another.hessian) << x;
    EXPECT_NEAR(0x1p-30 * in_metres.promised_range, in_another.promised_range, 1e-13 * in_another.promised_range);
    EXPECT_EQ(0x1p-30 * in_metres.event->distance, in_another.event->distance);
  }
}

TEST(HessianUse, IsUncertainWhereTheBoundIsLargeBesideIt) {
  // A closed box of constant radiance has no Hessian but its rounding.
  std::vector<Polygon> box;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Polygon face{"face", {}, 1.0};
      for (const auto& [u, v] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        Vector3d p;
        p(axis) = side;
        p((axis + 1) % 3) = u;
        p((axis + 2) % 3) = v;
        face.vertices.push_back(p);
      }
      box.push_back(face);
    }
  }
  EXPECT_EQ(inspectAt(box, {0.1, 0.2, 0.3}).hessian, HessianUse::kUncertain);
  // Without light nothing is asked.
  EXPECT_EQ(inspectAt({squareAt("dark", 1.0, 1.0, 0.0)}, {0.0, 0.0, 0.0}).hessian, HessianUse::kGood);
}

// What makes a range short: the tangent of irradiance and half of the Hessian tell irradiance to the third order up to
// the event, and beyond only to the second.
TEST(HessianUse, TheHessianIsGoodUpToTheEventAndNotBeyond) {
  // A turned screen, so that a corner meets an edge and not an edge another one.
  const SceneEvaluator evaluator(std::vector<Polygon>{
      squareAt("lamp", 2.0, 1.0, 1.0),
      {"screen", {{-0.3, 0.02, 1.0}, {0.02, -0.3, 1.0}, {0.3, 0.02, 1.0}, {0.02, 0.3, 1.0}}, 0.0}});
  const VisibilityEvent<3> event = evaluator.nearestEvents({Vector3d::Zero(), kUp}, 1).front();
  ASSERT_EQ(event.kind, EventKind::kVertexOnEdge);
  const Vector3d along = event.displacement.normalized();
  const auto at = [&](double distance) { return evaluator.evaluate({event.displacement + distance * along, kUp}); };
  const auto errorOf = [&](double from, double to) {
    const SceneEvaluation<3> here = at(from);
    const Vector3d move = (to - from) * along;
    return std::abs(at(to).derivatives.irradiance.value - here.derivatives.irradiance.value -
                    here.derivatives.gradient.value.dot(move) - 0.5 * move.dot(here.derivatives.hessian.value * move));
  };
  double last_before = 0.0;
  double last_beyond = 0.0;
  for (const double h : {0.04, 0.02, 0.01}) {
    // Moves of h that end at the event, and such that begin there.
    const double before = errorOf(-h, -1e-9 * h);
    const double beyond = errorOf(-1e-9 * h, h);
    EXPECT_GE(beyond, 10.0 * before) << h;
    if (last_before > 0.0) {
      EXPECT_NEAR(std::log2(last_before / before), 3.0, 0.3) << h;
      EXPECT_NEAR(std::log2(last_beyond / beyond), 2.0, 0.3) << h;
    }
    last_before = before;
    last_beyond = beyond;
  }
  // The bound of the additional error: half the jump of the Hessian times the square of what lies beyond.
  const Eigen::Matrix3d jump = at(1e-9).derivatives.hessian.value - at(-1e-9).derivatives.hessian.value;
  EXPECT_NEAR(errorOf(-1e-9, 0.01), 0.5 * std::abs(along.dot(jump * along)) * 1e-4, 0.1 * errorOf(-1e-9, 0.01));
  EXPECT_GT(jump.cwiseAbs().maxCoeff(), 0.1 * at(-1e-9).derivatives.hessian.value.cwiseAbs().maxCoeff());
}

// Whether the Hessian jumps at an event is told by its kind.
TEST(HessianUse, JumpsWhereTheEventSaysSo) {
  std::size_t bends = 0;
  std::size_t jumps = 0;
  std::size_t seen_jumps = 0;
  for (const char* name : {"tilted screens", "tilted receivers", "piercing"}) {
    for (std::size_t k = 0; k < lengthened(60); ++k) {
      const OccludedScene scene = drawScene(sceneFamily(name), kSeed, k);
      const SceneEvaluator evaluator(scene.polygons);
      const VisibilityEvents<3> events = evaluator.nearestEvents(scene.receiver, 1);
      // The next one is far enough away not to be mistaken for it; three edges have a displacement of first order.
      if (events.size() < 2 || events[1].distance < 1.01 * events[0].distance) continue;
      if (events[0].kind == EventKind::kThreeEdges) continue;
      const auto hessianAt = [&](double share) {
        return evaluator.evaluate({scene.receiver.position + share * events[0].displacement, scene.receiver.normal});
      };
      const auto changeAcross = [&](double aside) -> std::optional<double> {
        const SceneEvaluation<3> before = hessianAt(1.0 - aside);
        const SceneEvaluation<3> beyond = hessianAt(1.0 + aside);
        if (!before.no_hessian.empty() || !beyond.no_hessian.empty()) return std::nullopt;
        return (beyond.derivatives.hessian.value - before.derivatives.hessian.value).cwiseAbs().maxCoeff();
      };
      const std::optional<double> wide = changeAcross(1e-3);
      const std::optional<double> narrow = changeAcross(1e-6);
      if (!wide || !narrow || *wide == 0.0) continue;
      // What is continuous changes by less across less.
      const bool is_jump = *narrow > 0.1 * *wide;
      if (events[0].hessian_jumps) {
        ++jumps;
        if (is_jump) ++seen_jumps;
      } else {
        ++bends;
        EXPECT_FALSE(is_jump) << *narrow << ' ' << *wide << ' ' << events[0].what << ' ' << sceneLine(scene);
      }
    }
  }
  std::cout << "of " << jumps << " events at which the Hessian may jump it does in " << seen_jumps << "; " << bends
            << " at which it does not\n";
  EXPECT_GE(bends, lengthened(3));
  EXPECT_GE(seen_jumps, jumps / 4);
  EXPECT_GE(jumps, lengthened(30));
}

TEST(LoosestBound, IsRelativeToWhatIsLeftOfAQuantity) {
  SceneEvaluation<3> e = darkScene<3>();
  EXPECT_EQ(loosestBound(e).quantity, "");
  e.derivatives.irradiance.value = 2.0;
  e.derivatives.gradient.value = {1.0, 0.0, 0.0};
  e.derivatives.hessian.value(0, 0) = 1.0;
  e.derivatives.tangential_hessian.value(0, 0) = 1.0;
  e.bounds = {1e-15, 1e-15, 1e-6, 1e-15, 1e-15};
  EXPECT_EQ(loosestBound(e).quantity, "hessian");
  EXPECT_DOUBLE_EQ(loosestBound(e).relative, 1e-6);
  e.derivatives.hessian.value(0, 0) = 0.0;
  EXPECT_TRUE(std::isinf(loosestBound(e).relative));
  // What does not exist has no bound.
  e.no_hessian = "because";
  EXPECT_DOUBLE_EQ(loosestBound(e).relative, 1e-15);
}

// A polygon that is small for its distance: its bound in double comes from the area rule, which the ladder does not
// have.
TEST(InspectPoint, AsksTheLadderForTheRung) {
  const std::vector<Polygon> far{squareAt("far", 2.0, 1e-4, 1.0)};
  const auto rungAt = [&far](double tolerance) {
    return inspectPoint(SceneEvaluator(far), {{0.1, 0.0, 0.0}, {0.0, 0.0, 1.0}}, tolerance).rung;
  };
  EXPECT_EQ(rungAt(1e-6), Rung::kDouble);
  EXPECT_EQ(rungAt(1e-12), Rung::kExtended);
  EXPECT_EQ(rungAt(1e-40), Rung::kBall);
  // The bound of the double path says otherwise.
  EXPECT_LE(inspectPoint(SceneEvaluator(far), {{0.1, 0.0, 0.0}, {0.0, 0.0, 1.0}}, 1e-12).loosest_bound.relative, 1e-12);
}

TEST(EvaluationCost, GrowsWithWhatIsSeen) {
  const auto costOf = [](const std::vector<Polygon>& scene) { return *inspectAt(scene, {0.05, 0.0, 0.0}).cost; };
  const std::vector<Polygon> lamp = {squareAt("lamp", 2.0, 1.0, 1.0)};
  // The unit.
  EXPECT_NEAR(costOf(lamp), 1.0, 0.2);
  EXPECT_GT(costOf(kScreened), 2.0 * costOf(lamp));
  std::vector<Polygon> more = kScreened;
  for (int i = 0; i < 10; ++i) more.push_back(squareAt("another", 1.1 + 0.05 * i, 0.2, 0.0));
  EXPECT_GT(costOf(more), 3.0 * costOf(kScreened));
}

TEST(SceneInspection, CountsAndNotes) {
  Scene scene;
  scene.description = "three receivers";
  scene.polygons = kScreened;
  scene.receivers = {{{0.0, 0.0, 0.0}, kUp}, {{0.5, 0.0, 0.0}, kUp}, {{0.5 - 1e-9, 0.0, 0.0}, kUp}};
  std::vector<std::size_t> taken;
  InspectionSinks sinks;
  sinks.take = [&](std::size_t i, const PointInspection<3>& point) {
    taken.push_back(i);
    EXPECT_TRUE(point.changes_within) << i;
    EXPECT_GE(*point.changes_within, point.event->distance);
  };
  const SceneInspection inspection = inspectScene(scene, 1e-12, sinks);
  EXPECT_THAT(taken, ElementsAre(0, 1, 2));
  EXPECT_EQ(inspection.receivers, 3U);
  EXPECT_EQ(inspection.with_occlusion, 3U);
  EXPECT_THAT(inspection.hessians, ElementsAre(1, 0, 0, 1, 1));
  EXPECT_EQ(std::accumulate(inspection.rungs.begin(), inspection.rungs.end(), std::size_t{0}), 3U);
  EXPECT_EQ(inspection.event_distances.least(), 0.0);
  EXPECT_NEAR(inspection.event_distances.largest(), 0.4, 1e-14);
  ASSERT_EQ(inspection.groups.size(), 2U);
  EXPECT_EQ(inspection.groups[0].title, "the Hessian does not exist");
  EXPECT_EQ(inspection.groups[0].worst.front().name, "points[1]");
  EXPECT_THAT(inspection.groups[0].worst.front().text, HasSubstr("lie over each other as seen from the receiver"));
  EXPECT_EQ(inspection.groups[1].worst.front().name, "points[2]");
}

// Of a grid the worst are named, and those of which the same is to be said together.
TEST(SceneInspection, NamesTheWorstOfAGrid) {
  Scene scene;
  scene.polygons = kScreened;
  scene.grid = ReceiverGrid{{-1.0, -1.0, 0.0}, {2.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, kUp, 9, 9};
  for (std::size_t j = 0; j < 9; ++j) {
    for (std::size_t i = 0; i < 9; ++i) scene.receivers.push_back(scene.grid->receiver(i, j));
  }
  EXPECT_EQ(pointCount(scene), 0U);
  const SceneInspection inspection = inspectScene(scene, 1e-12, {});
  EXPECT_EQ(inspection.receivers, 81U);
  EXPECT_EQ(std::accumulate(inspection.hessians.begin(), inspection.hessians.end(), std::size_t{0}), 81U);
  const auto group = std::ranges::find_if(inspection.groups, [](const NotedGroup& g) {
    return g.title == "a visibility event is nearer than half the range that the Hessian promises";
  });
  ASSERT_NE(group, inspection.groups.end());
  EXPECT_EQ(group->worst.size(), kNotedPoints);
  for (std::size_t i = 1; i < group->worst.size(); ++i) {
    EXPECT_GE(group->worst[i - 1].severity, group->worst[i].severity);
  }
  EXPECT_THAT(group->worst.front().name, HasSubstr("grid ("));
}

TEST(SceneInspection, OfFlatland) {
  Scene scene;
  scene.dimension = 2;
  scene.segments = {{"lamp", {Eigen::Vector2d(-1, 2), Eigen::Vector2d(1, 2)}, 1.0},
                    {"screen", {Eigen::Vector2d(-0.25, 1), Eigen::Vector2d(0.25, 1)}, 0.0}};
  scene.flatland_receivers = {{Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0, 1)},
                              {Eigen::Vector2d(0.5, 0.0), Eigen::Vector2d(0, 1)}};
  const SceneInspection inspection = inspectScene(scene, 1e-12, {});
  EXPECT_THAT(inspection.hessians, ElementsAre(1, 0, 0, 0, 1));
  EXPECT_TRUE(inspection.costs.isEmpty());
  EXPECT_EQ(inspection.treatments[2].largest(), 1.0);
}

}  // namespace
}  // namespace irradiff
