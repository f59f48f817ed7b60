// Visibility by SceneEvaluator::view (filtered predicates) against exactVisibility (CGAL, rational numbers), arc by arc
// and without a tolerance. They share nothing but the scene. Both saw the same from 102,600 receivers:
//   IRRADIFF_TEST_MULTIPLIER=36 build/release/tests/visibility/visibility_routes_test --gtest_filter='All/*'

#include "derivatives/scene/invalid_scene.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "tests/visibility/degenerate_scenes.h"
#include "tests/visibility/rational_view.h"
#include "verification/checks/input_families.h"
#include "verification/checks/random.h"
#include "verification/exact_visibility/exact_visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 2012;
// Of each family.
constexpr std::size_t kScenes = 150;

struct RefusalOr {
  std::optional<ExactVisibility> seen;
  std::string refusal;
};

RefusalOr exactRoute(const std::vector<Polygon>& polygons, const Receiver& receiver) {
  try {
    return {exactVisibility(polygons, receiver), ""};
  } catch (const InvalidScene& error) {
    return {std::nullopt, error.what()};
  }
}

std::string textOf(const SceneWithReceivers& scene, const Receiver& receiver) {
  std::ostringstream text;
  text.precision(17);
  const auto append = [&text](const Eigen::Vector3d& v) {
    text << '[' << v.x() << ", " << v.y() << ", " << v.z() << ']';
  };
  for (const Polygon& polygon : scene.polygons) {
    text << "  radiance " << polygon.radiance << ':';
    for (const Eigen::Vector3d& vertex : polygon.vertices) append(vertex);
    text << '\n';
  }
  text << "  receiver ";
  append(receiver.position);
  text << " normal ";
  append(receiver.normal);
  return text.str();
}

struct Tally {
  std::size_t points = 0;
  std::size_t refused = 0;
  std::size_t on_a_polygon = 0;
  std::size_t arcs = 0;
  std::size_t creases = 0;
  std::size_t vertices = 0;
  std::size_t meetings = 0;
  std::size_t aligned = 0;
  std::size_t horizon = 0;
  std::size_t edge_on = 0;
  std::size_t meetings_in_hiding = 0;
};

bool areAllDifferentAndBright(const std::vector<Polygon>& polygons) {
  std::set<double> radiances{0.0};
  for (const Polygon& polygon : polygons) radiances.insert(polygon.radiance);
  return radiances.size() == polygons.size() + 1;
}

// Whether two polygons of one radiance overlap in one plane, or may.
bool anyOverlap(const std::vector<Polygon>& polygons) {
  const std::vector<std::size_t> groups = overlapGroups(polygons);
  return std::set<std::size_t>(groups.begin(), groups.end()).size() < groups.size();
}

// The reasons why derivatives do not exist. A null may be given where a derivative happens to exist, never the reverse.
std::vector<std::string> wrongReasons(const ExactVisibility& seen, const RationalView& exact,
                                      const VisibleBoundary& other, const std::vector<Polygon>& polygons,
                                      const Receiver& receiver, Tally& tally) {
  std::vector<std::string> wrong;
  // The exact route leaves out what is seen edge-on.
  if (other.meeting_in_view && exact.meetings.empty() && exact.edge_on.empty()) {
    ++tally.meetings_in_hiding;
    // With arcs between those of one radiance that overlap in one plane.
    std::vector<Polygon> apart = polygons;
    for (std::size_t i = 0; i < apart.size(); ++i) apart[i].radiance = static_cast<double>(i);
    if (!hasCornerBehindAnArc(rationalView(seen, apart, receiver), polygons, receiver)) {
      wrong.push_back("nothing meets in view, but: " + *other.meeting_in_view);
    }
  }
  // Nor does it take the outline of a polygon for an edge where another of its radiance goes on in its plane.
  if (other.edges_in_line && exact.lines_over_each_other.empty() && !anyOverlap(polygons)) {
    wrong.push_back("no edges are in line, but: " + *other.edges_in_line);
  }
  const bool has_no_hessian = other.meeting_in_view || other.edges_in_line;
  if (!has_no_hessian && std::ranges::any_of(exact.meetings, [](const auto& meeting) { return meeting.second; })) {
    wrong.push_back("lines of different radiance meet in view without a word");
  }
  if (!other.edges_in_line && exact.has_aligned_arcs && areAllDifferentAndBright(polygons)) {
    wrong.push_back("edges are in line without a word");
  }
  return wrong;
}

