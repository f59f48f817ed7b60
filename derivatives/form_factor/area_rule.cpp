#include "derivatives/form_factor/area_rule.h"

#include "derivatives/boundary/edge_arcs.h"
#include "derivatives/boundary/edge_kernel.h"
#include "derivatives/form_factor/gauss_legendre.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace irradiff {
namespace {

using WideVector = Vector3<DoubleWord<double>>;

/// Half the extent over the distance from the far side of that half: the inverse of the radius, in units of half an integration interval, within
/// which 1/|p|^2 has no complex pole.
double inversePoleDistance(const ClippedPolygon<double>& polygon, double* extent_over_distance) {
  const Vector3<double> apex = narrow<double>(polygon.vertices.front().position);
  double extent = 0.0;
  for (const ClippedVertex<double>& vertex : polygon.vertices) {
    extent = std::max(extent, norm(narrow<double>(difference(vertex.position, polygon.vertices.front().position))));
  }
  const double distance = norm(apex);
  *extent_over_distance = extent / distance;
  return extent / std::max(distance - 2.0 * extent, 0.5 * distance);
}

/// Gauss quadrature with n nodes of a function analytic within the Bernstein ellipse of parameter rho and bounded there by M errs by at most
/// (64/15) M rho^(-2n) / (1 - rho^-2) (Trefethen, Approximation Theory and Approximation Practice, Theorem 19.3). With rho = 1/tau the ellipse stays
/// within half the pole's distance, where the kernel's Hessian is at most 2^8 times its size at the centre; two dimensions double the error.
double truncationBound(double tau, std::size_t nodes) {
  return 2.0 * 5.0 * 256.0 * std::pow(tau, 2.0 * static_cast<double>(nodes));
}

struct Accumulator {
  double irradiance = 0.0;
  Vector3<double> vector_irradiance = Vector3<double>::Zero();
  Vector3<double> gradient = Vector3<double>::Zero();
  Matrix3<double> hessian = Matrix3<double>::Zero();
  double irradiance_size = 0.0;
  double gradient_size = 0.0;
  double hessian_size = 0.0;

  /// Adds the kernel at p with area vector `area` (N dA), height = n.p and offset = area.p.
  void add(const Vector3<double>& p, double height, double offset, const Vector3<double>& area, double area_size,
           const Vector3<double>& normal) {
    const double inverse_square = 1.0 / p.squaredNorm();
    const double inverse_fourth = inverse_square * inverse_square;
    const Vector3<double> slope = offset * normal + height * area;  // gradient of (n.p)(area.p) with respect to p
    const Vector3<double> w = p * inverse_square;
    const double kernel = height * offset * inverse_fourth;
    irradiance += kernel;
    vector_irradiance += offset * inverse_square * std::sqrt(inverse_square) * (p * std::sqrt(inverse_square));
    gradient += inverse_fourth * (4.0 * height * offset * w - slope);
    hessian += inverse_fourth * (normal * area.transpose() + area * normal.transpose() -
                                 4.0 * (slope * w.transpose() + w * slope.transpose()) +
                                 24.0 * height * offset * w * w.transpose()) -
               4.0 * kernel * inverse_square * Matrix3<double>::Identity();
    const double slope_size = std::abs(offset) + height * area_size;
    const double inverse_distance = std::sqrt(inverse_square);
    irradiance_size += std::abs(kernel);
    gradient_size += inverse_fourth * slope_size + 4.0 * std::abs(kernel) * inverse_distance;
    hessian_size +=
        inverse_fourth * (2.0 * area_size + 8.0 * slope_size * inverse_distance) + 28.0 * std::abs(kernel) * inverse_square;
  }
};

void integrateTriangle(const ClippedVertex<double>& a, const ClippedVertex<double>& b, const ClippedVertex<double>& c,
                       const Vector3<double>& normal, const GaussLegendreRule& rule, Accumulator& sums) {
  const WideVector wide_area = cross(difference(b.position, a.position), difference(c.position, a.position));
  const Vector3<double> area = narrow<double>(wide_area);
  const double area_size = area.norm();
  const double offset = static_cast<double>(dot(wide_area, a.position));
  const Vector3<double> pa = narrow<double>(a.position);
  const Vector3<double> ab = narrow<double>(difference(b.position, a.position));
  const Vector3<double> bc = narrow<double>(difference(c.position, b.position));
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double s = rule.nodes[i];
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
      const double t = rule.nodes[j];
      // (s, t) -> a + s (ab + t bc) covers the triangle with Jacobian s |area|.
      const double weight = rule.weights[i] * rule.weights[j] * s;
      const Vector3<double> p = pa + s * (ab + t * bc);
      const double height = (1.0 - s) * a.height + s * ((1.0 - t) * b.height + t * c.height);
      sums.add(p, height, weight * offset, weight * area, weight * area_size, normal);
    }
  }
}

/// The Hessian's term from the horizon's edges: minus what they would add if they were edges of a fixed polygon.
void subtractHorizonEdges(const ClippedPolygon<double>& polygon, const Vector3<double>& normal, Accumulator& sums) {
  std::vector<BoundaryArc<double>> arcs;
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    const ClippedVertex<double>& start = polygon.vertices[i];
    const ClippedVertex<double>& end = polygon.vertices[(i + 1) % polygon.vertices.size()];
    if (start.height == 0.0 && end.height == 0.0) {
      appendEdgeArcs(start, end, 1.0, arcs);
    }
  }
  for (const BoundaryArc<double>& arc : arcs) {
    const ArcTerms<double> terms = arcTerms(arc, normal);
    sums.hessian -= terms.hessian;
    sums.hessian_size += terms.hessian_size;
  }
}

}  // namespace

std::optional<AreaRuleSums> areaRule(const ClippedPolygon<double>& polygon, const Vector3<double>& normal) {
  double extent_over_distance = 0.0;
  const double tau = inversePoleDistance(polygon, &extent_over_distance);
  if (extent_over_distance > kAreaRuleExtent) {
    return std::nullopt;
  }
  std::size_t nodes = 2;
  while (nodes < kMostGaussNodes && truncationBound(tau, nodes) > 0x1p-54) {
    ++nodes;
  }
  const GaussLegendreRule& rule = gaussLegendre(nodes);
  Accumulator sums;
  for (std::size_t i = 1; i + 1 < polygon.vertices.size(); ++i) {
    integrateTriangle(polygon.vertices[0], polygon.vertices[i], polygon.vertices[i + 1], normal, rule, sums);
  }
  subtractHorizonEdges(polygon, normal, sums);
  const Vector3<double> rotational = cross(normal, sums.vector_irradiance);
  return AreaRuleSums{{{sums.irradiance}, {sums.gradient}, {sums.hessian}, {rotational}},
                      sums.irradiance_size,
                      sums.gradient_size,
                      sums.hessian_size,
                      truncationBound(tau, nodes)};
}

}  // namespace irradiff
