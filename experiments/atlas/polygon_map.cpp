#include "experiments/atlas/polygon_map.h"

#include "verification/checks/random.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace irradiff {
namespace {

using Eigen::Vector3d;
using WideVector = Eigen::Matrix<long double, 3, 1>;

/// Least sine of a vertex's height above the horizon.
constexpr double kLeastHeight = 0.02;

/// A random right-handed or left-handed frame of unit vectors.
struct Frame {
  Vector3d u, v, w;

  explicit Frame(KeyedRandom& random) : u(random.direction()) {
    v = u.cross(random.direction()).normalized();
    w = u.cross(v);
    if (random.below(2) == 0) w = -w;
  }
  Vector3d at(double a, double b, double c) const { return a * u + b * v + c * w; }
};

/// Sine of the least height of a vertex above the horizon.
double leastHeight(const Configuration& input) {
  double least = 1.0;
  for (const Vector3d& vertex : input.polygon.vertices) {
    const WideVector r = vertex.cast<long double>() - input.receiver.position.cast<long double>();
    least = std::min(least, static_cast<double>(r.dot(input.receiver.normal.cast<long double>()) / r.norm()));
  }
  return least;
}

Configuration configurationOf(std::vector<Vector3d> vertices, const Vector3d& position, const Vector3d& normal) {
  return {{"polygon", std::move(vertices), 1.0}, {position, normal.normalized()}};
}

double distance(const WideVector& a) { return static_cast<double>(a.norm()); }

WideVector relative(const Configuration& input, std::size_t vertex) {
  return input.polygon.vertices[vertex].cast<long double>() - input.receiver.position.cast<long double>();
}

WideVector edge(const Configuration& input, std::size_t vertex) {
  const std::vector<Vector3d>& v = input.polygon.vertices;
  return v[(vertex + 1) % v.size()].cast<long double>() - v[vertex].cast<long double>();
}

double shortestEdge(const Configuration& input) {
  return std::min({distance(edge(input, 0)), distance(edge(input, 1)), distance(edge(input, 2))});
}

/// Sine of the angle between the direction to the vertex and the polygon's plane.
double sineToPlane(const Configuration& input, std::size_t vertex) {
  const WideVector area = edge(input, 0).cross(edge(input, 1));
  const WideVector r = relative(input, vertex);
  return static_cast<double>(std::abs(area.dot(r)) / (area.norm() * r.norm()));
}

/// Distance of the receiver from the line of the first edge.
double distanceToFirstLine(const Configuration& input) {
  const WideVector e = edge(input, 0);
  return static_cast<double>(relative(input, 0).cross(e).norm() / e.norm());
}

/// A triangle that spreads from the corner nearest to the receiver away from it. The plane is that of u and w.
Configuration drawBeforeCorner(KeyedRandom& random, double size, double sine) {
  for (;;) {
    const Frame frame(random);
    const double first = random.between(-0.9, 0.1);
    const double second = std::min(0.9, first + random.between(0.8, 1.6));
    const double b = random.between(1.0, 1.5);
    const double c = random.between(1.0, 1.5);
    Configuration input = configurationOf({Vector3d::Zero(), frame.at(b * std::cos(first), 0.0, b * std::sin(first)),
                                           frame.at(c * std::cos(second), 0.0, c * std::sin(second))},
                                          Vector3d::Zero(), Vector3d::UnitZ());
    const double scale = size / shortestEdge(input);
    for (Vector3d& vertex : input.polygon.vertices) vertex *= scale;
    const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
    input.receiver.position = -frame.at(cosine, sine, 0.0);
    // Halfway between the direction to the corner and the plane, in which the polygon ends where it is large.
    const double half = 0.5 * std::asin(std::min(1.0, sine));
    input.receiver.normal = (frame.at(std::cos(half), std::sin(half), 0.0) + 0.3 * random.direction()).normalized();
    if (leastHeight(input) > kLeastHeight) return input;
  }
}

std::array<double, 2> measureBeforeCorner(const Configuration& input) {
  return {shortestEdge(input) / distance(relative(input, 0)), sineToPlane(input, 0)};
}

/// The receiver beside the foot of its perpendicular on the first edge; the third vertex at a distance of about 1.
Configuration drawBesideEdge(KeyedRandom& random, double to_edge, double length) {
  for (;;) {
    const Frame frame(random);
    const double turn = random.between(0.0, 2.0 * std::numbers::pi);
    const Vector3d from_receiver = frame.at(0.0, std::cos(turn), std::sin(turn));
    const double third = turn + random.between(0.3, std::numbers::pi - 0.3) * (random.below(2) == 0 ? 1.0 : -1.0);
    const Vector3d corner = frame.at(random.between(-0.5, 0.5), std::cos(third), std::sin(third));
    const double before = random.between(0.2, 0.8);
    const double up = random.between(0.0, 2.0 * std::numbers::pi);
    const Configuration input = configurationOf({-before * length * frame.u, (1.0 - before) * length * frame.u, corner},
                                                -to_edge * from_receiver, frame.at(0.0, std::cos(up), std::sin(up)));
    if (input.receiver.normal.dot(from_receiver) > 0.3 && input.receiver.normal.dot(corner) > 0.3) return input;
  }
}

std::array<double, 2> measureBesideEdge(const Configuration& input) {
  return {distanceToFirstLine(input), distance(edge(input, 0))};
}

/// The first edge begins at a distance of 1 and leads away from the receiver, almost along the ray.
Configuration drawAlongRay(KeyedRandom& random, double sine, double length) {
  for (;;) {
    const Frame frame(random);
    const double turn = random.between(0.0, 2.0 * std::numbers::pi);
    const double third = turn + random.between(0.3, std::numbers::pi - 0.3) * (random.below(2) == 0 ? 1.0 : -1.0);
    const Vector3d aside = frame.at(0.0, std::cos(turn), std::sin(turn));
    const Vector3d corner = frame.at(random.between(-0.3, 1.0), std::cos(third), std::sin(third));
    const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
    const Configuration input = configurationOf({Vector3d::Zero(), length * frame.u, corner},
                                                -(cosine * frame.u + sine * aside), frame.u + random.direction());
    if (leastHeight(input) > 0.1) return input;
  }
}

std::array<double, 2> measureAlongRay(const Configuration& input) {
  return {distanceToFirstLine(input) / distance(relative(input, 0)),
          distance(edge(input, 0)) / distance(relative(input, 0))};
}

/// A sliver of length 1 about the origin.
Configuration drawSliver(KeyedRandom& random, double aspect, double away) {
  for (;;) {
    const Frame frame(random);
    const double turn = random.between(0.4, std::numbers::pi - 0.4) * (random.below(2) == 0 ? 1.0 : -1.0);
    const double lean = random.between(-0.5, 0.5);
    const Vector3d to_sliver = frame.at(lean, std::cos(turn), std::sin(turn)).normalized();
    const double up = turn + random.between(-1.0, 1.0);
    const Configuration input =
        configurationOf({-0.5 * frame.u, 0.5 * frame.u, frame.at(random.between(-0.3, 0.3), 1.0 / aspect, 0.0)},
                        -away * to_sliver, frame.at(0.0, std::cos(up), std::sin(up)));
    if (leastHeight(input) > 0.0) return input;
  }
}

std::array<double, 2> measureSliver(const Configuration& input) {
  const WideVector e = edge(input, 0);
  const long double width = e.cross(edge(input, 1)).norm() / e.norm();
  return {static_cast<double>(e.norm() / width),
          static_cast<double>(input.receiver.position.cast<long double>().norm() / e.norm())};
}

/// As drawBeforeCorner, neither grazing nor facing, at another scale.
Configuration drawScaled(KeyedRandom& random, double scale, double size) {
  Configuration input = drawBeforeCorner(random, size, random.between(0.3, 0.9));
  for (Vector3d& vertex : input.polygon.vertices) vertex *= scale;
  input.receiver.position *= scale;
  return input;
}

std::array<double, 2> measureScaled(const Configuration& input) {
  const double to_corner = distance(relative(input, 0));
  return {to_corner, shortestEdge(input) / to_corner};
}

}  // namespace

