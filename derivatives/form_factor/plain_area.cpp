#include "derivatives/boundary/gauss_legendre.h"
#include "derivatives/form_factor/plain_rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace irradiff {
namespace {

constexpr double kUnitRoundoff = 0x1p-53;

/// A node in a triangle a, b, c: p = a + to_b (b - a) + to_c (c - a); weights sum to 1/2.
struct TriangleNode {
  double to_b, to_c, weight;
};

/// P_n(x) and P_(n+1)(x) of Legendre.
std::array<long double, 2> legendre(std::size_t n, long double x) {
  long double value = 1.0L;
  long double next = x;
  for (std::size_t k = 1; k <= n; ++k) {
    const auto degree = static_cast<long double>(k);
    const long double after = ((2.0L * degree + 1.0L) * x * next - degree * value) / (degree + 1.0L);
    value = next;
    next = after;
  }
  return {value, next};
}

/// The zeros of (P_n + P_(n+1))/(1 + x), the nodes of Gauss and Radau but -1, by Newton's method on what is left when
/// the zeros found are divided out.
std::vector<long double> radauNodes(std::size_t n) {
  std::vector<long double> found{-1.0L};
  while (found.size() <= n) {
    long double x = 1.0L;
    for (int step = 0; step < 60; ++step) {
      const auto [value, next] = legendre(n, x);
      const long double f = value + next;
      constexpr long double kStep = 1e-6L;
      const auto [right_value, right_next] = legendre(n, x + kStep);
      const auto [left_value, left_next] = legendre(n, x - kStep);
      const long double slope = (right_value + right_next - left_value - left_next) / (2.0L * kStep);
      long double log_slope = slope / f;
      for (const long double zero : found) {
        log_slope -= 1.0L / (x - zero);
      }
      const long double change = 1.0L / log_slope;
      if (f == 0.0L || !(std::abs(change) > 1e-20L)) {
        break;
      }
      x -= change;
    }
    found.push_back(x);
  }
  found.erase(found.begin());
  return found;
}

// Stroud's conical product (Approximate Calculation of Multiple Integrals, 1971, section 2.5): (s, t) -> a + s ((1 - t)
// (b - a) + t (c - a)) with the Jacobian s as the weight of a Gauss-Jacobi rule in s, whose nodes are those of Gauss
// and Radau without the end: sum of W g(s) = int_0^1 s g(s) ds for g of degree 2 n - 1.
std::vector<TriangleNode> conicalProduct(std::size_t n) {
  const GaussLegendreRule& across = gaussLegendre(n);
  std::vector<TriangleNode> nodes;
  const auto points = static_cast<long double>(n + 1);
  for (const long double x : radauNodes(n)) {
    const long double value = legendre(n, x)[0];
    const long double weight = (1.0L - x) * (1.0L + x) / (4.0L * points * points * value * value);
    const long double s = 0.5L * (1.0L + x);
    for (std::size_t j = 0; j < n; ++j) {
      const long double t = across.nodes[j];
      nodes.push_back({static_cast<double>(s * (1.0L - t)), static_cast<double>(s * t),
                       static_cast<double>(weight * across.weights[j])});
    }
  }
  return nodes;
}

const std::vector<TriangleNode>& nodesOf(std::size_t n) {
  static const std::array<std::vector<TriangleNode>, kMostPlainNodes + 1> rules = [] {
    std::array<std::vector<TriangleNode>, kMostPlainNodes + 1> all;
    for (std::size_t count = 1; count <= kMostPlainNodes; ++count) {
      all[count] = conicalProduct(count);
    }
    return all;
  }();
  return rules[n];
}

/// Sums over the nodes of a triangle, d = |p|^-4 and w = p/|p|^2: what is constant there comes afterwards.
struct NodeSums {
  double d = 0.0;
  double height = 0.0;                                 ///< of h d
  double height_inverse = 0.0;                         ///< of h d/|p|^2
  Vector3<double> p = Vector3<double>::Zero();         ///< of d p
  Vector3<double> w = Vector3<double>::Zero();         ///< of d w
  Vector3<double> height_w = Vector3<double>::Zero();  ///< of h d w
  std::array<double, 6> height_ww{};                   ///< of h d w w^T: xx, yy, zz, xy, yz, zx
};

NodeSums sumOverNodes(const std::vector<TriangleNode>& nodes, const PlainVertex& a, const Vector3<double>& ab,
                      const Vector3<double>& ac, double height_b, double height_c) {
  NodeSums sums;
  for (const TriangleNode& node : nodes) {
    const Vector3<double> p = a.position + node.to_b * ab + node.to_c * ac;
    const double h = (1.0 - node.to_b - node.to_c) * a.height + node.to_b * height_b + node.to_c * height_c;
    const double inverse_square = 1.0 / dot(p, p);
    const double d = node.weight * inverse_square * inverse_square;
    const Vector3<double> w = p * inverse_square;
    const double hd = h * d;
    sums.d += d;
    sums.height += hd;
    sums.height_inverse += hd * inverse_square;
    const Vector3<double> hdw = hd * w;
    sums.p += d * p;
    sums.w += d * w;
    sums.height_w += hdw;
    sums.height_ww[0] += hdw(0) * w(0);
    sums.height_ww[1] += hdw(1) * w(1);
    sums.height_ww[2] += hdw(2) * w(2);
    sums.height_ww[3] += hdw(0) * w(1);
    sums.height_ww[4] += hdw(1) * w(2);
    sums.height_ww[5] += hdw(2) * w(0);
  }
  return sums;
}

Matrix3<double> symmetricProductOf(const Vector3<double>& a, const Vector3<double>& b) {
  return a * b.transpose() + b * a.transpose();
}

void addTriangle(const NodeSums& nodes, const Vector3<double>& area, double offset, const Vector3<double>& normal,
                 PlainResult& result) {
  result.irradiance += offset * nodes.height;
  result.vector_irradiance += offset * nodes.p;
  result.gradient += 4.0 * offset * nodes.height_w - (offset * nodes.d) * normal - nodes.height * area;
  Matrix3<double> ww;
  ww << nodes.height_ww[0], nodes.height_ww[3], nodes.height_ww[5], nodes.height_ww[3], nodes.height_ww[1],
      nodes.height_ww[4], nodes.height_ww[5], nodes.height_ww[4], nodes.height_ww[2];
  result.hessian += nodes.d * symmetricProductOf(normal, area) -
                    4.0 * (offset * symmetricProductOf(normal, nodes.w) + symmetricProductOf(area, nodes.height_w)) +
                    24.0 * offset * ww;
  result.hessian.diagonal().array() -= 4.0 * offset * nodes.height_inverse;
}

/// Of the integrands' parts: the offset A.p, the height n.p, |A| and 1/|p|.
struct IntegrandSizes {
  double offset, height, area, inverse;
};

DerivativeBounds sizesOf(const IntegrandSizes& s) {
  const double square = s.inverse * s.inverse;
  const double decay = square * square;
  DerivativeBounds sizes;
  sizes.irradiance = decay * s.offset * s.height;
  sizes.rotational_gradient = square * s.inverse * s.offset;
  sizes.gradient = decay * (s.offset + s.height * s.area + 4.0 * s.offset * s.height * s.inverse);
  sizes.hessian =
      decay * (2.0 * s.area + 8.0 * s.inverse * (s.offset + s.height * s.area) + 28.0 * square * s.offset * s.height);
  return sizes;
}

/// What the Taylor polynomial of degree D = 2 nodes - 1 leaves of |c + z|^(-2 lambda), |z| <= extent |c|, in units of
/// |c|^(-2 lambda): at most C(D + 2 lambda, D + 1) extent^(D+1) (1 - extent)^(-2 lambda).
struct TaylorRemainder {
  double value;
  double shifted;  ///< extent times the remainder of degree D - 1 is at most so many times `value`
};

TaylorRemainder taylorRemainder(std::size_t lambda, std::size_t nodes, double extent) {
  double value = 1.0;
  for (std::size_t k = 1; k <= 2 * nodes; ++k) {
    value *= extent * (static_cast<double>(k + 2 * lambda - 1) / static_cast<double>(k));
  }
  const double inverse = 1.0 / (1.0 - extent);
  for (std::size_t k = 0; k < lambda; ++k) {
    value *= inverse * inverse;
  }
  return {value, 2.0 * static_cast<double>(nodes) / static_cast<double>(2 * nodes + 2 * lambda - 1)};
}

/// Bounds of the quadrature error, with sizes whose height is the highest and whose inverse is that of the centre.
DerivativeBounds truncationOf(const IntegrandSizes& s, std::size_t nodes, double extent) {
  const TaylorRemainder two = taylorRemainder(2, nodes, extent);
  const TaylorRemainder three = taylorRemainder(3, nodes, extent);
  const TaylorRemainder four = taylorRemainder(4, nodes, extent);
  const double square = s.inverse * s.inverse;
  const double decay = square * square;
  const auto height = [&s](const TaylorRemainder& r) { return s.height + r.shifted / s.inverse; };
  const double three_p = (1.0 + three.shifted) * three.value;
  const double four_pp = (1.0 + four.shifted) * (1.0 + four.shifted) * four.value;
  DerivativeBounds bounds;
  bounds.irradiance = decay * s.offset * height(two) * two.value;
  bounds.rotational_gradient = square * s.inverse * s.offset * (1.0 + two.shifted) * two.value;
  bounds.gradient =
      decay * (4.0 * s.inverse * s.offset * height(three) * three_p + (s.offset + s.area * height(two)) * two.value);
  bounds.hessian = decay * (2.0 * s.area * two.value + 8.0 * s.inverse * (s.offset + s.area * height(three)) * three_p +
                            24.0 * square * s.offset * height(four) * four_pp +
                            4.0 * square * s.offset * height(three) * three.value);
  return bounds;
}

}  // namespace

