#include "derivatives/boundary/gauss_legendre.h"
#include "derivatives/form_factor/plain_geometry.h"
#include "derivatives/form_factor/plain_rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
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

NodeSums sumOverNodes(const std::vector<TriangleNode>& nodes, const Vector3<double>& a, double height_a,
                      const Vector3<double>& ab, const Vector3<double>& ac, double height_b, double height_c) {
  NodeSums sums;
  for (const TriangleNode& node : nodes) {
    const Vector3<double> p = a + node.to_b * ab + node.to_c * ac;
    const double h = (1.0 - node.to_b - node.to_c) * height_a + node.to_b * height_b + node.to_c * height_c;
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
  // n.z is at most extent |c|, and at most the height, which is between 0 and s.height all over the polygon.
  const double least_shift = std::min(1.0 / s.inverse, s.height / extent);
  const auto height = [&s, least_shift](const TaylorRemainder& r) { return s.height + r.shifted * least_shift; };
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

using WideVector = Vector3<DoubleWord<double>>;

/// A vertex of what is seen of a polygon, from the first one.
struct FanPoint {
  Vector3<double> from_apex;
  double length;
  double summands;  ///< of the lengths that from_apex was summed up from; it is right to 5 u of it
  double height;    ///< 0 for a cut
};

/// The same in doubled precision.
struct WideFan {
  WideVector apex;  ///< relative to the receiver
  std::array<WideVector, 2 * kMostPlainVertices> points;
};

/// What is seen of a polygon, from its first vertex above the horizon on. Differences of vertices are right to u in
/// each component; a cut adds what is seen of its edge to that of its end, so that it stays right however small the
/// part.
class VisibleFan {
 public:
  /// `is_wide`: what wideArea needs is kept too.
  VisibleFan(const PlainView& view, const Polygon& polygon, const Receiver& receiver, bool is_wide) {
    std::size_t first = 0;
    while (!(view.vertices[first].height > 0.0)) {
      ++first;
    }
    const auto wideFromApex = [&](std::size_t i) {
      return wideRelative(polygon.vertices[i], polygon.vertices[first], view.scale);
    };
    if (is_wide) {
      wide_.emplace();
      wide_->apex = wideRelative(polygon.vertices[first], receiver.position, view.scale);
    }
    const auto fromApex = [&](std::size_t i) {
      return Vector3<double>((polygon.vertices[i] - polygon.vertices[first]) * view.scale);
    };
    apex_ = view.vertices[first].position;
    double least_inverse = view.vertices[first].inverse_distance;
    std::size_t i = first;
    for (std::size_t step = 0; step < view.count; ++step) {
      const std::size_t next = view.next(i);
      const PlainVertex& a = view.vertices[i];
      const bool starts_above = a.height > 0.0;
      if (starts_above) {
        if (is_wide) {
          wide_->points[count_] = wideFromApex(i);
        }
        const Vector3<double> from_apex = fromApex(i);
        add(from_apex, norm(from_apex), a.height);
        least_inverse = std::min(least_inverse, a.inverse_distance);
      }
      if (starts_above != (view.vertices[next].height > 0.0)) {
        const std::size_t seen = starts_above ? i : next;
        const std::size_t hidden = starts_above ? next : i;
        const WideCut cut = wideCut(view, polygon, receiver, seen, hidden);
        const Vector3<double> part = static_cast<double>(cut.fraction) *
                                     Vector3<double>((polygon.vertices[hidden] - polygon.vertices[seen]) * view.scale);
        const Vector3<double> end = fromApex(seen);
        (starts_above ? downward_ : upward_)[cuts_] = count_;
        cuts_ += starts_above ? 0 : 1;
        if (is_wide) {
          const WideVector edge = wideRelative(polygon.vertices[hidden], polygon.vertices[seen], view.scale);
          const WideVector wide_end = wideFromApex(seen);
          for (int k = 0; k < 3; ++k) {
            wide_->points[count_](k) = wide_end(k) + cut.fraction * edge(k);
          }
        }
        add(end + part, norm(end) + norm(part), 0.0);
        least_inverse = std::min(least_inverse, 1.0 / norm(narrow<double>(cut.position)));
      }
      i = next;
    }
    farthest_ = 1.0 / least_inverse;
  }

  const Vector3<double>& apex() const { return apex_; }
  std::size_t size() const { return count_; }
  const FanPoint& point(std::size_t i) const { return points_[i]; }
  double highest() const { return highest_; }
  double farthest() const { return farthest_; }
  double reach() const { return reach_; }
  /// Of the triangle of the apex and the points i - 1 and i: A in doubled precision, and A.p.
  WideVector wideArea(std::size_t i) const { return cross(wide_->points[i - 1], wide_->points[i]); }
  double wideOffset(const WideVector& area) const { return static_cast<double>(dot(area, wide_->apex)); }
  /// Edges along the horizon, each from a cut down to the next one up.
  std::size_t horizonEdges() const { return cuts_; }
  const FanPoint& downwardCut(std::size_t edge) const { return points_[downward_[edge]]; }
  const FanPoint& upwardCut(std::size_t edge) const { return points_[upward_[edge]]; }

 private:
  void add(const Vector3<double>& from_apex, double summands, double height) {
    points_[count_++] = {from_apex, norm(from_apex), summands, height};
    highest_ = std::max(highest_, height);
    reach_ = std::max(reach_, summands);
  }

  Vector3<double> apex_;
  std::array<FanPoint, 2 * kMostPlainVertices> points_;
  std::optional<WideFan> wide_;
  std::array<std::size_t, kMostPlainVertices> downward_;
  std::array<std::size_t, kMostPlainVertices> upward_;
  std::size_t count_ = 0;
  std::size_t cuts_ = 0;
  double highest_ = 0.0;
  double farthest_ = 0.0;
  double reach_ = 0.0;
};

/// The cut moves with the receiver: minus the term that the horizon's edges would add to the Hessian if they were fixed
/// (docs/derivations/radiance_boundary.md, section 6).
void subtractHorizonEdges(const VisibleFan& fan, const Vector3<double>& normal, PlainResult& result) {
  static constexpr std::array<std::size_t, kAngleBins> kLengths = seriesLengthsFor(0x1p-54L);
  constexpr double kLargestMomentError = 0x1p40;
  PlainSums<double> sums;
  double moved = 0.0;
  for (std::size_t i = 0; i < fan.horizonEdges(); ++i) {
    const auto endOf = [&fan](const FanPoint& cut) {
      const Vector3<double> position = fan.apex() + cut.from_apex;
      return PlainEnd<double>{position, 1.0 / norm(position), 0.0, 0.0};
    };
    PlainEdge<double> edge{endOf(fan.downwardCut(i)), endOf(fan.upwardCut(i)), {}, 0.0, {}, 0.0};
    edge.edge = fan.upwardCut(i).from_apex - fan.downwardCut(i).from_apex;
    edge.length = norm(edge.edge);
    const double nearest_inverse = std::max(edge.first.inverse_distance, edge.last.inverse_distance);
    // Both ends are off by 5 u of the fan's reach, along the line and across.
    moved += 12.0 * kUnitRoundoff * fan.reach() * nearest_inverse * nearest_inverse * nearest_inverse;
    if (edge.length == 0.0) {
      continue;
    }
    edge.moment = cross<double>(
        edge.first.inverse_distance >= edge.last.inverse_distance ? edge.first.position : edge.last.position,
        edge.edge);
    edge.area = norm(edge.moment);
    const double moment_error = kPlainMomentError * edge.length / (nearest_inverse * edge.area);
    if (!(moment_error <= kLargestMomentError)) {
      result = withoutBounds();
      return;
    }
    addPlainEdge(edge, {moment_error, 0.0, 0.0}, kLengths, normal, sums);
  }
  result.hessian -= 0.5 * (sums.hessian + sums.hessian.transpose());
  result.bounds.hessian +=
      kUnitRoundoff * (sums.hessian_error + static_cast<double>(sums.arcs) * sums.hessian_size) + moved;
}

}  // namespace

double plainAreaTruncation(std::size_t nodes, double extent) { return taylorRemainder(4, nodes, extent).value; }

PlainResult plainArea(const PlainView& view, const Polygon& polygon, const Receiver& receiver,
                      const PlainAreaSettings& settings) {
  const bool is_cut = view.horizon == PlainView::Horizon::kCrosses;
  if (is_cut && !isOffPlane(view, polygon, receiver)) {
    return withoutBounds();
  }
  const VisibleFan fan(view, polygon, receiver, settings.compensates_area);
  PlainResult result;
  const std::vector<TriangleNode>& rule = nodesOf(settings.nodes);
  const Vector3<double>& apex = fan.apex();
  double offset_size = 0.0;
  double area_size = 0.0;
  // Sum over the triangles of what the error of A is kPlainMomentError u times.
  double area_error_size = 0.0;
  for (std::size_t i = 2; i < fan.size(); ++i) {
    const FanPoint& b = fan.point(i - 1);
    const FanPoint& c = fan.point(i);
    Vector3<double> area;
    double offset = 0.0;
    if (settings.compensates_area) {
      const WideVector wide_area = fan.wideArea(i);
      area = narrow<double>(wide_area);
      offset = fan.wideOffset(wide_area);
    } else {
      area = cross<double>(b.from_apex, c.from_apex);
      offset = dot(area, apex);
    }
    const NodeSums sums = sumOverNodes(rule, apex, fan.point(0).height, b.from_apex, c.from_apex, b.height, c.height);
    addTriangle(sums, area, offset, receiver.normal, result);
    offset_size += std::abs(offset);
    area_size += norm(area);
    area_error_size += is_cut ? 4.0 * std::max(b.summands * c.length, b.length * c.summands) : b.length * c.length;
  }
  if (settings.compensates_area) {
    // 16 u^2 for each product in doubled precision, of points that are right to as much of the fan's reach.
    constexpr double kDoubledPrecision = 0x1p-45;
    area_error_size =
        kDoubledPrecision * (area_error_size + static_cast<double>(fan.size()) * fan.reach() * fan.reach());
  }
  // Every point of the polygon is within `extent` of the mean of its vertices, relative to the mean's own distance.
  const double farthest = fan.farthest();
  const double inverse_mean = (1.0 + view.extent) / farthest;
  const double inverse_nearest = inverse_mean / (1.0 - view.extent);
  // In units of kPlainAreaError u: A errs by kPlainMomentError u times the above, A.p by that and 5 u |A|, times |p|;
  // heights by height_error u, and where cuts are moved by 8 u twice.
  constexpr double kAreaSlack = kPlainMomentError / kPlainAreaError;
  constexpr double kOffsetSlack = (kPlainMomentError + 5.0) / kPlainAreaError;
  const double height_slack = (view.height_error + (is_cut ? 16.0 : 0.0)) / kPlainAreaError;
  const double offset_with_errors = offset_size + kOffsetSlack * area_error_size * farthest;
  DerivativeBounds rounding = sizesOf({offset_with_errors, (1.0 + height_slack) * fan.highest(),
                                       area_size + kAreaSlack * area_error_size, inverse_nearest});
  // The product of two errors is none; irradiance may be small for the sake of both offset and height.
  rounding.irradiance *=
      (offset_with_errors + height_slack * offset_size) / ((1.0 + height_slack) * offset_with_errors);
  const double rounded = kPlainAreaError * kUnitRoundoff;
  const DerivativeBounds truncation =
      truncationOf({offset_size + rounded * kOffsetSlack * area_error_size * farthest, fan.highest(),
                    area_size + rounded * kAreaSlack * area_error_size, inverse_mean},
                   settings.nodes, view.extent);
  // Every node rounds the partial sums of its triangle, every triangle those of the polygon.
  const auto terms = static_cast<double>(rule.size() + fan.size() - 2);
  // The weights of a triangle add up to 1/2, and so does its integral: what truncation errs by counts twice.
  const double relative_rounding = 0.5 * (kPlainAreaError + terms) * kUnitRoundoff;
  const auto bound = [&](double DerivativeBounds::*quantity) {
    return relative_rounding * rounding.*quantity + truncation.*quantity;
  };
  result.bounds.irradiance = bound(&DerivativeBounds::irradiance);
  result.bounds.gradient = bound(&DerivativeBounds::gradient);
  result.bounds.hessian = bound(&DerivativeBounds::hessian);
  result.bounds.rotational_gradient = bound(&DerivativeBounds::rotational_gradient);
  if (is_cut) {
    subtractHorizonEdges(fan, receiver.normal, result);
  }
  return result;
}

}  // namespace irradiff
