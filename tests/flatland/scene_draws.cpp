#include "tests/flatland/scene_draws.h"

#include "derivatives/scene/orientation.h"
#include "verification/checks/flatland_inputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

namespace irradiff {
namespace {

using Eigen::Vector2d;

Segment segmentBetween(const Vector2d& a, const Vector2d& b, double radiance) { return {"segment", {a, b}, radiance}; }

double drawRadiance(KeyedRandom& random) { return random.below(4) == 0 ? 0.0 : random.between(0.2, 2.0); }

Vector2d drawNormal(KeyedRandom& random) { return directionAt(random.between(0.0, 2.0 * std::numbers::pi)); }

FlatlandScene scatter(KeyedRandom& random, std::size_t count) {
  FlatlandScene scene;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d middle = drawPoint(random);
    const Vector2d half = random.between(0.05, 1.0) * drawNormal(random);
    scene.segments.push_back(segmentBetween(middle - half, middle + half, drawRadiance(random)));
  }
  scene.receiver = {0.5 * drawPoint(random), drawNormal(random)};
  return scene;
}

FlatlandScene drawScattered(KeyedRandom& random) { return scatter(random, 2 + random.below(11)); }

/// A closed polygon around the receiver and one or two triangles in it.
FlatlandScene drawRoom(KeyedRandom& random) {
  FlatlandScene scene;
  const auto addLoop = [&](const Vector2d& middle, double size, int corners) {
    std::vector<Vector2d> points;
    points.reserve(static_cast<std::size_t>(corners));
    for (int k = 0; k < corners; ++k) {
      points.push_back(middle + size * random.between(0.7, 1.3) *
                                    directionAt(2.0 * std::numbers::pi * (k + random.between(0.0, 0.6)) / corners));
    }
    for (std::size_t k = 0; k < points.size(); ++k) {
      scene.segments.push_back(segmentBetween(points[k], points[(k + 1) % points.size()], drawRadiance(random)));
    }
  };
  addLoop(Vector2d::Zero(), 2.0, 5);
  const std::size_t obstacles = 1 + random.below(2);
  for (std::size_t i = 0; i < obstacles; ++i) {
    addLoop(random.between(0.5, 1.0) * drawNormal(random), random.between(0.05, 0.3), 3);
  }
  scene.receiver = {0.2 * drawPoint(random), drawNormal(random)};
  return scene;
}

/// The receiver almost in line with two ends of the scene.
FlatlandScene drawNearEvent(KeyedRandom& random) {
  FlatlandScene scene = random.below(2) == 0 ? drawScattered(random) : drawRoom(random);
  const Vector2d& a = scene.segments[random.below(scene.segments.size())].vertices[random.below(2)];
  const Vector2d& b = scene.segments[random.below(scene.segments.size())].vertices[random.below(2)];
  if (a != b) {
    const Vector2d off = random.decade(-17.0, -3.0) * drawNormal(random);
    scene.receiver.position = a + random.between(-1.0, -0.2) * (b - a) + off;
    scene.receiver.normal = directionAt(std::atan2(b(1) - a(1), b(0) - a(0)) + random.between(-1.4, 1.4));
  }
  return scene;
}

/// The receiver close to a segment or to an end of one.
FlatlandScene drawClose(KeyedRandom& random) {
  FlatlandScene scene = random.below(2) == 0 ? drawScattered(random) : drawRoom(random);
  const auto& [a, b] = scene.segments[random.below(scene.segments.size())].vertices;
  const double along = random.below(2) == 0 ? 0.0 : random.between(0.1, 0.9);
  scene.receiver.position = a + along * (b - a) + random.decade(-12.0, -2.0) * drawNormal(random);
  return scene;
}

/// Segments through nearly the same line.
FlatlandScene drawFlatCrossings(KeyedRandom& random) {
  FlatlandScene scene;
  const std::size_t count = 2 + random.below(5);
  const double tilt = random.decade(-14.0, -1.0);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d left(random.between(-1.0, -0.5), 1.0 + tilt * random.between(-1.0, 1.0));
    const Vector2d right(random.between(0.5, 1.0), 1.0 + tilt * random.between(-1.0, 1.0));
    scene.segments.push_back(segmentBetween(left, right, drawRadiance(random)));
  }
  scene.receiver = {0.5 * drawPoint(random), directionAt(random.between(0.5, 2.5))};
  return scene;
}

