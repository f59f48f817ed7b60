#include "derivatives/flatland/segment_visibility.h"

#include "derivatives/scene/invalid_scene.h"
#include "tests/flatland/rational_scene.h"
#include "tests/flatland/scene_draws.h"
#include "verification/checks/input_families.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <iostream>
#include <numeric>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 20120813;

std::vector<std::size_t> everySegment(const FlatlandScene& scene) {
  std::vector<std::size_t> indices(scene.segments.size());
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  return indices;
}

Rational cross(const RationalPoint& a, const RationalPoint& b) { return a.x * b.y - a.y * b.x; }

/// From the receiver towards a boundary point, `turn` -1 or 1 for the two sides of the horizon.
RationalPoint towards(const BoundaryPoint& point, const FlatlandScene& scene, int turn) {
  const RationalPoint x = exactly(scene.receiver.position);
  const RationalPoint n = exactly(scene.receiver.normal);
  if (point.kind == BoundaryPoint::Kind::kHorizon) return {-turn * n.y, turn * n.x};
  const RationalPoint a = exactly(scene.segments[point.segment].vertices[0]);
  const RationalPoint b = exactly(scene.segments[point.segment].vertices[1]);
  if (point.kind == BoundaryPoint::Kind::kEnd) {
    const RationalPoint& end = point.end == 0 ? a : b;
    return {end.x - x.x, end.y - x.y};
  }
  const RationalPoint c = exactly(scene.segments[point.other].vertices[0]);
  const RationalPoint d = exactly(scene.segments[point.other].vertices[1]);
  const RationalPoint e{b.x - a.x, b.y - a.y};
  const RationalPoint f{d.x - c.x, d.y - c.y};
  const Rational t = cross({c.x - a.x, c.y - a.y}, f) / cross(e, f);
  return {a.x + t * e.x - x.x, a.y + t * e.y - x.y};
}

/// Whether the parts are the intervals of the oracle, one by one, with exactly the same directions.
bool agree(const SegmentVisibility& visibility, const FlatlandScene& scene) {
  std::vector<RationalInterval> expected = RationalScene(scene.segments, scene.receiver, {}).visible().intervals;
  std::erase_if(expected, [](const RationalInterval& interval) { return interval.segment == kNothing; });
  if (expected.size() != visibility.parts.size()) return false;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const VisiblePart& part = visibility.parts[k];
    if (part.segment != expected[k].segment) return false;
    if (cross(towards(part.first, scene, -1), expected[k].from) != 0) return false;
    if (cross(towards(part.last, scene, 1), expected[k].to) != 0) return false;
  }
  return true;
}

struct Tally {
  std::size_t agreed = 0, ties = 0, wrong = 0, parts = 0, cut = 0, events = 0;
  std::string first_wrong;
};

using Viewer = std::function<SegmentVisibility(const FlatlandScene&)>;

SegmentVisibility view(const FlatlandScene& scene) {
  return visibleParts(scene.segments, everySegment(scene), scene.receiver);
}

void tally(const FlatlandScene& scene, const Viewer& viewer, Tally& result) {
  bool is_right = false;
  try {
    const SegmentVisibility visibility = viewer(scene);
    is_right = agree(visibility, scene) && !RationalScene(scene.segments, scene.receiver, {}).visible().has_tie;
    result.agreed += is_right ? 1 : 0;
    result.parts += visibility.parts.size();
    result.cut += visibility.hides_something ? 1 : 0;
    result.events += visibility.no_gradient.empty() ? 0 : 1;
  } catch (const InvalidScene& error) {
    is_right = RationalScene(scene.segments, scene.receiver, {}).visible().has_tie;
    result.ties += is_right ? 1 : 0;
  }
  if (!is_right && result.wrong++ == 0) result.first_wrong = sceneLine(scene);
}

Tally tallyGrids(const Viewer& viewer, std::size_t count) {
  Tally result;
  for (std::size_t i = 0; i < count; ++i) {
    KeyedRandom random(kSeed, "grid", i);
    tally(drawGrid(random), viewer, result);
  }
  return result;
}

void print(const char* name, const Tally& t) {
  std::cout << name << ", seed " << kSeed << ": " << t.agreed << " receivers agree, " << t.parts << " parts, " << t.cut
            << " with occlusion, " << t.events << " at events, " << t.ties << " overlaps refused\n";
}

TEST(VisibleParts, AreThoseOfRationalArithmeticOnGrids) {
  const Tally result = tallyGrids(view, lengthened(12000));
  print("grids", result);
  EXPECT_EQ(result.wrong, 0) << result.first_wrong;
  EXPECT_GT(result.ties, 0);
  EXPECT_GT(result.events, result.agreed / 20);
}

TEST(VisibleParts, AreThoseOfRationalArithmeticOnRandomScenes) {
  for (const auto families : {smoothFamilies(), harshFamilies()}) {
    for (const SceneFamily& family : families) {
      Tally result;
      for (std::size_t i = 0; i < lengthened(2000); ++i) {
        KeyedRandom random(kSeed, family.name, i);
        tally(family.draw(random), view, result);
      }
      print(family.name, result);
      EXPECT_EQ(result.wrong, 0) << result.first_wrong;
      EXPECT_GT(result.cut, result.agreed / 4);
    }
  }
}

TEST(VisibleParts, AreThoseOfRationalArithmeticInCrowds) {
  Tally result;
  for (std::size_t i = 0; i < lengthened(100); ++i) {
    KeyedRandom random(kSeed, "crowd", i);
    tally(drawCrowd(random), view, result);
  }
  print("crowds", result);
  EXPECT_EQ(result.wrong, 0) << result.first_wrong;
  EXPECT_GT(result.parts, 4 * result.agreed);
}

TEST(VisibleParts, TheComparisonRejectsTwins) {
  const Viewer ignores_an_occluder = [](const FlatlandScene& scene) {
    std::vector<std::size_t> considered = everySegment(scene);
    considered.pop_back();
    return visibleParts(scene.segments, considered, scene.receiver);
  };
  const Viewer swaps_sides = [](const FlatlandScene& scene) {
    SegmentVisibility visibility = view(scene);
    for (VisiblePart& part : visibility.parts) std::swap(part.first, part.last);
    return visibility;
  };
  const Viewer rounds_to_single = [](const FlatlandScene& scene) {
    FlatlandScene rounded = scene;
    for (Segment& segment : rounded.segments) {
      for (Eigen::Vector2d& vertex : segment.vertices) vertex = vertex.cast<float>().cast<double>();
    }
    return view(rounded);
  };
  EXPECT_GT(tallyGrids(ignores_an_occluder, 200).wrong, 20);
  EXPECT_GT(tallyGrids(swaps_sides, 200).wrong, 100);
  Tally result;
  for (std::size_t i = 0; i < 300; ++i) {
    KeyedRandom random(kSeed, "ends almost in line", i);
    tally(harshFamilies()[0].draw(random), rounds_to_single, result);
  }
  EXPECT_GT(result.wrong, 5);
}

}  // namespace
}  // namespace irradiff
