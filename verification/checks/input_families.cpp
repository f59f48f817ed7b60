#include "verification/checks/input_families.h"

#include "verification/checks/random.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace irradiff {
namespace {

using Eigen::Vector3d;

/// A polygon in the lattice of two directions with 20-bit components: its vertices are exact sums, so that it is planar
/// to the last bit.
struct Lattice {
  Vector3d a, b;
  std::vector<std::array<double, 2>> outline;

  Vector3d at(double s, double t) const { return s * a + t * b; }
  Vector3d unitNormal() const { return a.cross(b).normalized(); }
  std::vector<Vector3d> vertices() const {
    std::vector<Vector3d> result;
    for (const auto& [s, t] : outline) {
      result.push_back(at(s, t));
    }
    return result;
  }
};

Vector3d rounded(const Vector3d& v, int bits) {
  const auto round_one = [bits](double value) { return std::ldexp(std::round(std::ldexp(value, bits)), -bits); };
  return {round_one(v(0)), round_one(v(1)), round_one(v(2))};
}

const std::vector<std::vector<std::array<double, 2>>>& outlines() {
  static const std::vector<std::vector<std::array<double, 2>>> all = [] {
    std::vector<std::vector<std::array<double, 2>>> shapes = {
        {{0, 0}, {1, 0}, {0, 1}},
        {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
        {{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}},
        {{0, 0}, {0.5, 0.25}, {1, 0}, {0.75, 0.5}, {1, 1}, {0.5, 0.75}, {0, 1}, {0.25, 0.5}},
    };
    std::vector<std::array<double, 2>> round;
    for (int k = 0; k < 16; ++k) {
      const double angle = 2.0 * M_PI * k / 16.0;
      round.push_back(
          {0.5 + std::round(32.0 * std::cos(angle)) / 64.0, 0.5 + std::round(32.0 * std::sin(angle)) / 64.0});
    }
    shapes.push_back(round);
    return shapes;
  }();
  return all;
}

Lattice drawLattice(KeyedRandom& random) {
  Lattice lattice;
  do {
    lattice.a = rounded(random.direction() * random.between(0.5, 1.0), 20);
    lattice.b = rounded(random.direction() * random.between(0.5, 1.0), 20);
  } while (lattice.a.cross(lattice.b).norm() < 0.3 * lattice.a.norm() * lattice.b.norm());
  lattice.outline = outlines()[random.below(outlines().size())];
  return lattice;
}

/// A unit normal for which every vertex is at least `margin` (a sine) above the horizon, if one is found; else one
/// facing the first vertex.
Vector3d normalFacing(KeyedRandom& random, const std::vector<Vector3d>& vertices, const Vector3d& position,
                      double margin) {
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& v : vertices) {
    mean += (v - position).normalized();
  }
  mean.normalize();
  for (int attempt = 0; attempt < 64; ++attempt) {
    Vector3d n = (mean + random.between(0.0, 0.8) * random.direction()).normalized();
    if (std::all_of(vertices.begin(), vertices.end(),
                    [&](const Vector3d& v) { return n.dot(v - position) > margin * (v - position).norm(); })) {
      return n;
    }
  }
  return mean;
}

Configuration configurationOf(std::vector<Vector3d> vertices, const Vector3d& position, const Vector3d& normal) {
  return {{"polygon", std::move(vertices), 1.0}, {position, normal}};
}

Configuration drawWellConditioned(KeyedRandom& random) {
  for (;;) {
    const Lattice lattice = drawLattice(random);
    const Vector3d centre = lattice.at(0.5, 0.5);
    const Vector3d offset = random.direction();
    const std::vector<Vector3d> vertices = lattice.vertices();
    const Vector3d position = centre + offset * random.between(0.6, 2.0);
    const Vector3d normal = normalFacing(random, vertices, position, 0.2);
    const double height = std::abs(lattice.unitNormal().dot(position - centre));
    const bool clear = std::all_of(vertices.begin(), vertices.end(), [&](const Vector3d& v) {
      return normal.dot(v - position) > 0.15 * (v - position).norm() && (v - position).norm() > 0.3;
    });
    if (clear && height > 0.3) {
      return configurationOf(vertices, position, normal);
    }
  }
}

Configuration drawGeneric(KeyedRandom& random) {
  for (;;) {
    const Lattice lattice = drawLattice(random);
    const std::vector<Vector3d> vertices = lattice.vertices();
    const Vector3d position = lattice.at(0.5, 0.5) + random.direction() * random.between(0.2, 3.0);
    const Vector3d normal = random.direction();
    const bool visible = std::any_of(vertices.begin(), vertices.end(),
                                     [&](const Vector3d& v) { return normal.dot(v - position) > 0.05; });
    if (visible && std::abs(lattice.unitNormal().dot(position)) > 0.05) {
      return configurationOf(vertices, position, normal);
    }
  }
}

Configuration drawSize(KeyedRandom& random) {
  const Lattice lattice = drawLattice(random);
  const std::vector<Vector3d> vertices = lattice.vertices();
  for (;;) {
    const Vector3d offset = random.direction();
    if (std::abs(offset.dot(lattice.unitNormal())) < 0.1) {
      continue;
    }
    const Vector3d position = lattice.at(0.25, 0.25) + offset * random.decade(-6.0, 8.0);
    return configurationOf(vertices, position, normalFacing(random, vertices, position, 0.1));
  }
}

Configuration drawNearEdge(KeyedRandom& random) {
  const Lattice lattice = drawLattice(random);
  const std::vector<Vector3d> vertices = lattice.vertices();
  const std::size_t i = random.below(vertices.size());
  const Vector3d e = vertices[(i + 1) % vertices.size()] - vertices[i];
  Vector3d across = e.normalized().cross(random.direction());
  across.normalize();
  const Vector3d position = vertices[i] + random.between(0.1, 0.9) * e + across * (1e-12 * random.between(1.0, 2.0));
  return configurationOf(vertices, position, normalFacing(random, vertices, position, 0.0));
}

Configuration drawNearVertex(KeyedRandom& random) {
  const Lattice lattice = drawLattice(random);
  const std::vector<Vector3d> vertices = lattice.vertices();
  const Vector3d position =
      vertices[random.below(vertices.size())] + random.direction() * (1e-12 * random.between(1.0, 2.0));
  return configurationOf(vertices, position, normalFacing(random, vertices, position, 0.0));
}

Configuration drawNearPlane(KeyedRandom& random) {
  for (;;) {
    const Lattice lattice = drawLattice(random);
    const std::vector<Vector3d> vertices = lattice.vertices();
    const Vector3d position = lattice.at(random.between(-1.5, 2.5), random.between(-1.5, 2.5)) +
                              lattice.unitNormal() * random.decade(-12.0, -6.0);
    const Vector3d normal = random.direction();
    const bool visible = std::any_of(vertices.begin(), vertices.end(),
                                     [&](const Vector3d& v) { return normal.dot(v - position) > 0.05; });
    const bool clear =
        std::all_of(vertices.begin(), vertices.end(), [&](const Vector3d& v) { return (v - position).norm() > 0.05; });
    if (visible && clear) {
      return configurationOf(vertices, position, normal);
    }
  }
}

Configuration drawNearRadial(KeyedRandom& random) {
  for (;;) {
    const Lattice lattice = drawLattice(random);
    const std::vector<Vector3d> vertices = lattice.vertices();
    const std::size_t i = random.below(vertices.size());
    const Vector3d e = vertices[(i + 1) % vertices.size()] - vertices[i];
    Vector3d across = e.normalized().cross(lattice.unitNormal());
    across = (across + random.between(0.3, 2.0) * lattice.unitNormal()).normalized();
    const double sine = random.decade(-12.0, -1.0);
    const double step = std::ldexp(std::round(random.between(16.0, 64.0)), -5);
    const Vector3d position = vertices[i] - step * e + across * (sine * step * e.norm());
    const Vector3d normal = random.direction();
    const bool visible = std::any_of(vertices.begin(), vertices.end(),
                                     [&](const Vector3d& v) { return normal.dot(v - position) > 0.05; });
    if (visible) {
      return configurationOf(vertices, position, normal);
    }
  }
}

Configuration drawScaled(KeyedRandom& random) {
  Configuration c = drawWellConditioned(random);
  const double scale = random.decade(-150.0, 150.0);
  // A power of two keeps the polygon planar to the last bit.
  const double factor = std::ldexp(1.0, std::ilogb(scale));
  for (Vector3d& v : c.polygon.vertices) {
    v *= factor;
  }
  c.receiver.position *= factor;
  return c;
}

Configuration drawTranslated(KeyedRandom& random) {
  Configuration c = drawWellConditioned(random);
  const Vector3d shift = rounded(random.direction() * 1e6, 20);
  for (Vector3d& v : c.polygon.vertices) {
    v += shift;
  }
  c.receiver.position += shift;
  return c;
}

/// A normal for which vertex `top` is `height` above the horizon.
Vector3d normalAtHeight(KeyedRandom& random, const Vector3d& r, double height) {
  Vector3d n = random.direction();
  n -= r * (n.dot(r) / r.squaredNorm());
  n.normalize();
  const double sine = height / r.norm();
  return (n * std::sqrt(1.0 - sine * sine) + r.normalized() * sine).normalized();
}

Configuration drawHorizonCorner(KeyedRandom& random, double size) {
  for (;;) {
    const Lattice lattice = drawLattice(random);
    std::vector<Vector3d> vertices = lattice.vertices();
    for (Vector3d& v : vertices) {
      v *= size;
    }
    const Vector3d position = rounded(random.direction() * random.between(1.0, 2.0), 20);
    const std::size_t top = random.below(vertices.size());
    const Vector3d r = vertices[top] - position;
    const Vector3d normal = normalAtHeight(random, r, size * random.decade(-10.0, -0.5));
    const bool straddles = normal.dot(r) > 0.0 && std::any_of(vertices.begin(), vertices.end(), [&](const Vector3d& v) {
                             return normal.dot(v - position) < 0.0;
                           });
    if (straddles && std::abs(lattice.unitNormal().dot(position)) > 0.1) {
      return configurationOf(vertices, position, normal);
    }
  }
}

Configuration drawCornerAtHorizon(KeyedRandom& random) { return drawHorizonCorner(random, 1.0); }

Configuration drawTinyAtHorizon(KeyedRandom& random) {
  return drawHorizonCorner(random, std::ldexp(1.0, -static_cast<int>(random.between(7.0, 27.0))));
}

/// Several extremes at once: a polygon of any size, the receiver near its plane and often along an edge, and a horizon
/// that cuts off a corner, often in a plane that is nearly the polygon's.
Configuration drawCombined(KeyedRandom& random) {
  for (;;) {
    const Lattice lattice = drawLattice(random);
    const double size = std::ldexp(1.0, static_cast<int>(random.between(-27.0, 7.0)));
    std::vector<Vector3d> vertices = lattice.vertices();
    for (Vector3d& v : vertices) {
      v *= size;
    }
    const std::size_t top = random.below(vertices.size());
    const Vector3d next = vertices[(top + 1) % vertices.size()] - vertices[top];
    const Vector3d previous = vertices[(top + vertices.size() - 1) % vertices.size()] - vertices[top];
    const Vector3d in_plane = random.below(2) == 0 ? next : next.norm() * lattice.unitNormal().cross(next).normalized();
    const Vector3d position = vertices[top] - in_plane.normalized() + random.decade(-12.0, 0.0) * lattice.unitNormal();
    // The horizon holds the receiver and a point of each of the two edges at the corner.
    const double fraction = random.decade(-10.0, 0.0);
    const Vector3d first = vertices[top] - position + fraction * next;
    Vector3d normal = first.cross(fraction * (random.between(0.1, 1.0) * previous - next)).normalized();
    if (normal.dot(vertices[top] - position) < 0.0) {
      normal = -normal;
    }
    const auto height = [&](const Vector3d& v) { return normal.dot(v - position); };
    if (height(vertices[top]) > 0.0 &&
        std::any_of(vertices.begin(), vertices.end(), [&](const Vector3d& v) { return height(v) < 0.0; })) {
      return configurationOf(vertices, position, normal);
    }
  }
}

Configuration drawSliver(KeyedRandom& random) {
  for (;;) {
    Lattice lattice = drawLattice(random);
    const double aspect = std::ldexp(1.0, -static_cast<int>(random.between(20.0, 40.0)));
    lattice.b = rounded(random.direction(), 10) * aspect;
    if (lattice.a.cross(lattice.b).norm() < 0.3 * lattice.a.norm() * lattice.b.norm()) {
      continue;
    }
    lattice.a = rounded(lattice.a, 10);
    lattice.outline = outlines()[random.below(2)];
    const std::vector<Vector3d> vertices = lattice.vertices();
    const Vector3d position = lattice.at(0.5, 0.5) + random.direction() * random.between(0.6, 2.0);
    if (std::abs(lattice.unitNormal().dot(position)) > 0.1) {
      return configurationOf(vertices, position, normalFacing(random, vertices, position, 0.1));
    }
  }
}

}  // namespace

