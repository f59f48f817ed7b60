#include "data/reference/reference_inputs.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace irradiff {

namespace {

using Vertices = std::vector<Eigen::Vector3d>;

const Eigen::Vector3d kUp(0, 0, 1);
constexpr double kPi = 3.14159265358979323846;

/// Vertices on circles of the given radii in the plane z = height, one a step.
Vertices ring(const std::vector<double>& radii, double height) {
  Vertices vertices;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double angle = 2 * kPi * (static_cast<double>(i) + 0.3) / static_cast<double>(radii.size());
    vertices.emplace_back(radii[i] * std::cos(angle), radii[i] * std::sin(angle), height);
  }
  return vertices;
}

Vertices transformed(Vertices vertices, const Eigen::Affine3d& motion) {
  for (Eigen::Vector3d& vertex : vertices) vertex = motion * vertex;
  return vertices;
}

PolygonFamily generic() {
  const Eigen::Vector3d tilted = Eigen::Vector3d(0.3, -0.2, 0.9).normalized();
  const Vertices triangle{{0.9, -0.3, 1.1}, {-0.4, 0.8, 1.6}, {-0.7, -0.9, 0.8}};
  const Vertices square{{-0.5, -0.5, 1}, {0.5, -0.5, 1}, {0.5, 0.5, 1}, {-0.5, 0.5, 1}};
  const Vertices wall{{1, -1, 0.25}, {1, 1, 0.25}, {1, 1, 1.25}, {1, -1, 1.25}};
  const Vertices ell{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  const Eigen::Affine3d lift =
      Eigen::Translation3d(-0.8, -0.7, 2.5) * Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 0.5).normalized());
  return {
      "generic",
      {{"triangle", "a triangle with nothing special", triangle, {0, 0, 0}, kUp},
       {"triangle_tilted_normal", "the same, receiver turned", triangle, {0.05, -0.1, 0.02}, tilted},
       {"square_overhead", "unit square at height 1, parallel: symmetric, has a closed form", square, {0, 0, 0}, kUp},
       {"square_off_axis", "the same off its axis", square, {1.3, 0.4, -0.2}, kUp},
       {"wall", "perpendicular rectangle above the floor", wall, {0, 0, 0}, kUp},
       {"ell", "not convex; the diagonals of its fan leave it", ell, {0.7, 1.4, -1.2}, kUp},
       {"ell_turned",
        "the same turned and moved: rounded vertices, planar only to rounding",
        transformed(ell, lift),
        {0.1, 0.2, 0.1},
        tilted},
       {"star",
        "ten vertices, not convex, seen from below its reentrant corners",
        ring({2, 0.7, 2, 0.7, 2, 0.7, 2, 0.7, 2, 0.7}, 1.5),
        {0.4, -0.3, 0},
        kUp},
       {"many_sided",
        "sixteen vertices, turned: many short edges",
        transformed(ring(std::vector<double>(16, 1.0), 0), lift),
        {0, 0, 0},
        kUp}}};
}

PolygonFamily edgeOverDistance() {
  PolygonFamily family{"edge_over_distance", {}};
  const Vertices triangle{{0.6, -0.3, 0.1}, {-0.3, 0.7, -0.2}, {-0.4, -0.5, 0.15}};
  for (const double ratio : {1e-8, 1e-6, 1e-4, 1e-2}) {
    Vertices small;
    for (const Eigen::Vector3d& vertex : triangle) small.emplace_back(Eigen::Vector3d(0.4, -0.3, 0.9) + ratio * vertex);
    family.inputs.push_back({"small_" + scientific(ratio),
                             "edges of " + scientific(ratio) + " of the distance: edge sums cancel",
                             small,
                             {0, 0, 0},
                             kUp});
  }
  for (const double ratio : {1e2, 1e4, 1e6}) {
    Vertices large;
    for (const Eigen::Vector3d& vertex : triangle) {
      large.emplace_back(ratio * vertex.x(), ratio * vertex.y(), 1.0 + 0.5 * vertex.z());
    }
    family.inputs.push_back({"large_" + scientific(ratio),
                             "a ceiling with edges of " + scientific(ratio) +
                                 " times the distance: F close to its bound, derivatives small",
                             large,
                             {0, 0, 0},
                             kUp});
  }
  family.inputs.push_back({"wall_1e+06",
                           "a wall 1e6 times as long as it is distant, seen past its end",
                           {{1, -0.5, 0.1}, {1, 1e6, 0.1}, {1, 1e6, 3}, {1, -0.5, 3}},
                           {0, 0, 0},
                           kUp});
  return family;
}