// Empty where both routes agree.
std::vector<std::string> compare(const SceneWithReceivers& scene, const SceneEvaluator& evaluator,
                                 const Receiver& receiver, Tally& tally) {
  ++tally.points;
  const RefusalOr exact = exactRoute(scene.polygons, receiver);
  std::optional<VisibleBoundary> other;
  std::string refusal;
  try {
    other = evaluator.view(receiver);
  } catch (const InvalidScene& error) {
    refusal = error.what();
  }
  if (!other && exact.seen && !exact.seen->edge_on.empty() && refusal.find("overlap") == std::string::npos) {
    // A receiver on a polygon, which the exact route takes for one that is not there.
    ++tally.on_a_polygon;
    return {};
  }
  if (!other || !exact.seen) {
    ++tally.refused;
    if (!other && !exact.seen) return {};
    return {"refused by one route alone: " + exact.refusal + refusal};
  }
  const RationalView exact_view = rationalView(*exact.seen, scene.polygons, receiver);
  const RationalView other_view = rationalView(*other, evaluator.mesh(), scene.polygons, receiver);
  std::vector<std::string> found = differences(exact_view, other_view);
  std::ranges::copy(wrongReasons(*exact.seen, exact_view, *other, scene.polygons, receiver, tally),
                    std::back_inserter(found));
  tally.arcs += exact.seen->arcs.size();
  for (const ExactArc& arc : exact.seen->arcs) tally.creases += arc.line.kind == ExactLine::Kind::kCrease ? 1U : 0U;
  tally.vertices += exact_view.vertices.size();
  tally.meetings += exact_view.meetings.size();
  tally.aligned += exact_view.has_aligned_arcs ? 1U : 0U;
  tally.horizon += exact_view.horizon.size();
  tally.edge_on += exact_view.edge_on.size();
  return found;
}

SceneWithReceivers sceneOf(const SceneFamily& family, std::size_t index) {
  KeyedRandom random(kSeed, family.name, index);
  return family.draw(random);
}

class Routes : public testing::TestWithParam<SceneFamily> {};

TEST_P(Routes, SeeTheSame) {
  Tally tally;
  std::size_t shown = 0;
  std::size_t different = 0;
  for (std::size_t index = 0; index < lengthened(kScenes); ++index) {
    const SceneWithReceivers scene = sceneOf(GetParam(), index);
    const SceneEvaluator evaluator(scene.polygons);
    for (const Receiver& receiver : scene.receivers) {
      const std::vector<std::string> found = compare(scene, evaluator, receiver, tally);
      if (found.empty()) continue;
      ++different;
      if (shown++ >= 5) continue;
      std::string text;
      for (const std::string& difference : found) text += "  " + difference + '\n';
      ADD_FAILURE() << "scene " << index << ":\n" << textOf(scene, receiver) << '\n' << text;
    }
  }
  EXPECT_EQ(different, 0U);
  std::cout << tally.points << " points: " << tally.arcs << " arcs (" << tally.creases << " creases), "
            << tally.vertices << " apparent vertices, " << tally.horizon << " horizon intervals, " << tally.meetings
            << " meetings of more lines, " << tally.aligned << " views with edges in line, " << tally.edge_on
            << " polygons edge-on, " << tally.meetings_in_hiding << " nulls for what meets in hiding, " << tally.refused
            << " refused by both, " << tally.on_a_polygon << " receivers on a polygon; " << different << " different\n";
}

INSTANTIATE_TEST_SUITE_P(All, Routes, testing::ValuesIn(degenerateSceneFamilies()),
                         [](const auto& family) { return std::string(family.param.name); });

/// A view of the fast route, what the exact one says of it, and a way to spoil the former.
struct ComparedView {
  SceneWithReceivers scene;
  SceneEvaluator evaluator;
  Receiver receiver;
  ExactVisibility exact;
  VisibleBoundary other;

  bool isAccepted(const VisibleBoundary& spoilt) const {
    return differences(rationalView(exact, scene.polygons, receiver),
                       rationalView(spoilt, evaluator.mesh(), scene.polygons, receiver))
        .empty();
  }
};

/// Of triangles in general position.
std::vector<ComparedView> comparedViews() {
  std::vector<ComparedView> views;
  for (std::size_t index = 0; index < 20; ++index) {
    const SceneWithReceivers scene = sceneOf(degenerateSceneFamilies().front(), index);
    const SceneEvaluator evaluator(scene.polygons);
    for (const Receiver& receiver : scene.receivers) {
      views.push_back(
          {scene, evaluator, receiver, exactVisibility(scene.polygons, receiver), evaluator.view(receiver)});
      EXPECT_TRUE(views.back().isAccepted(views.back().other)) << index;
    }
  }
  return views;
}

TEST(RoutesReject, ASwappedSide) {
  std::size_t spoilt = 0;
  for (const ComparedView& view : comparedViews()) {
    for (std::size_t i = 0; i < view.other.arcs.size(); i += 5, ++spoilt) {
      VisibleBoundary twin = view.other;
      std::swap(twin.arcs[i].sides.left, twin.arcs[i].sides.right);
      EXPECT_FALSE(view.isAccepted(twin));
    }
  }
  EXPECT_GT(spoilt, 50U);
}

TEST(RoutesReject, AnIgnoredPolygon) {
  std::size_t spoilt = 0;
  for (const ComparedView& view : comparedViews()) {
    for (std::size_t ignored = 0; ignored < view.scene.polygons.size(); ++ignored) {
      if (!view.other.is_seen[ignored]) continue;
      std::vector<bool> is_present(view.scene.polygons.size(), true);
      is_present[ignored] = false;
      const SceneMesh& mesh = view.evaluator.mesh();
      const ViewPredicates predicates(
          mesh, view.receiver.position.unaryExpr([&](double c) { return std::ldexp(c, -mesh.exponent()); }),
          view.receiver.normal);
      EXPECT_FALSE(view.isAccepted(visibleBoundary(mesh, view.scene.polygons, is_present, predicates, 1)));
      ++spoilt;
    }
  }
  EXPECT_GT(spoilt, 50U);
}

