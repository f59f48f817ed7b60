#include "verification/checks/flatland_inputs.h"

#include "verification/checks/error_diagnosis.h"

#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

namespace irradiff {
namespace {

using Eigen::Vector2d;

/// A unit normal that sees the segment's middle.
Vector2d facing(KeyedRandom& random, const Vector2d& position, const Vector2d& middle) {
  const Vector2d towards = (middle - position).normalized();
  return directionAt(std::atan2(towards(1), towards(0)) + random.between(-1.2, 1.2));
}

FlatlandConfiguration drawGeneric(KeyedRandom& random) {
  for (;;) {
    const Vector2d a = drawPoint(random);
    const Vector2d b = drawPoint(random);
    const Vector2d x = drawPoint(random);
    const double area = std::abs((a - x)(0) * (b - x)(1) - (a - x)(1) * (b - x)(0));
    if (area > 0.05 && (a - b).norm() > 0.2) {
      return {{"segment", {a, b}, 1.0}, {x, facing(random, x, 0.5 * (a + b))}};
    }
  }
}

FlatlandConfiguration drawShort(KeyedRandom& random) {
  FlatlandConfiguration c = drawGeneric(random);
  const double size = random.decade(-8.0, 0.0);
  c.segment.vertices[1] = c.segment.vertices[0] + size * (c.segment.vertices[1] - c.segment.vertices[0]);
  c.receiver.normal = facing(random, c.receiver.position, c.segment.vertices[0]);
  return c;
}

FlatlandConfiguration drawNear(KeyedRandom& random) {
  FlatlandConfiguration c = drawGeneric(random);
  const Vector2d& a = c.segment.vertices[0];
  const Vector2d e = c.segment.vertices[1] - a;
  const double along = random.below(3) == 0 ? 0.0 : random.between(0.1, 0.9);
  c.receiver.position = a + along * e + directionAt(random.between(0.0, 6.28)) * (1e-12 * random.between(1.0, 2.0));
  c.receiver.normal = facing(random, c.receiver.position, c.segment.vertices[1]);
  return c;
}

FlatlandConfiguration drawEndOn(KeyedRandom& random) {
  FlatlandConfiguration c = drawGeneric(random);
  const Vector2d& a = c.segment.vertices[0];
  const Vector2d e = c.segment.vertices[1] - a;
  c.receiver.position = a + random.between(1.5, 3.0) * e + Vector2d(-e(1), e(0)) * random.decade(-12.0, -1.0);
  c.receiver.normal = facing(random, c.receiver.position, a);
  return c;
}

FlatlandConfiguration drawHorizon(KeyedRandom& random) {
  for (;;) {
    FlatlandConfiguration c = drawGeneric(random);
    const Vector2d r = c.segment.vertices[0] - c.receiver.position;
    const double sine = random.decade(-10.0, -0.5) / r.norm();
    if (sine >= 0.9) {
      continue;
    }
    // The end at r is just above the horizon, on either side.
    const double side = random.below(2) == 0 ? 1.0 : -1.0;
    const double angle = std::atan2(r(1), r(0)) + side * (0.5 * std::numbers::pi - std::asin(sine));
    c.receiver.normal = directionAt(angle);
    if (c.receiver.normal.dot(r) > 0.0 && c.receiver.normal.dot(c.segment.vertices[1] - c.receiver.position) < 0.0) {
      return c;
    }
  }
}

/// Several extremes at once: any length, nearly end-on, and all but one end below the horizon.
FlatlandConfiguration drawCombined(KeyedRandom& random) {
  for (;;) {
    const Vector2d a = drawPoint(random);
    const Vector2d along = directionAt(random.between(0.0, 6.28));
    const Vector2d b = a + random.decade(-8.0, 6.0) * along;
    const Vector2d x = a - along + random.decade(-12.0, 0.0) * Vector2d(-along(1), along(0));
    const Vector2d cut = a + random.decade(-10.0, 0.0) * (b - a) - x;
    Vector2d normal = Vector2d(-cut(1), cut(0)).normalized();
    if (normal.dot(a - x) < 0.0) {
      normal = -normal;
    }
    if (normal.dot(a - x) > 0.0 && normal.dot(b - x) < 0.0) {
      return {{"segment", {a, b}, 1.0}, {x, normal}};
    }
  }
}

constexpr std::array<FlatlandFamily, 6> kFamilies = {{{"flatland, generic", true, drawGeneric},
                                                      {"flatland, length/distance from 1e-8", true, drawShort},
                                                      {"flatland, 1e-12 from the segment", true, drawNear},
                                                      {"flatland, nearly end-on", true, drawEndOn},
                                                      {"flatland, an end at the horizon", true, drawHorizon},
                                                      {"flatland, combined extremes", false, drawCombined}}};

}  // namespace

std::span<const FlatlandFamily> flatlandFamilies() { return kFamilies; }

Vector2d directionAt(double angle) { return {std::cos(angle), std::sin(angle)}; }

Vector2d drawPoint(KeyedRandom& random) { return {random.between(-1.0, 1.0), random.between(-1.0, 1.0)}; }

std::string sceneLine(const FlatlandConfiguration& configuration) {
  std::ostringstream text;
  text.precision(17);
  const auto vector = [](const Vector2d& v) {
    std::ostringstream part;
    part.precision(17);
    part << '[' << v(0) << ',' << v(1) << ']';
    return part.str();
  };
  text << R"({"format":"irradiff-scene","version":1,"dimension":2,"segments":[{"name":"segment","vertices":[)"
       << vector(configuration.segment.vertices[0]) << ',' << vector(configuration.segment.vertices[1])
       << R"(],"radiance":1}],"points":[{"position":)" << vector(configuration.receiver.position) << R"(,"normal":)"
       << vector(configuration.receiver.normal) << "}]}";
  return text.str();
}

std::string likelyCause(Quantity, const FlatlandConfiguration&, const Eigen::MatrixXd& expected,
                        const Eigen::MatrixXd& actual) {
  return diagnose(expected, actual);
}

std::string inWords(const FlatlandConfiguration& configuration) {
  const Vector2d& first = configuration.segment.vertices[0];
  const Vector2d& last = configuration.segment.vertices[1];
  const Vector2d& x = configuration.receiver.position;
  std::ostringstream text;
  text.precision(2);
  text << "a segment " << (last - first).norm() << " long, its ends " << (first - x).norm() << " and "
       << (last - x).norm() << " away";
  return text.str();
}

}  // namespace irradiff