const std::vector<PolygonMap>& polygonMaps() {
  static const std::vector<PolygonMap> maps = {
      {"size_grazing",
       "edge over distance against grazing angle",
       "A triangle seen from before its nearest corner. The shortest edge over the distance to that corner, the "
       "longest "
       "edge being at most 2.5 times as long; and the sine of the angle between the polygon's plane and the ray to the "
       "corner.",
       {"edge/distance", 1e-12, 1e8},
       {"sin(grazing angle)", 1e-12, 1.0},
       drawBeforeCorner,
       measureBeforeCorner},
      {"distance_edge",
       "distance to an edge against its length",
       "The receiver is beside the inner part of an edge, the third corner of the triangle about 1 away. Distance to "
       "the edge and its length, both over the distance to that corner.",
       {"distance to edge", 1e-12, 1e2},
       {"edge length", 1e-6, 1e6},
       drawBesideEdge,
       measureBesideEdge},
      {"radial_edge",
       "sine to the ray against depth ratio",
       "An edge leads away from the receiver, nearly along the ray to its nearer end. The sine of the angle between "
       "edge and ray, and the edge's length over the distance to its nearer end, which for small sines is the ratio of "
       "the ends' depths less 1.",
       {"sin(edge, ray)", 1e-12, 1.0},
       {"edge/near distance", 1e-2, 1e8},
       drawAlongRay,
       measureAlongRay},
      {"aspect_distance",
       "aspect ratio against distance",
       "A sliver: a triangle's longest edge over its height above that edge, and the receiver's distance from the "
       "middle of that edge over the edge's length.",
       {"length/width", 1.0, 1e12},
       {"distance/length", 1e-4, 1e6},
       drawSliver,
       measureSliver},
      {"scale_size",
       "unit of length against edge over distance",
       "All coordinates in another unit: the distance to the nearest corner as a number, and the shortest edge over "
       "it.",
       {"distance", 1e-150, 1e150},
       {"edge/distance", 1e-4, 1e4},
       drawScaled,
       measureScaled},
      {"scale_near",
       "unit of length against edge over distance, nearer to 1",
       "The same where float has its limits.",
       {"distance", 1e-15, 1e15},
       {"edge/distance", 1e-4, 1e4},
       drawScaled,
       measureScaled},
  };
  return maps;
}

Configuration roundedToFloat(const Configuration& input) {
  const auto rounded = [](const Vector3d& v) -> Vector3d {
    return v.unaryExpr([](double exact) {
      const auto in_float = static_cast<float>(exact);
      const bool is_held = exact == 0.0 || std::fpclassify(in_float) == FP_NORMAL;
      return is_held ? static_cast<double>(in_float) : std::numeric_limits<double>::quiet_NaN();
    });
  };
  Configuration result = input;
  for (Vector3d& vertex : result.polygon.vertices) vertex = rounded(vertex);
  result.receiver.position = rounded(input.receiver.position);
  result.receiver.normal = rounded(input.receiver.normal);
  return result;
}

bool isHeldAt(const std::array<double, 2>& place, double x, double y) {
  const auto is_right = [](double value, double wanted) { return value > 0.8 * wanted && value < 1.25 * wanted; };
  return is_right(place[0], x) && is_right(place[1], y);
}

bool isHeld(const PolygonMap& map, const Configuration& input, double x, double y) {
  return isHeldAt(map.measure(input), x, y) && leastHeight(input) > 0.0;
}

}  // namespace irradiff