TEST(RoutesReject, ALimitMovedToAnotherEventOfItsEdge) {
  std::size_t spoilt = 0;
  for (const ComparedView& view : comparedViews()) {
    for (std::size_t i = 0; i < view.other.arcs.size(); i += 6) {
      const VisibleArc& arc = view.other.arcs[i];
      std::vector<EdgePlace> events{{EdgePlace::Kind::kEnd}};
      for (const VisibleArc& other : view.other.arcs) {
        if (other.edge == arc.edge) events.insert(events.end(), {other.first, other.last});
      }
      for (const ApparentVertex& vertex : view.other.apparent_vertices) {
        if (vertex.farther == arc.edge) events.push_back({EdgePlace::Kind::kEdge, vertex.nearer});
        if (vertex.nearer == arc.edge) events.push_back({EdgePlace::Kind::kEdge, vertex.farther});
      }
      for (const EdgePlace& event : events) {
        if (event == arc.first || event == arc.last) continue;
        VisibleBoundary twin = view.other;
        twin.arcs[i].last = event;
        EXPECT_FALSE(view.isAccepted(twin));
        ++spoilt;
      }
    }
  }
  EXPECT_GT(spoilt, 50U);
}

TEST(RoutesReject, AHiddenEdgeCounted) {
  std::size_t spoilt = 0;
  for (const ComparedView& view : comparedViews()) {
    const SceneMesh& mesh = view.evaluator.mesh();
    for (std::size_t edge = 0; edge < mesh.firstCrease(); ++edge) {
      const MeshEdge& e = mesh.edges()[edge];
      const auto isAbove = [&](std::size_t vertex) {
        const Eigen::Vector3d position =
            mesh.vertices()[vertex].unaryExpr([&](double c) { return std::ldexp(c, mesh.exponent()); });
        return view.receiver.normal.dot(position - view.receiver.position) > 0.0;
      };
      const bool is_seen = std::ranges::count(view.other.arcs, edge, &VisibleArc::edge) > 0;
      if (is_seen || !isAbove(e.start) || !isAbove(e.end)) continue;
      VisibleBoundary twin = view.other;
      twin.arcs.push_back(
          {edge, {EdgePlace::Kind::kStart}, {EdgePlace::Kind::kEnd}, {kNone, mesh.faces()[e.faces.front()].polygon}});
      EXPECT_FALSE(view.isAccepted(twin));
      ++spoilt;
    }
  }
  EXPECT_GT(spoilt, 20U);
}

TEST(RoutesReject, AnApparentVertexOrAnIntervalOfTheHorizonLeftOut) {
  std::size_t vertices = 0;
  std::size_t intervals = 0;
  for (const ComparedView& view : comparedViews()) {
    if (!view.other.apparent_vertices.empty()) {
      VisibleBoundary twin = view.other;
      twin.apparent_vertices.pop_back();
      EXPECT_FALSE(view.isAccepted(twin));
      ++vertices;
    }
    if (!view.other.horizon.empty()) {
      VisibleBoundary twin = view.other;
      twin.horizon.clear();
      EXPECT_FALSE(view.isAccepted(twin));
      ++intervals;
    }
  }
  EXPECT_GT(vertices, 20U);
  EXPECT_GT(intervals, 10U);
}

TEST(RoutesReject, AReasonLeftOutOrMadeUp) {
  std::size_t left_out = 0;
  std::size_t made_up = 0;
  Tally tally;
  for (std::size_t index = 0; index < 60; ++index) {
    const SceneWithReceivers scene = sceneOf(degenerateSceneFamilies()[index % 2], index);
    const SceneEvaluator evaluator(scene.polygons);
    for (const Receiver& receiver : scene.receivers) {
      const RefusalOr exact = exactRoute(scene.polygons, receiver);
      if (!exact.seen) continue;
      VisibleBoundary twin;
      try {
        twin = evaluator.view(receiver);
      } catch (const InvalidScene&) {
        continue;
      }
      const RationalView view = rationalView(*exact.seen, scene.polygons, receiver);
      const auto reject = [&] {
        return !wrongReasons(*exact.seen, view, twin, scene.polygons, receiver, tally).empty();
      };
      EXPECT_FALSE(reject());
      if (std::ranges::any_of(view.meetings, [](const auto& meeting) { return meeting.second; })) {
        twin.meeting_in_view.reset();
        twin.edges_in_line.reset();
        EXPECT_TRUE(reject());
        ++left_out;
      } else if (view.lines_over_each_other.empty() && !anyOverlap(scene.polygons)) {
        twin.edges_in_line = "made up";
        EXPECT_TRUE(reject());
        ++made_up;
      }
    }
  }
  EXPECT_GT(left_out, 5U);
  EXPECT_GT(made_up, 20U);
}

}  // namespace
}  // namespace irradiff
