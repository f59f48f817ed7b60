#include "verification/report/sweep_inputs.h"

#include "verification/checks/random.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace irradiff {
namespace {

using Eigen::Vector3d;

Vector3d roundedDirection(KeyedRandom& random) {
  return random.direction().unaryExpr([](double v) { return std::ldexp(std::round(std::ldexp(v, 20)), -20); });
}

/// A triangle or parallelogram whose vertices are exact sums of directions with 20-bit components: planar to the last
/// bit.
struct Shape {
  std::vector<Vector3d> vertices;
  Vector3d a, b;

  Vector3d at(double s, double t) const { return s * a + t * b; }
  Vector3d planeNormal() const { return a.cross(b).normalized(); }
};

Shape drawShape(KeyedRandom& random) {
  for (;;) {
    const Vector3d a = roundedDirection(random);
    const Vector3d b = roundedDirection(random);
    if (a.cross(b).norm() < 0.5 * a.norm() * b.norm()) {
      continue;
    }
    Shape shape{{Vector3d::Zero(), a, b}, a, b};
    if (random.below(2) == 0) {
      shape.vertices.insert(shape.vertices.begin() + 2, a + b);
    }
    return shape;
  }
}

bool isAboveHorizon(const Shape& shape, const Vector3d& position, const Vector3d& normal) {
  return std::all_of(shape.vertices.begin(), shape.vertices.end(),
                     [&](const Vector3d& v) { return normal.dot(v - position) > 0.05 * (v - position).norm(); });
}

/// A unit normal about the mean direction to the vertices.
Vector3d normalTowards(KeyedRandom& random, const Shape& shape, const Vector3d& position) {
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& v : shape.vertices) {
    mean += (v - position).normalized();
  }
  return (mean.normalized() + 0.3 * random.direction()).normalized();
}

Configuration configurationOf(const Shape& shape, const Vector3d& position, const Vector3d& normal) {
  return {{"polygon", shape.vertices, 1.0}, {position, normal}};
}

Configuration drawEdgeOverDistance(KeyedRandom& random, double ratio) {
  const Shape shape = drawShape(random);
  const Vector3d up = shape.planeNormal();
  const double distance = 1.0 / ratio;
  const Vector3d side = up.cross(random.direction()).normalized();
  const double tilt = random.between(0.0, 1.0);
  const Vector3d position = shape.at(0.25, 0.25) + distance * (std::cos(tilt) * up + std::sin(tilt) * side);
  // The wider the polygon spreads, the less the normal may lean before part of it sinks below the horizon.
  const double lean = 0.3 * std::min(1.0, distance);
  return configurationOf(shape, position, (-up + lean * random.direction()).normalized());
}

Configuration drawSineToRay(KeyedRandom& random, double sine) {
  for (;;) {
    const Shape shape = drawShape(random);
    const std::size_t count = shape.vertices.size();
    const std::size_t i = random.below(count);
    const Vector3d e = shape.vertices[(i + 1) % count] - shape.vertices[i];
    const Vector3d up = shape.planeNormal();
    const Vector3d across = (e.normalized().cross(up) + random.between(0.3, 2.0) * up).normalized();
    // A step of 16/32 to 48/32 of the edge: a multiple that the 20-bit components absorb without rounding.
    const double step = std::ldexp(std::round(random.between(16.0, 48.0)), -5);
    const double distance = step * e.norm();
    const double foot = distance * std::sqrt(1.0 - sine * sine) / e.norm();
    const Vector3d along = sine < 1e-6 ? Vector3d(step * e) : Vector3d(foot * e);
    const Vector3d position = shape.vertices[i] - along + across * (sine * distance);
    const Vector3d normal = normalTowards(random, shape, position);
    if (isAboveHorizon(shape, position, normal)) {
      return configurationOf(shape, position, normal);
    }
  }
}

