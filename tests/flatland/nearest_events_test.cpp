// The distance to the nearest visibility event in flatland, against what moves of the receiver make of the view.

#include "derivatives/flatland/nearest_events.h"

#include "derivatives/flatland/segment_visibility.h"
#include "derivatives/scene/invalid_scene.h"
#include "tests/flatland/scene_draws.h"
#include "verification/checks/input_families.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>

namespace irradiff {
namespace {

using Eigen::Vector2d;

constexpr std::uint64_t kSeed = 20120806;
constexpr std::size_t kKept = 8;

/// Where something of a view begins or ends: a point of the scene, whatever segment it is taken for.
using PointKey = std::tuple<int, double, double>;

PointKey keyOf(const FlatlandScene& scene, const BoundaryPoint& point) {
  switch (point.kind) {
    case BoundaryPoint::Kind::kEnd: {
      const Vector2d& end = scene.segments[point.segment].vertices[point.end];
      return {0, end(0), end(1)};
    }
    case BoundaryPoint::Kind::kCrossing:
      return {1, static_cast<double>(std::min(point.segment, point.other)),
              static_cast<double>(std::max(point.segment, point.other))};
    case BoundaryPoint::Kind::kHorizon:
      return {2, static_cast<double>(point.segment), 0.0};
  }
  return {};
}

using View = std::vector<std::tuple<std::size_t, PointKey, PointKey>>;

/// Nothing where the library refuses the receiver.
std::optional<View> viewFrom(const FlatlandScene& scene, const Vector2d& position) {
  try {
    std::vector<std::size_t> all(scene.segments.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    View view;
    for (const VisiblePart& part : visibleParts(scene.segments, all, {position, scene.receiver.normal}).parts) {
      view.emplace_back(part.segment, keyOf(scene, part.first), keyOf(scene, part.last));
    }
    return view;
  } catch (const InvalidScene&) {
    return std::nullopt;
  }
}

struct Found {
  std::size_t scenes = 0;
  std::size_t changed = 0;
  std::size_t confirmed = 0;
};

Found judge(const SceneFamily& family, std::size_t count, std::optional<EventKind> without) {
  Found found;
  for (std::size_t k = 0; k < count; ++k) {
    KeyedRandom random(kSeed, family.name, k);
    const FlatlandScene scene = family.draw(random);
    const Vector2d& x = scene.receiver.position;
    const VisibilityEvents<2> events = nearestEvents(scene.segments, scene.receiver, kKept);
    const auto first = std::ranges::find_if(events, [&](const auto& event) { return event.kind != without; });
    const double distance = first == events.end() ? std::numeric_limits<double>::infinity() : first->distance;
    const std::optional<View> here = viewFrom(scene, x);
    // A move that the coordinates of the scene cannot express is none.
    double largest = x.cwiseAbs().maxCoeff();
    for (const Segment& segment : scene.segments) {
      for (const Vector2d& end : segment.vertices) largest = std::max(largest, end.cwiseAbs().maxCoeff());
    }
    if (!here || !(distance > 1e-12 * largest)) continue;
    ++found.scenes;
    const double reach = 0.999 * std::min(distance, 10.0 * largest);
    for (int i = 0; i < 60; ++i) {
      const double angle = random.between(0.0, 6.283185307179586);
      const auto there = viewFrom(scene, x + reach * Vector2d(std::cos(angle), std::sin(angle)));
      if (!there || *there == *here) continue;
      ++found.changed;
      if (!without) ADD_FAILURE() << distance << ' ' << events.front().what << '\n' << sceneLine(scene);
      break;
    }
    found.confirmed += std::ranges::any_of(events, [&](const VisibilityEvent<2>& event) {
      return viewFrom(scene, x + 1.001 * event.displacement) != here;
    });
  }
  return found;
}

std::vector<SceneFamily> families() {
  std::vector<SceneFamily> all(smoothFamilies().begin(), smoothFamilies().end());
  all.insert(all.end(), harshFamilies().begin(), harshFamilies().end());
  return all;
}

TEST(FlatlandNearestEvents, NothingChangesNearer) {
  std::size_t scenes = 0;
  for (const SceneFamily& family : families()) {
    const Found found = judge(family, lengthened(200), std::nullopt);
    std::cout << family.name << ": of " << found.scenes << " scenes one of the first events changes the view in "
              << found.confirmed << '\n';
    EXPECT_GE(found.confirmed, found.scenes * 9 / 10) << family.name;
    scenes += found.scenes;
  }
  EXPECT_GE(scenes, lengthened(600));
}

TEST(FlatlandNearestEvents, EachKindIsNeeded) {
  for (const EventKind kind : {EventKind::kVertexOnEdge, EventKind::kEdgeOn, EventKind::kHorizon}) {
    std::size_t changed = 0;
    for (const SceneFamily& family : families()) changed += judge(family, 100, kind).changed;
    EXPECT_GE(changed, 10U) << static_cast<int>(kind);
  }
}

TEST(FlatlandNearestEvents, OfALampBehindAScreen) {
  const std::vector<Segment> scene = {{"lamp", {Vector2d(-1, 2), Vector2d(1, 2)}, 1.0},
                                      {"screen", {Vector2d(-0.25, 1), Vector2d(0.25, 1)}, 0.0}};
  const VisibilityEvents<2> events = nearestEvents(scene, {Vector2d(0.1, 0.0), Vector2d(0, 1)}, kKept);
  // The line through the left ends comes to y = 0 at x = 0.5 with the slope 4 : 3.
  EXPECT_EQ(events.front().what, "an end of segments[1] \"screen\" and an end of segments[0] \"lamp\" come into line");
  EXPECT_NEAR(events.front().distance, 0.8 * 0.4, 1e-15);
  const auto end_on = std::ranges::find(events, EventKind::kEdgeOn, &VisibilityEvent<2>::kind);
  ASSERT_NE(end_on, events.end());
  EXPECT_DOUBLE_EQ(end_on->distance, 1.0);
  EXPECT_EQ(end_on->what, "segments[1] \"screen\" is seen end-on");
}

}  // namespace
}  // namespace irradiff