const std::vector<InputFamily>& inputFamilies() {
  static const std::vector<InputFamily> families = {
      {"well-conditioned",
       "polygons of 3 to 16 vertices, convex and not, as large as their distance, clear of plane and horizon", 2e-14,
       2e-14, 2e-14, 2e-14, drawWellConditioned},
      {"generic", "the same at any orientation, many of them partly below the horizon", 1e-13, 1e-13, 1e-13, 1e-13,
       drawGeneric},
      {"size", "edge/distance from 1e-8 to 1e6; the tangential Hessian may lose digits", 1e-13, 1e-13, 0.0, 1e-13,
       drawSize},
      {"near edge", "receivers 1e-12 from an edge", 1e-13, 1e-13, 1e-13, 1e-13, drawNearEdge},
      {"near vertex", "receivers 1e-12 from a vertex; the rotational gradient may lose digits", 1e-13, 1e-13, 1e-13,
       0.0, drawNearVertex},
      {"near plane",
       "receivers 1e-12 to 1e-6 from the polygon's plane; gradient and rotational gradient may lose digits", 0.0, 1e-13,
       1e-13, 0.0, drawNearPlane},
      {"near radial",
       "an edge within a sine of 1e-12 to 0.1 of the direction to it; the rotational gradient may lose digits", 1e-13,
       1e-13, 1e-13, 0.0, drawNearRadial},
      {"scale", "coordinates of 1e-150 to 1e150", 1e-13, 1e-13, 1e-13, 1e-13, drawScaled},
      {"translated", "scenes a million times their size from the origin", 1e-13, 1e-13, 1e-13, 1e-13, drawTranslated},
      {"horizon corner", "all below the horizon but a corner, down to 1e-10 of the edge", 1e-13, 1e-13, 1e-13, 1e-13,
       drawCornerAtHorizon},
      {"tiny at horizon", "polygons of 1e-8 to 1e-2 of their distance, cut by the horizon", 1e-13, 1e-13, 1e-13, 1e-13,
       drawTinyAtHorizon},
      {"combined",
       "any size, near the plane, along an edge and all but a corner below the horizon at once; digits may be lost",
       0.0, 0.0, 0.0, 0.0, drawCombined},
      {"sliver", "aspect ratios of 1e6 to 1e12; digits may be lost", 0.0, 0.0, 0.0, 0.0, drawSliver},
  };
  return families;
}

const InputFamily& inputFamily(std::string_view name) {
  for (const InputFamily& family : inputFamilies()) {
    if (family.name == name) {
      return family;
    }
  }
  throw std::invalid_argument("inputFamily: no family is called \"" + std::string(name) + "\"");
}

std::vector<Configuration> drawInputs(const InputFamily& family, std::size_t count, std::uint64_t seed) {
  std::vector<Configuration> inputs;
  inputs.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    KeyedRandom random(seed, family.name, i);
    inputs.push_back(family.draw(random));
  }
  return inputs;
}

std::size_t lengthened(std::size_t count) {
  const char* text = std::getenv("IRRADIFF_TEST_MULTIPLIER");
  if (text == nullptr) {
    return count;
  }
  char* end = nullptr;
  const double factor = std::strtod(text, &end);
  if (end == text || *end != '\0' || !(factor > 0.0) || !(factor <= 1e9)) {
    throw std::invalid_argument("IRRADIFF_TEST_MULTIPLIER is \"" + std::string(text) +
                                "\"; it must be a number in (0, 1e9]");
  }
  return std::max<std::size_t>(1, static_cast<std::size_t>(static_cast<double>(count) * factor));
}

}  // namespace irradiff