PolygonFamily scaled() {
  PolygonFamily family{"scaled", {}};
  const Vertices triangle{{0.9, -0.3, 1.1}, {-0.4, 0.8, 1.6}, {-0.7, -0.9, 0.8}};
  const Vertices straddling{{1, -0.7, 0.6}, {1.2, 0.8, 0.5}, {0.9, 0.1, -0.7}};
  const Vertices near_edge{{-1, 1e-3, 2e-3}, {1, 1e-3, 2e-3}, {0.2, 1.5, 0.7}};
  for (const int exponent : {498, -498}) {
    const auto add = [&](const std::string& name, const Vertices& vertices) {
      ReferenceInput input{name + (exponent > 0 ? "_2^498" : "_2^-498"),
                           "coordinates of about 1e" + std::string(exponent > 0 ? "150" : "-150") +
                               ": squares of squares leave the range of doubles",
                           vertices,
                           {0, 0, 0},
                           kUp};
      for (Eigen::Vector3d& vertex : input.vertices) vertex *= std::ldexp(1.0, exponent);
      family.inputs.push_back(input);
    };
    add("triangle", triangle);
    add("straddling", straddling);
    add("near_edge", near_edge);
  }
  return family;
}

PolygonFamily translated() {
  PolygonFamily family{"translated", {}};
  const Vertices triangle{{0.9, -0.3, 1.1}, {-0.4, 0.8, 1.6}, {-0.7, -0.9, 0.8}};
  const Vertices square{{-0.5, -0.5, 1}, {0.5, -0.5, 1}, {0.5, 0.5, 1}, {-0.5, 0.5, 1}};
  const Vertices straddling{{1, -0.7, 0.6}, {1.2, 0.8, 0.5}, {0.9, 0.1, -0.7}};
  for (const Eigen::Vector3d& offset : {Eigen::Vector3d(1e6, 0, 0), Eigen::Vector3d(-7.3e5, 4.1e5, 9.7e5)}) {
    const auto add = [&](const std::string& name, const Vertices& vertices) {
      ReferenceInput input{name + (offset.y() == 0 ? "_along_x" : "_diagonal"),
                           "1e6 times its size away from the origin; coordinates rounded there are the input", vertices,
                           offset, kUp};
      for (Eigen::Vector3d& vertex : input.vertices) vertex += offset;
      family.inputs.push_back(input);
    };
    add("triangle", triangle);
    add("square", square);
    add("straddling", straddling);
  }
  return family;
}

/// A strip of `turns` turns about the origin of the plane, both of its sides with one vertex a step: radii from 0.2 to
/// 1 along the inner side, `thickness` more along the outer one. On a grid of 1e-4, so that decimals show them whole.
std::vector<Eigen::Vector2d> spiral(std::size_t steps, double turns, double thickness) {
  const auto on_grid = [](double coordinate) { return std::round(coordinate * 1e4) / 1e4; };
  std::vector<Eigen::Vector2d> outer;
  std::vector<Eigen::Vector2d> inner;
  for (std::size_t i = 0; i < steps; ++i) {
    const double along = static_cast<double>(i) / static_cast<double>(steps - 1);
    const double angle = 2 * kPi * turns * along;
    const double radius = 0.2 + 0.8 * along;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    inner.emplace_back(on_grid(radius * direction.x()), on_grid(radius * direction.y()));
    outer.emplace_back(on_grid((radius + thickness) * direction.x()), on_grid((radius + thickness) * direction.y()));
  }
  outer.insert(outer.end(), inner.rbegin(), inner.rend());
  return outer;
}

PolygonFamily winding() {
  Vertices overhead;
  Vertices upright;
  for (const Eigen::Vector2d& point : spiral(150, 10, 0.001)) {
    overhead.emplace_back(point.x(), point.y(), 24);
    upright.emplace_back(30, point.x(), point.y());
  }
  // The one that is proven faster comes first: tests repeat it.
  return {"winding",
          {{"spiral_at_horizon",
            "300 vertices, 10 turns of a narrow strip, small and upright: the horizon cuts every turn twice, and the "
            "triangles of a fan cancel",
            upright,
            {0, 0, 0.07},
            kUp},
           {"spiral", "the same overhead, not cut", overhead, {8, 6, 0}, kUp}}};
}

}  // namespace

std::vector<PolygonFamily> regularFamilies() {
  PolygonFamily first = facingReceiver(generic());
  ReferenceInput reversed = first.inputs.front();
  reversed.name = "triangle_reversed";
  reversed.reason = "the first triangle with its vertices reversed: F and all derivatives change sign";
  std::reverse(reversed.vertices.begin(), reversed.vertices.end());
  first.inputs.push_back(reversed);
  return {first, facingReceiver(edgeOverDistance()), facingReceiver(scaled()), facingReceiver(translated()),
          facingReceiver(winding())};
}

}  // namespace irradiff