double plainAreaTruncation(std::size_t nodes, double extent) { return taylorRemainder(4, nodes, extent).value; }

PlainResult plainArea(const PlainView& view, const Polygon& polygon, const Receiver& receiver, std::size_t nodes) {
  PlainResult result;
  const std::vector<TriangleNode>& rule = nodesOf(nodes);
  const PlainVertex& a = view.vertices[0];
  double offset_size = 0.0;
  double area_size = 0.0;
  double extent_square = 0.0;
  double highest = a.height;
  double least_inverse = a.inverse_distance;
  const auto fromApex = [&](std::size_t i) {
    return Vector3<double>((polygon.vertices[i] - polygon.vertices[0]) * view.scale);
  };
  Vector3<double> ab = fromApex(1);
  double ab_length = norm(ab);
  highest = std::max(highest, view.vertices[1].height);
  least_inverse = std::min(least_inverse, view.vertices[1].inverse_distance);
  for (std::size_t i = 2; i < view.count; ++i) {
    const PlainVertex& b = view.vertices[i - 1];
    const PlainVertex& c = view.vertices[i];
    const Vector3<double> ac = fromApex(i);
    const double ac_length = norm(ac);
    const Vector3<double> area = cross<double>(ab, ac);
    const double offset = dot(area, a.position);
    const NodeSums sums = sumOverNodes(rule, a, ab, ac, b.height, c.height);
    addTriangle(sums, area, offset, receiver.normal, result);
    offset_size += std::abs(offset);
    area_size += norm(area);
    extent_square += ab_length * ac_length;
    highest = std::max(highest, c.height);
    least_inverse = std::min(least_inverse, c.inverse_distance);
    ab = ac;
    ab_length = ac_length;
  }
  // Every point of the polygon is within `extent` of the mean of its vertices, relative to the mean's own distance.
  const double farthest = 1.0 / least_inverse;
  const double inverse_mean = (1.0 + view.extent) * least_inverse;
  const double inverse_nearest = inverse_mean / (1.0 - view.extent);
  // In units of kPlainAreaError u: A errs by kPlainMomentError u |z|^2, A.p by that and 4 u |A|, times |p|, n.p by 5 u
  // |p|.
  constexpr double kAreaSlack = kPlainMomentError / kPlainAreaError;
  constexpr double kOffsetSlack = (kPlainMomentError + 5.0) / kPlainAreaError;
  constexpr double kHeightSlack = 5.0 / kPlainAreaError;
  const DerivativeBounds rounding =
      sizesOf({offset_size + kOffsetSlack * extent_square * farthest, highest + kHeightSlack * farthest,
               area_size + kAreaSlack * extent_square, inverse_nearest});
  const double rounded = kPlainAreaError * kUnitRoundoff;
  const DerivativeBounds truncation =
      truncationOf({offset_size + rounded * kOffsetSlack * extent_square * farthest, highest,
                    area_size + rounded * kAreaSlack * extent_square, inverse_mean},
                   nodes, view.extent);
  // Every node rounds the partial sums of its triangle, every triangle those of the polygon.
  const auto terms = static_cast<double>(rule.size() + view.count - 2);
  // The weights of a triangle add up to 1/2, and so does its integral: what truncation errs by counts twice.
  const double relative_rounding = 0.5 * (kPlainAreaError + terms) * kUnitRoundoff;
  const auto bound = [&](double DerivativeBounds::*quantity) {
    return relative_rounding * rounding.*quantity + truncation.*quantity;
  };
  result.bounds.irradiance = bound(&DerivativeBounds::irradiance);
  result.bounds.gradient = bound(&DerivativeBounds::gradient);
  result.bounds.hessian = bound(&DerivativeBounds::hessian);
  result.bounds.rotational_gradient = bound(&DerivativeBounds::rotational_gradient);
  return result;
}

}  // namespace irradiff
