#include "tests/visibility/degenerate_scenes.h"

#include "verification/checks/random.h"
#include "verification/exact_boundary/rational_geometry.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>

namespace irradiff {

namespace {

using Eigen::Vector3d;

// From low to high, both included.
double integer(KeyedRandom& random, int low, int high) {
  return low + static_cast<double>(random.below(static_cast<std::size_t>(high - low) + 1));
}

Vector3d latticePoint(KeyedRandom& random, int size) {
  const double x = integer(random, -size, size);
  const double y = integer(random, -size, size);
  return {x, y, integer(random, -size, size)};
}

// Along an axis, or tilted so that it is of length 1 to rounding.
Vector3d latticeNormal(KeyedRandom& random) {
  static const std::array<Vector3d, 3> kNormals{Vector3d(0, 0, 1), Vector3d(0.6, 0, 0.8), Vector3d(2, 3, 6) / 7.0};
  Vector3d normal = kNormals[random.below(3)];
  for (std::size_t turns = random.below(3); turns > 0; --turns) normal = Vector3d(normal.y(), normal.z(), normal.x());
  return random.below(2) == 0 ? normal : Vector3d(-normal);
}

Vector3d anyPoint(KeyedRandom& random) {
  const double x = random.between(-1.0, 1.0);
  const double y = random.between(-1.0, 1.0);
  return {x, y, random.between(-1.0, 1.0)};
}

// A radiance for each polygon.
void setDistinctRadiances(std::vector<Polygon>& polygons) {
  for (std::size_t i = 0; i < polygons.size(); ++i) polygons[i].radiance = 1.0 + static_cast<double>(i) / 8.0;
}

// A radiance for each plane, so that what overlaps in one is no contradiction; `count` different ones.
void setRadiancesOfPlanes(std::vector<Polygon>& polygons, std::size_t count, double lowest) {
  std::map<std::pair<RationalVector, Rational>, std::size_t> planes;
  for (Polygon& polygon : polygons) {
    const RationalVector a = rational(polygon.vertices[0]);
    const RationalVector normal =
        withoutScale(cross(rational(polygon.vertices[1]) - a, rational(polygon.vertices[2]) - a));
    const std::size_t plane = planes.try_emplace({normal, dot(normal, a)}, planes.size()).first->second;
    polygon.radiance = lowest + static_cast<double>(plane % count) / 8.0;
  }
}

SceneWithReceivers triangles(KeyedRandom& random) {
  SceneWithReceivers scene;
  const std::size_t count = 3 + random.below(4);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d a = anyPoint(random);
    const Vector3d b = anyPoint(random);
    scene.polygons.push_back({"triangle", {a, b, anyPoint(random)}, 0.0});
  }
  setDistinctRadiances(scene.polygons);
  for (int i = 0; i < 3; ++i) {
    const Vector3d position = anyPoint(random);
    scene.receivers.push_back({position, random.direction()});
  }
  return scene;
}

std::vector<Polygon> latticePolygons(KeyedRandom& random) {
  std::vector<Polygon> polygons;
  const std::size_t count = 3 + random.below(4);
  while (polygons.size() < count) {
    const Vector3d a = latticePoint(random, 2);
    const Vector3d b = latticePoint(random, 2);
    const Vector3d c = latticePoint(random, 2);
    if ((b - a).cross(c - a).isZero()) continue;
    if (random.below(2) == 0) {
      polygons.push_back({"triangle", {a, b, c}, 0.0});
    } else {
      polygons.push_back({"parallelogram", {a, b, c, a + c - b}, 0.0});
    }
  }
  return polygons;
}

std::vector<Receiver> latticeReceivers(KeyedRandom& random) {
  std::vector<Receiver> receivers;
  for (int i = 0; i < 3; ++i) {
    const Vector3d position = latticePoint(random, 4) / 2.0;
    receivers.push_back({position, latticeNormal(random)});
  }
  return receivers;
}

SceneWithReceivers lattice(KeyedRandom& random) {
  SceneWithReceivers scene{latticePolygons(random), latticeReceivers(random)};
  if (random.below(4) == 0) {
    setDistinctRadiances(scene.polygons);
  } else {
    setRadiancesOfPlanes(scene.polygons, scene.polygons.size(), 1.0);
  }
  return scene;
}

SceneWithReceivers dark(KeyedRandom& random) {
  SceneWithReceivers scene{latticePolygons(random), latticeReceivers(random)};
  setRadiancesOfPlanes(scene.polygons, 3, 0.0);
  return scene;
}

void addBox(std::vector<Polygon>& polygons, const Vector3d& low, const Vector3d& high, bool has_bottom) {
  const auto corner = [&](bool x, bool y, bool z) {
    return Vector3d(x ? high.x() : low.x(), y ? high.y() : low.y(), z ? high.z() : low.z());
  };
  polygons.push_back(
      {"top",
       {corner(false, false, true), corner(true, false, true), corner(true, true, true), corner(false, true, true)},
       0.0});
  if (has_bottom) {
    polygons.push_back({"bottom",
                        {corner(false, false, false), corner(true, false, false), corner(true, true, false),
                         corner(false, true, false)},
                        0.0});
  }
  for (const bool side : {false, true}) {
    polygons.push_back(
        {"side",
         {corner(side, false, false), corner(side, true, false), corner(side, true, true), corner(side, false, true)},
         0.0});
    polygons.push_back(
        {"side",
         {corner(false, side, false), corner(true, side, false), corner(true, side, true), corner(false, side, true)},
         0.0});
  }
}

SceneWithReceivers boxes(KeyedRandom& random) {
  SceneWithReceivers scene;
  scene.polygons.push_back({"floor", {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}}, 0.0});
  const std::size_t count = 1 + random.below(2);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d low(integer(random, -3, 2), integer(random, -3, 2), random.below(4) == 0 ? 1.0 : 0.0);
    const double width = integer(random, 1, 2);
    const double depth = integer(random, 1, 2);
    addBox(scene.polygons, low, low + Vector3d(width, depth, integer(random, 1, 2)), random.below(2) == 0);
  }
  setDistinctRadiances(scene.polygons);
  for (int i = 0; i < 2; ++i) {
    const double x = integer(random, -8, 8) / 2.0;
    const double y = integer(random, -8, 8) / 2.0;
    scene.receivers.push_back({{x, y, 0.0}, {0, 0, 1}});
    const Vector3d above = latticePoint(random, 6) / 2.0;
    scene.receivers.push_back({{above.x(), above.y(), above.z() + 3.5}, latticeNormal(random)});
  }
  return scene;
}

