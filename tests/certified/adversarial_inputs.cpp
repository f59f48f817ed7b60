#include "tests/certified/adversarial_inputs.h"

#include "verification/checks/input_families.h"
#include "verification/checks/random.h"

#include <array>
#include <cmath>
#include <exception>

namespace irradiff {
namespace {

using Eigen::Vector3d;

void stretchAxes(Configuration& c, KeyedRandom& random) {
  for (int axis = 0; axis < 3; ++axis) {
    const int exponent = static_cast<int>(random.below(41)) - 20;
    for (Vector3d& vertex : c.polygon.vertices) vertex(axis) = std::ldexp(vertex(axis), exponent);
    c.receiver.position(axis) = std::ldexp(c.receiver.position(axis), exponent);
  }
}

/// A vertex and the edge that leaves it.
std::array<Vector3d, 2> anEdge(const Configuration& c, KeyedRandom& random) {
  const auto& vertices = c.polygon.vertices;
  const std::size_t i = random.below(vertices.size());
  return {vertices[i], vertices[(i + 1) % vertices.size()] - vertices[i]};
}

void strike(Configuration& c, KeyedRandom& random) {
  const auto [start, edge] = anEdge(c, random);
  Receiver& receiver = c.receiver;
  switch (random.below(8)) {
    case 0:
      break;
    case 1:
      stretchAxes(c, random);
      break;
    case 2:
      // In the line of the edge, to rounding or exactly.
      receiver.position = start - std::ldexp(1.0, static_cast<int>(random.below(6)) - 2) * edge;
      break;
    case 3:
      // Beside the line of the edge by next to nothing.
      receiver.position = start - random.between(0.1, 2.0) * edge + random.decade(-18.0, -6.0) * random.direction();
      break;
    case 4:
      // Beside the edge itself.
      receiver.position = start + random.unit() * edge + random.decade(-14.0, -2.0) * random.direction();
      break;
    case 5:
      receiver.normal = Vector3d::Unit(static_cast<Eigen::Index>(random.below(3)));
      if (random.below(2) == 0) receiver.normal = -receiver.normal;
      receiver.position(0) = start(0);
      break;
    case 6:
      // The horizon almost through a vertex and along an edge.
      receiver.normal = (edge.cross(start - receiver.position) + random.decade(-18.0, -1.0) * random.direction());
      receiver.normal.normalize();
      break;
    default:
      // Almost in the polygon's plane.
      receiver.position = start + random.between(-2.0, 2.0) * edge + random.between(-2.0, 2.0) * anEdge(c, random)[1] +
                          random.decade(-16.0, -4.0) * random.direction();
      break;
  }
}

}  // namespace

std::optional<Configuration> adversarialInput(std::uint64_t seed, std::size_t index) {
  KeyedRandom random(seed, "adversarial", index);
  const auto& families = inputFamilies();
  Configuration c = families[index % families.size()].draw(random);
  strike(c, random);
  try {
    validate(c.polygon, 0);
    validate(c.receiver, 0);
  } catch (const std::exception&) {
    return std::nullopt;
  }
  return c;
}

}  // namespace irradiff
