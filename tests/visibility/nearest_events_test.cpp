// The distance to the nearest visibility event, against what moves of the receiver make of the topology.

#include "derivatives/scene/invalid_scene.h"
#include "derivatives/visibility/radiance_topology.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "verification/checks/input_families.h"
#include "verification/occlusion/scene_families.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <optional>

namespace irradiff {
namespace {

using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;

constexpr std::uint64_t kSeed = 20120806;
constexpr std::size_t kKept = 8;
const Vector3d kUp(0.0, 0.0, 1.0);

/// That of the first event, with one kind left out of account or none.
double nearestOf(const VisibilityEvents<3>& events, std::optional<EventKind> without) {
  const auto counts = [&](const VisibilityEvent<3>& event) { return event.kind != without; };
  const auto found = std::ranges::find_if(events, counts);
  return found == events.end() ? std::numeric_limits<double>::infinity() : found->distance;
}

/// What is seen of radiances from a place; nothing where the library refuses it, on a surface, say.
std::optional<VisibleBoundary> topologyFrom(const SceneEvaluator& evaluator, const OccludedScene& scene,
                                            const Vector3d& position) {
  std::vector<double> radiances;
  for (const Polygon& polygon : scene.polygons) radiances.push_back(polygon.radiance);
  try {
    return radianceTopology(evaluator.view({position, scene.receiver.normal}), radiances);
  } catch (const InvalidScene&) {
    return std::nullopt;
  }
}

struct Found {
  std::size_t scenes = 0;
  std::size_t changed = 0;          ///< in which moves by less than the distance change the topology
  std::size_t first_confirmed = 0;  ///< in which the first event changes it
  std::size_t confirmed = 0;        ///< in which one of the first does
  std::vector<double> ratios;       ///< of where that one is to the distance
  std::vector<std::string> lines;   ///< of the changed
};

Found judge(const SceneFamily& family, std::size_t count, std::optional<EventKind> without) {
  Found found;
  for (std::size_t k = 0; k < count; ++k) {
    const OccludedScene scene = drawScene(family, kSeed, k);
    const SceneEvaluator evaluator(scene.polygons);
    const Vector3d& x = scene.receiver.position;
    const VisibilityEvents<3> events = evaluator.nearestEvents(scene.receiver, kKept);
    const double distance = nearestOf(events, without);
    const std::optional<VisibleBoundary> here = topologyFrom(evaluator, scene, x);
    // A move that the receiver's coordinates cannot express is none.
    if (!here || !(distance > 1e-13 * (1.0 + x.norm()))) continue;
    ++found.scenes;
    KeyedRandom random(kSeed, "moves", k);
    const double reach = 0.999 * std::min(distance, 10.0 * extentOf(scene));
    for (int i = 0; i < 60; ++i) {
      const auto there = topologyFrom(evaluator, scene, x + reach * random.direction());
      if (!there || *there == *here) continue;
      ++found.changed;
      found.lines.push_back(events.front().what + '\n' + sceneLine(scene));
      break;
    }
    if (without) continue;
    const auto isReal = [&](const VisibilityEvent<3>& event) {
      return topologyFrom(evaluator, scene, x + 1.001 * event.displacement) != here;
    };
    found.first_confirmed += isReal(events.front()) ? 1 : 0;
    const auto real = std::ranges::find_if(events, isReal);
    if (real == events.end()) continue;
    ++found.confirmed;
    found.ratios.push_back(real->displacement.norm() / distance);
  }
  return found;
}

TEST(NearestEvents, NothingChangesNearer) {
  std::size_t scenes = 0;
  std::size_t first_confirmed = 0;
  std::vector<double> ratios;
  for (const SceneFamily& family : sceneFamilies()) {
    const Found found = judge(family, lengthened(40), std::nullopt);
    std::cout << family.name << ": of " << found.scenes << " scenes the first event changes the view in "
              << found.first_confirmed << ", one of the first in " << found.confirmed << '\n';
    EXPECT_EQ(found.changed, 0U) << family.name << ": " << (found.lines.empty() ? "" : found.lines.front());
    // The distance is no idle bound: what was found is there.
    EXPECT_GE(found.confirmed, found.scenes * 9 / 10) << family.name;
    scenes += found.scenes;
    first_confirmed += found.first_confirmed;
    ratios.insert(ratios.end(), found.ratios.begin(), found.ratios.end());
  }
  std::ranges::sort(ratios);
  std::cout << "an event that shows is " << ratios[ratios.size() / 2] << " times as far in the median, "
            << ratios[ratios.size() * 9 / 10] << " in nine of ten scenes\n";
  EXPECT_GE(scenes, lengthened(350));
  EXPECT_GE(first_confirmed, scenes / 2);
}

// Without any one of the kinds the view does change nearer.
TEST(NearestEvents, EachKindIsNeeded) {
  for (const EventKind kind : kEventKinds) {
    std::size_t changed = 0;
    for (const SceneFamily& family : sceneFamilies()) changed += judge(family, 20, kind).changed;
    std::cout << "without kind " << static_cast<int>(kind) << " the view changes nearer in " << changed << " scenes\n";
    EXPECT_GE(changed, 3U) << static_cast<int>(kind);
  }
}

Polygon squareAt(const std::string& name, double height, double half_width, double radiance) {
  return {name,
          {{-half_width, -half_width, height},
           {half_width, -half_width, height},
           {half_width, half_width, height},
           {-half_width, half_width, height}},
          radiance};
}

const VisibilityEvent<3>& firstOf(const VisibilityEvents<3>& events, EventKind kind) {
  const auto found = std::ranges::find(events, kind, &VisibilityEvent<3>::kind);
  if (found == events.end()) throw std::runtime_error("no event of the kind");
  return *found;
}

TEST(NearestEvents, APlaneSeenEdgeOn) {
  const SceneEvaluator evaluator(std::vector<Polygon>{{"sheet", {{1, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}}, 1.0}});
  const VisibilityEvents<3> events = evaluator.nearestEvents({{0.25, 0.5, 0.75}, kUp}, kKept);
  // All edges come to lie on the horizon there, and the Hessian jumps.
  EXPECT_DOUBLE_EQ(firstOf(events, EventKind::kHorizon).distance, 0.25);
  EXPECT_TRUE(firstOf(events, EventKind::kHorizon).hessian_jumps);
  const VisibilityEvent<3>& edge_on = firstOf(events, EventKind::kEdgeOn);
  EXPECT_DOUBLE_EQ(edge_on.distance, 0.25);
  EXPECT_DOUBLE_EQ(edge_on.displacement.z(), 0.25);
  EXPECT_EQ(edge_on.what, "polygons[0] \"sheet\" is seen edge-on");
}

// Under the middle of a small screen: its corners meet the lamp's edges in planes through both.
TEST(NearestEvents, ACornerOnTheLampsEdge) {
  const SceneEvaluator evaluator(
      std::vector<Polygon>{squareAt("lamp", 2.0, 1.0, 1.0), squareAt("screen", 1.0, 0.25, 0.0)});
  const VisibilityEvents<3> events = evaluator.nearestEvents({{0.0, 0.0, 0.0}, kUp}, kKept);
  const VisibilityEvent<3>& event = events.front();
  EXPECT_EQ(event.kind, EventKind::kVertexOnEdge);
  EXPECT_THAT(event.what,
              AllOf(HasSubstr("a vertex of polygons[1] \"screen\""), HasSubstr("an edge of polygons[0] \"lamp\"")));
  // The plane x = 1 - 0.75 (2 - z) through the lamp's edge and the screen's: x + 0.5 = 0.75 z.
  EXPECT_NEAR(event.distance, 0.5 / 1.25, 1e-15);
  // The nearest place of the plane is at z = 0.24: 0.76 below the screen, which is 1 below the lamp.
  EXPECT_NEAR(event.rounding, 2.0 * 1.76 * std::sqrt(3.0) * 0x1p-53 * 2.0, 1e-19);
}

// Three bars at heights 1, 2 and 3 with edges along y = 0, x = y and x = a: from the origin they meet for a = 0.
TEST(NearestEvents, ThreeEdges) {
  const double a = 0.0625;
  const std::vector<Polygon> scene = {{"far", {{a, -4, 3}, {a, 4, 3}, {9, 4, 3}, {9, -4, 3}}, 5.0},
                                      {"middle", {{-4, -4, 2}, {4, 4, 2}, {4, -4, 2}}, 1.0},
                                      {"near", {{-4, 0, 1}, {4, 0, 1}, {4, -4, 1}, {-4, -4, 1}}, 0.0}};
  const VisibilityEvents<3> events = SceneEvaluator(scene).nearestEvents({{0.0, 0.0, 0.0}, kUp}, kKept);
  const VisibilityEvent<3>& event = events.front();
  EXPECT_EQ(event.kind, EventKind::kThreeEdges);
  EXPECT_THAT(event.what, AllOf(HasSubstr("far"), HasSubstr("middle"), HasSubstr("near")));
  // Seen from (x, y, 0) the near edge is at y' = -y, the middle one at x' - y' = -(x - y)/2 and the far one at x' =
  // (a - x)/3, directions (x', y', 1): they meet where (a - x)/3 + y = -(x - y)/2, or 2 a + x + 3 y = 0.
  EXPECT_LE(event.distance, 2.0 * a / std::sqrt(10.0));
  EXPECT_GE(event.distance, 0.9 * 2.0 * a / std::sqrt(14.0));
  EXPECT_TRUE(event.hessian_jumps);
}

TEST(NearestEvents, AVertexOnTheHorizonOnlyBendsTheHessian) {
  const SceneEvaluator evaluator(std::vector<Polygon>{{"sail", {{1, 0, 0.125}, {1, 1, 1}, {1, -1, 1.5}}, 1.0}});
  const VisibilityEvents<3> events = evaluator.nearestEvents({{0.0, 0.0, 0.0}, kUp}, kKept);
  EXPECT_EQ(events.front().kind, EventKind::kHorizon);
  EXPECT_EQ(events.front().what, "a vertex of polygons[0] \"sail\" reaches the horizon");
  EXPECT_DOUBLE_EQ(events.front().distance, 0.125);
  EXPECT_FALSE(events.front().hessian_jumps);
}

// Coordinates scaled by a power of two scale the distances, to the same bits.
TEST(NearestEvents, HasTheUnitOfTheScene) {
  for (const SceneFamily& family : sceneFamilies()) {
    OccludedScene scene = drawScene(family, kSeed, 3);
    const VisibilityEvents<3> events = SceneEvaluator(scene.polygons).nearestEvents(scene.receiver, kKept);
    for (Polygon& polygon : scene.polygons) {
      for (Vector3d& v : polygon.vertices) v *= 0x1p-40;
    }
    scene.receiver.position *= 0x1p-40;
    const VisibilityEvents<3> scaled = SceneEvaluator(scene.polygons).nearestEvents(scene.receiver, kKept);
    ASSERT_EQ(scaled.size(), events.size());
    for (std::size_t i = 0; i < events.size(); ++i) {
      EXPECT_EQ(scaled[i].distance, 0x1p-40 * events[i].distance);
      EXPECT_EQ(scaled[i].rounding, 0x1p-40 * events[i].rounding);
      EXPECT_EQ(scaled[i].what, events[i].what);
    }
  }
}

}  // namespace
}  // namespace irradiff