void addTiles(std::vector<Polygon>& polygons, KeyedRandom& random, const std::array<double, 4>& bounds, double height,
              int depth) {
  const auto& [x0, x1, y0, y1] = bounds;
  const bool across = random.below(2) == 0;
  const double extent = across ? x1 - x0 : y1 - y0;
  if (depth == 0 || extent < 2.0) {
    polygons.push_back({"tile", {{x0, y0, height}, {x1, y0, height}, {x1, y1, height}, {x0, y1, height}}, 0.0});
    return;
  }
  const double cut = (across ? x0 : y0) + integer(random, 1, static_cast<int>(extent) - 1);
  if (across) {
    addTiles(polygons, random, {x0, cut, y0, y1}, height, depth - 1);
    addTiles(polygons, random, {cut, x1, y0, y1}, height, depth - 1);
  } else {
    addTiles(polygons, random, {x0, x1, y0, cut}, height, depth - 1);
    addTiles(polygons, random, {x0, x1, cut, y1}, height, depth - 1);
  }
}

SceneWithReceivers tiles(KeyedRandom& random) {
  SceneWithReceivers scene;
  for (const double height : {1.0, 2.0}) {
    const double x = integer(random, -3, 0);
    const double y = integer(random, -3, 0);
    addTiles(scene.polygons, random, {x, x + integer(random, 2, 4), y, y + integer(random, 2, 4)}, height, 2);
  }
  setDistinctRadiances(scene.polygons);
  for (int i = 0; i < 3; ++i) {
    const double x = integer(random, -6, 6) / 2.0;
    const double y = integer(random, -6, 6) / 2.0;
    const Vector3d position(x, y, random.below(4) == 0 ? 1.5 : 0.0);
    scene.receivers.push_back({position, random.below(2) == 0 ? Vector3d(0, 0, 1) : latticeNormal(random)});
  }
  return scene;
}

SceneWithReceivers blades(KeyedRandom& random) {
  using Outline = std::vector<std::array<double, 2>>;
  static const std::array<Outline, 4> kOutlines{
      Outline{{0, 0}, {3, 0}, {3, 2}, {0, 2}}, Outline{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}},
      Outline{{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}},
      Outline{{0, 0}, {4, 0}, {4, 1}, {3, 1}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}};
  SceneWithReceivers scene;
  const std::size_t count = 2 + random.below(3);
  for (std::size_t i = 0; i < count; ++i) {
    const Outline& outline = kOutlines[random.below(kOutlines.size())];
    const auto axis = static_cast<Eigen::Index>(random.below(3));
    const Vector3d corner = latticePoint(random, 1) - Vector3d(1, 1, 1);
    // Half of them oblique, so that creases are not on the lattice.
    const double slope = random.below(2) == 0 ? 0.0 : integer(random, -1, 1) / 2.0;
    Polygon polygon{"blade", {}, 0.0};
    for (const auto& [u, v] : outline) {
      Vector3d point = corner;
      point((axis + 1) % 3) += u;
      point((axis + 2) % 3) += v;
      point(axis) += 1.0 + slope * u;
      polygon.vertices.push_back(point);
    }
    scene.polygons.push_back(polygon);
  }
  if (random.below(4) == 0) {
    setDistinctRadiances(scene.polygons);
  } else {
    setRadiancesOfPlanes(scene.polygons, scene.polygons.size(), 1.0);
  }
  for (int i = 0; i < 3; ++i) {
    const Vector3d position =
        random.below(2) == 0 ? Vector3d(latticePoint(random, 6) / 2.0) : Vector3d(3.0 * anyPoint(random));
    scene.receivers.push_back({position, latticeNormal(random)});
  }
  return scene;
}

}  // namespace

const std::vector<SceneFamily>& degenerateSceneFamilies() {
  static const std::vector<SceneFamily> kFamilies{{"triangles", triangles}, {"lattice", lattice}, {"boxes", boxes},
                                                  {"tiles", tiles},         {"blades", blades},   {"dark", dark}};
  return kFamilies;
}

}  // namespace irradiff
