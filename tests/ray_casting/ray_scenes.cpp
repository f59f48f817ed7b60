#include "tests/ray_casting/ray_scenes.h"

#include "verification/checks/random.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace irradiff {

SampleFrame frameAt(const Receiver& receiver, std::uint64_t seed) {
  KeyedRandom random(seed, "frame", 0);
  const double angle = random.between(0.0, 2.0 * std::numbers::pi);
  const Eigen::Vector3d u = receiver.normal.unitOrthogonal();
  const Eigen::Vector3d v = receiver.normal.cross(u);
  const Eigen::Vector3d tangent = std::cos(angle) * u + std::sin(angle) * v;
  return {receiver.position, tangent, receiver.normal.cross(tangent), receiver.normal};
}

HemisphereSamples randomDirections(const SampleFrame& frame, std::uint64_t seed, std::size_t count) {
  std::vector<Eigen::Vector3d> directions;
  for (std::size_t i = 0; i < count; ++i) {
    KeyedRandom random(seed, "rays", i);
    const double squared_sine = random.unit();
    const double azimuth = random.between(0.0, 2.0 * std::numbers::pi);
    const double sine = std::sqrt(squared_sine);
    directions.emplace_back(sine * std::cos(azimuth), sine * std::sin(azimuth), std::sqrt(1.0 - squared_sine));
  }
  return samplesAlong(frame, directions);
}

HemisphereSamples samplesAlong(const SampleFrame& frame, std::span<const Eigen::Vector3d> directions) {
  HemisphereSamples samples;
  samples.frame = frame;
  samples.shape = {1, directions.size()};
  for (const Eigen::Vector3d& direction : directions) {
    const Eigen::Vector3d unit = direction.normalized();
    samples.direction_t.push_back(unit.x());
    samples.direction_b.push_back(unit.y());
    samples.direction_n.push_back(unit.z());
  }
  return samples;
}

std::vector<Polygon> scatteredSquares(std::uint64_t seed, std::size_t count) {
  std::vector<Polygon> polygons;
  for (std::size_t i = 0; i < count; ++i) {
    KeyedRandom random(seed, "square", i);
    const Eigen::Vector3d centre = random.between(0.5, 4.0) * random.direction();
    const Eigen::Vector3d normal = random.direction();
    const double size = random.between(0.1, 0.6);
    const Eigen::Vector3d u = size * normal.unitOrthogonal();
    const Eigen::Vector3d v = normal.cross(u);
    polygons.push_back(
        {"square", {centre - u - v, centre + u - v, centre + u + v, centre - u + v}, static_cast<double>(i + 1)});
  }
  return polygons;
}

std::vector<Polygon> closedSurface(std::uint64_t seed, int levels) {
  using Triangle = std::array<std::size_t, 3>;
  std::vector<Eigen::Vector3d> vertices{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  std::vector<Triangle> triangles;
  for (const std::size_t x : {0U, 3U}) {
    for (const std::size_t y : {1U, 4U}) {
      for (const std::size_t z : {2U, 5U}) triangles.push_back({x, y, z});
    }
  }
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
    const auto middleOf = [&](std::size_t a, std::size_t b) {
      const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), vertices.size());
      if (is_new) vertices.push_back((vertices[a] + vertices[b]).normalized());
      return place->second;
    };
    std::vector<Triangle> divided;
    for (const auto& [a, b, c] : triangles) {
      const std::size_t ab = middleOf(a, b);
      const std::size_t bc = middleOf(b, c);
      const std::size_t ca = middleOf(c, a);
      divided.insert(divided.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(divided);
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    KeyedRandom random(seed, "vertex", i);
    // Turned by a little first: no coordinate stays 0 or equal to another.
    vertices[i] = random.between(1.0, 2.0) * (vertices[i] + 0.02 * random.direction());
  }
  std::vector<Polygon> polygons;
  polygons.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) polygons.push_back({"part", {vertices[a], vertices[b], vertices[c]}, 1.0});
  return polygons;
}

}  // namespace irradiff
