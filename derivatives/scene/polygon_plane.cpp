#include "derivatives/scene/polygon_plane.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace irradiff {

namespace {

using Vertices = std::vector<Eigen::Vector3d>;

// Exponent k of the scaling x -> x 2^-k that brings `largest` into [1/2, 1).
int scalingExponent(double largest) {
  int exponent = 0;
  std::frexp(largest, &exponent);
  return exponent;
}

double scaled(double value, int exponent) { return std::ldexp(value, -exponent); }

Eigen::Vector3d scaled(const Eigen::Vector3d& vector, int exponent) {
  return {scaled(vector.x(), exponent), scaled(vector.y(), exponent), scaled(vector.z(), exponent)};
}

// a d - b c with a relative error of 1.5 ulp (Kahan).
double differenceOfProducts(double a, double d, double b, double c) {
  const double product = b * c;
  const double product_error = std::fma(-b, c, product);
  return std::fma(a, d, -product) + product_error;
}

Eigen::Vector3d accurateCross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {differenceOfProducts(a.y(), b.z(), a.z(), b.y()), differenceOfProducts(a.z(), b.x(), a.x(), b.z()),
          differenceOfProducts(a.x(), b.y(), a.y(), b.x())};
}

double length(const Eigen::Vector3d& v) { return std::hypot(v.x(), v.y(), v.z()); }

}  // namespace

LocalShape localShape(const Vertices& vertices) {
  double largest_coordinate = 0;
  for (const Eigen::Vector3d& vertex : vertices) {
    largest_coordinate = std::max(largest_coordinate, vertex.lpNorm<Eigen::Infinity>());
  }
  // In two steps: differences between the largest doubles overflow, those between the smallest lose nothing.
  LocalShape shape;
  shape.exponent = scalingExponent(largest_coordinate);
  shape.vertices = vertices;
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(1);
  Eigen::Vector3d upper = -lower;
  for (Eigen::Vector3d& vertex : shape.vertices) {
    vertex = scaled(vertex, shape.exponent);
    lower = lower.cwiseMin(vertex);
    upper = upper.cwiseMax(vertex);
  }
  const Eigen::Vector3d first = shape.vertices.front();
  const int extent_exponent = scalingExponent((upper - lower).maxCoeff());
  for (Eigen::Vector3d& vertex : shape.vertices) vertex = scaled(vertex - first, extent_exponent);
  shape.extents = scaled(upper - lower, extent_exponent);
  shape.extent = shape.extents.maxCoeff();
  shape.rounding = scaled(0x1p-52 * lower.cwiseAbs().cwiseMax(upper.cwiseAbs()), extent_exponent);
  shape.largest_coordinate = scaled(scaled(largest_coordinate, shape.exponent), extent_exponent);
  shape.exponent += extent_exponent;
  return shape;
}

Eigen::Vector3d widestNormal(const Vertices& local) {
  const auto shorter = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return length(a) < length(b); };
  const Eigen::Vector3d along = *std::ranges::max_element(local, shorter);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& vertex : local) {
    const Eigen::Vector3d candidate = accurateCross(along, vertex);
    if (length(candidate) > length(normal)) normal = candidate;
  }
  return normal;
}

std::vector<Eigen::Vector2d> projection(const Vertices& vertices, const Eigen::Vector3d& normal) {
  constexpr double kNegligible = 0x1p-480;
  Eigen::Index dropped = 0;
  normal.cwiseAbs().maxCoeff(&dropped);
  const std::array<Eigen::Index, 2> kept{(dropped + 1) % 3, (dropped + 2) % 3};
  std::vector<Eigen::Vector2d> projected(vertices.size());
  for (int axis = 0; axis < 2; ++axis) {
    double largest = 0;
    for (const Eigen::Vector3d& vertex : vertices) largest = std::max(largest, std::abs(vertex[kept[axis]]));
    const int exponent = scalingExponent(largest) - 480;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const double coordinate = scaled(vertices[i][kept[axis]], exponent);
      projected[i][axis] = std::abs(coordinate) < kNegligible ? 0.0 : coordinate;
    }
  }
  return projected;
}

}  // namespace irradiff