/// Ends just above and below the horizon, at distances of many magnitudes.
FlatlandScene drawAtHorizon(KeyedRandom& random) {
  FlatlandScene scene;
  const std::size_t count = 2 + random.below(8);
  const double angle = random.between(0.0, 6.28);
  const Vector2d normal = directionAt(angle);
  const Vector2d tangent = directionAt(angle - 0.5 * std::numbers::pi);
  const Vector2d position = drawPoint(random);
  for (std::size_t i = 0; i < count; ++i) {
    const double distance = random.decade(-6.0, 6.0) * (random.below(2) == 0 ? 1.0 : -1.0);
    const double height = random.decade(-12.0, 0.0) * (random.below(2) == 0 ? 1.0 : -1.0);
    const Vector2d low = position + distance * (tangent + height * normal);
    const Vector2d high =
        position + std::abs(distance) * (random.between(-1.0, 1.0) * tangent + random.between(0.01, 1.0) * normal);
    scene.segments.push_back(segmentBetween(low, high, drawRadiance(random)));
  }
  scene.receiver = {position, normal};
  return scene;
}

constexpr std::array<SceneFamily, 2> kSmooth = {{{"scattered", drawScattered}, {"rooms", drawRoom}}};
constexpr std::array<SceneFamily, 4> kHarsh = {{{"ends almost in line", drawNearEvent},
                                                {"close to a segment", drawClose},
                                                {"flat crossings", drawFlatCrossings},
                                                {"at the horizon, many magnitudes", drawAtHorizon}}};

}  // namespace

std::span<const SceneFamily> smoothFamilies() { return kSmooth; }
std::span<const SceneFamily> harshFamilies() { return kHarsh; }

FlatlandScene drawCrowd(KeyedRandom& random) { return scatter(random, 40); }

FlatlandScene drawGrid(KeyedRandom& random) {
  constexpr std::array<double, 4> kRadiances = {0.0, 1.0, 1.7320508, 0.3183};
  const std::array<Vector2d, 8> normals = {Vector2d(0, 1), Vector2d(0, -1), Vector2d(1, 0),      Vector2d(-1, 0),
                                           {0.6, 0.8},     {-0.8, 0.6},     Vector2d(0.8, -0.6), Vector2d(-0.6, -0.8)};
  FlatlandScene scene;
  const std::size_t half = 2 + random.below(4);
  const auto size = static_cast<double>(half);
  const auto drawCell = [&random, half, size] {
    return Vector2d(static_cast<double>(random.below(2 * half + 1)) - size,
                    static_cast<double>(random.below(2 * half + 1)) - size);
  };
  const std::size_t count = 2 + random.below(11);
  while (scene.segments.size() < count) {
    // Every third begins where another ends.
    const Vector2d a = !scene.segments.empty() && random.below(3) == 0
                           ? scene.segments[random.below(scene.segments.size())].vertices[random.below(2)]
                           : drawCell();
    const Vector2d b = drawCell();
    if (a != b) scene.segments.push_back(segmentBetween(a, b, kRadiances[random.below(4)]));
  }
  do {
    scene.receiver = {drawCell() * (random.below(2) == 0 ? 1.0 : 0.5), normals[random.below(8)]};
    if (random.below(half) == 0) scene.receiver.position *= 3.0;
  } while (isOnASegment(scene) && random.below(20) != 0);
  if (isOnASegment(scene)) scene.receiver.position = Vector2d(size + 1.0, -size - 2.0);
  return scene;
}

std::string sceneLine(const FlatlandScene& scene) {
  std::ostringstream text;
  text.precision(17);
  text << R"({"format":"irradiff-scene","version":1,"dimension":2,"segments":[)";
  for (std::size_t i = 0; i < scene.segments.size(); ++i) {
    const auto& [a, b] = scene.segments[i].vertices;
    text << (i > 0 ? "," : "") << R"({"name":"s","vertices":[[)" << a(0) << ',' << a(1) << "],[" << b(0) << ',' << b(1)
         << R"(]],"radiance":)" << scene.segments[i].radiance << '}';
  }
  const FlatlandReceiver& r = scene.receiver;
  text << R"(],"points":[{"position":[)" << r.position(0) << ',' << r.position(1) << R"(],"normal":[)" << r.normal(0)
       << ',' << r.normal(1) << "]}]}";
  return text.str();
}

bool isOnASegment(const FlatlandScene& scene) {
  const Vector2d& x = scene.receiver.position;
  return std::any_of(scene.segments.begin(), scene.segments.end(), [&x](const Segment& s) {
    const auto& [a, b] = s.vertices;
    return orientation(a, b, x) == 0 && (x - a).dot(x - b) <= 0.0;
  });
}

}  // namespace irradiff
