#include "tests/exact_visibility/random_scene.h"

#include "verification/checks/random.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

namespace irradiff {

namespace {

double rounded(double value, double unit) { return std::round(value / unit) * unit; }

Eigen::Vector3d rounded(const Eigen::Vector3d& v, double unit) {
  return {rounded(v.x(), unit), rounded(v.y(), unit), rounded(v.z(), unit)};
}

Polygon star(KeyedRandom& random, const std::string& name, double radiance, const Eigen::Vector3d& centre,
             double size) {
  const Eigen::Vector3d normal = random.direction();
  const Eigen::Vector3d u = rounded(Eigen::Vector3d(normal.unitOrthogonal() * size), 0x1p-5);
  const Eigen::Vector3d v = rounded(Eigen::Vector3d(normal.cross(normal.unitOrthogonal()) * size), 0x1p-5);
  const std::size_t corners = 3 + random.below(5);
  Polygon polygon{name, {}, radiance};
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
    const double radius = random.between(0.5, 1.0);
    const double a = rounded(radius * std::cos(angle), 0x1p-5);
    const double b = rounded(radius * std::sin(angle), 0x1p-5);
    polygon.vertices.push_back(rounded(centre, 0x1p-5) + a * u + b * v);
  }
  return polygon;
}

Eigen::Vector3i latticePoint(KeyedRandom& random) {
  const auto coordinate = [&random] { return static_cast<int>(random.below(5)) - 2; };
  return {coordinate(), coordinate(), coordinate()};
}

// 0, 1/4, 1/2, 3/4 or 1. `plane` is a normal and what its product with a point of the plane is.
double radianceOf(Eigen::Vector4i plane) {
  int divisor = 0;
  for (const int number : plane) divisor = std::gcd(divisor, number);
  plane /= divisor;
  const auto sign = std::ranges::find_if(plane, [](int number) { return number != 0; });
  const int key = (*sign < 0 ? -1 : 1) * plane.dot(Eigen::Vector4i(1, 3, 7, 2));
  return static_cast<double>((key % 5 + 5) % 5) / 4.0;
}

}  // namespace

RandomScene randomScene(std::uint64_t seed, std::size_t index, std::size_t occluders) {
  KeyedRandom random(seed, "exact visibility", index);
  RandomScene scene;
  scene.receiver.position = rounded(random.direction(), 0x1p-10);
  scene.receiver.normal = random.direction();
  // Up to the horizon and a little below.
  const Eigen::Vector3d towards = (scene.receiver.normal + 1.05 * random.direction()).normalized();
  scene.polygons.push_back(star(random, "emitter", 1.0, scene.receiver.position + 2.0 * towards, 2.5));
  for (std::size_t i = 0; i < occluders; ++i) {
    const Eigen::Vector3d offset = 1.2 * towards + 0.5 * random.direction();
    const double radiance = random.below(2) == 0 ? 0.0 : random.between(0.1, 0.5);
    scene.polygons.push_back(star(random, "occluder", radiance, scene.receiver.position + offset, 0.6));
  }
  return scene;
}

RandomScene latticeScene(std::uint64_t seed, std::size_t index, std::size_t triangles) {
  KeyedRandom random(seed, "lattice", index);
  RandomScene scene;
  scene.receiver = {latticePoint(random).cast<double>(),
                    Eigen::Vector3d::Unit(static_cast<Eigen::Index>(random.below(3)))};
  if (random.below(2) == 0) scene.receiver.normal *= -1.0;
  while (scene.polygons.size() < triangles) {
    const Eigen::Vector3i a = latticePoint(random);
    const Eigen::Vector3i b = latticePoint(random);
    const Eigen::Vector3i c = latticePoint(random);
    const Eigen::Vector3i normal = (b - a).cross(c - a);
    if (normal.isZero()) continue;
    const double radiance = radianceOf({normal.x(), normal.y(), normal.z(), normal.dot(a)});
    scene.polygons.push_back({"triangle", {a.cast<double>(), b.cast<double>(), c.cast<double>()}, radiance});
  }
  return scene;
}

}  // namespace irradiff