Configuration drawHeightOverPlane(KeyedRandom& random, double height) {
  const Shape shape = drawShape(random);
  const Vector3d up = shape.planeNormal();
  const Vector3d position = shape.at(random.between(-1.0, -0.3), random.between(-0.25, 1.25)) - height * up;
  // So parallel that F goes as the square of the height, its gradient as the height: what cancels most.
  return configurationOf(shape, position, (up + 0.1 * height * random.direction()).normalized());
}

Configuration drawDistanceToEdge(KeyedRandom& random, double distance) {
  const Shape shape = drawShape(random);
  const std::size_t count = shape.vertices.size();
  const std::size_t i = random.below(count);
  const Vector3d& start = shape.vertices[i];
  const Vector3d e = shape.vertices[(i + 1) % count] - start;
  const Vector3d up = shape.planeNormal();
  Vector3d inward = up.cross(e).normalized();
  if (inward.dot(shape.vertices[(i + 2) % count] - start) < 0.0) {
    inward = -inward;
  }
  // The receiver is behind the edge and below the plane, its normal looks across the edge: all is above the horizon.
  const double lean = random.between(0.3, 1.2);
  const double offset = random.between(0.3, 1.2);
  const Vector3d normal = (std::cos(lean) * inward + std::sin(lean) * up).normalized();
  const Vector3d position =
      start + random.between(0.2, 0.8) * e - distance * (std::cos(offset) * inward + std::sin(offset) * up);
  return configurationOf(shape, position, normal);
}

Configuration drawVisibleCorner(KeyedRandom& random, double size) {
  for (;;) {
    const Shape shape = drawShape(random);
    const std::size_t count = shape.vertices.size();
    const Vector3d position = roundedDirection(random) * std::ldexp(std::round(random.between(16.0, 32.0)), -4);
    const std::size_t top = random.below(count);
    const Vector3d r = shape.vertices[top] - position;
    Vector3d across = random.direction();
    across -= r * (across.dot(r) / r.squaredNorm());
    const double sine = 0.5 * size / r.norm();
    const Vector3d normal = (across.normalized() * std::sqrt(1.0 - sine * sine) + r.normalized() * sine).normalized();
    const auto height = [&](std::size_t k) { return normal.dot(shape.vertices[k % count] - position); };
    bool others_below = height(top) > 0.0;
    for (std::size_t k = 1; k < count; ++k) {
      others_below = others_below && height(top + k) < -0.1;
    }
    if (others_below && std::abs(shape.planeNormal().dot(position)) > 0.2) {
      return configurationOf(shape, position, normal);
    }
  }
}

}  // namespace

const std::vector<SweepInputs>& sweepInputs() {
  static const std::vector<SweepInputs> all = {
      {"edge over distance", "edge_over_distance", "edge length / distance of the receiver (1)",
       "The receiver faces a triangle or parallelogram, from far away (left) to close above it (right).", -8, 6, true,
       1e-13, 1e-13, drawEdgeOverDistance},
      {"sine of the edge's angle to the ray", "sine_to_ray", "sine of the angle between an edge and the ray to it (1)",
       "One edge points nearly at the receiver.", -12, 0, true, 1e-13, 1e-13, drawSineToRay},
      {"height over the plane", "height_over_plane", "height over the polygon's plane / edge length (1)",
       "The receiver is beside the polygon, almost in its plane and parallel to it: F goes as the square of the "
       "height, "
       "the gradient as the height. Within 1e-6 of the plane the gradient is promised only to its claimed bound.",
       -12, 0, true, 0.0, 1e-13, drawHeightOverPlane},
      {"distance to an edge", "distance_to_edge", "distance to an edge / edge length (1)",
       "The receiver is close to the inside of an edge.", -12, 0, true, 1e-13, 1e-13, drawDistanceToEdge},
      {"visible corner at the horizon", "visible_corner", "height of the visible corner / edge length (1)",
       "All of the polygon is below the receiver's horizon but for one corner. The appendix form knows no horizon.",
       -10, -1, false, 1e-13, 1e-13, drawVisibleCorner},
  };
  return all;
}

}  // namespace irradiff
