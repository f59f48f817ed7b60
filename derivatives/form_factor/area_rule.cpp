#include "derivatives/form_factor/area_rule.h"

#include "derivatives/boundary/edge_arcs.h"
#include "derivatives/boundary/edge_kernel.h"
#include "derivatives/boundary/tangent_plane.h"

#include <algorithm>
#include <vector>

namespace irradiff {
namespace {

using WideVector = Vector3<DoubleWord<double>>;

/// Largest distance of a vertex from the first one, relative to that one's distance from the receiver.
double relativeExtent(const ClippedPolygon<double>& polygon) {
  const WideVector& apex = polygon.vertices.front().position;
  double extent = 0.0;
  for (const ClippedVertex<double>& vertex : polygon.vertices) {
    extent = std::max(extent, norm(narrow<double>(difference(vertex.position, apex))));
  }
  return extent / norm(narrow<double>(apex));
}

/// What doubled precision leaves of n x v where v is along n, in units of kSmallSourceError u times |v|.
constexpr double kWideSlack = 0x1p-53;

SmallSourceSums<3>::InTangentPlane inTangentPlane(const WideVector& v, const Vector3<double>& normal,
                                                  const TangentPlane<double>& plane) {
  const Vector2<double> components = plane.components(narrow<double>(cross(widen<DoubleWord<double>>(normal), v)));
  return {components, components.norm() + kWideSlack * narrow<double>(v).norm()};
}

void integrateTriangle(const ClippedVertex<double>& a, const ClippedVertex<double>& b, const ClippedVertex<double>& c,
                       double cut_error, const Vector3<double>& normal, const TangentPlane<double>& plane,
                       const GaussLegendreRule& rule, SmallSourceSums<3>& sums) {
  const WideVector wide_area =
      cross<DoubleWord<double>>(difference(b.position, a.position), difference(c.position, a.position));
  const Vector3<double> area = narrow<double>(wide_area);
  const auto offset = static_cast<double>(dot(wide_area, a.position));
  const Vector3<double> pa = narrow<double>(a.position);
  const Vector3<double> ab = narrow<double>(difference(b.position, a.position));
  const Vector3<double> bc = narrow<double>(difference(c.position, b.position));
  using InTangentPlane = SmallSourceSums<3>::InTangentPlane;
  const InTangentPlane pa_tangential = inTangentPlane(a.position, normal, plane);
  const InTangentPlane ab_tangential = inTangentPlane(difference(b.position, a.position), normal, plane);
  const InTangentPlane bc_tangential = inTangentPlane(difference(c.position, b.position), normal, plane);
  const InTangentPlane area_tangential = inTangentPlane(wide_area, normal, plane);
  const double area_slack = cut_error * (ab.norm() + bc.norm());
  const double area_size = area.norm() + area_slack;
  const double offset_slack = area_slack * pa.norm();
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double s = rule.nodes[i];
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
      const double t = rule.nodes[j];
      // (s, t) -> a + s (ab + t bc) covers the triangle with Jacobian s |area|. The height is a positive combination:
      // near the horizon n.p would cancel.
      const double weight = rule.weights[i] * rule.weights[j] * s;
      const Vector3<double> p = pa + s * (ab + t * bc);
      const double height = (1.0 - s) * a.height + s * ((1.0 - t) * b.height + t * c.height);
      const InTangentPlane p_tangential{
          pa_tangential.components + s * (ab_tangential.components + t * bc_tangential.components),
          pa_tangential.size + s * (ab_tangential.size + t * bc_tangential.size)};
      const InTangentPlane weighted_area{weight * area_tangential.components,
                                         weight * (area_tangential.size + area_slack)};
      sums.add(p, p_tangential, height, weight * offset, weight * area, weighted_area, weight * area_size,
               weight * offset_slack, normal);
    }
  }
}

void subtractHorizonEdges(const ClippedPolygon<double>& polygon, double cut_error, const Vector3<double>& normal,
                          AreaRuleSums& result) {
  std::vector<BoundaryArc<double>> arcs;
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    const ClippedVertex<double>& start = polygon.vertices[i];
    const ClippedVertex<double>& end = polygon.vertices[(i + 1) % polygon.vertices.size()];
    if (start.height == 0.0 && end.height == 0.0) {
      appendEdgeArcs(start, end, normal, 1.0, arcs);
    }
  }
  for (const BoundaryArc<double>& arc : arcs) {
    const ArcTerms<double> terms = arcTerms(arc, normal);
    result.sums.hessian -= terms.hessian;
    // Along the horizon the term is the angle over the squared distance; both ends of the angle are off.
    const double kappa = std::max(arc.first.inverse_distance, arc.last.inverse_distance);
    result.sums.hessian_size += terms.hessian_size + 2.0 * cut_error * kappa * kappa * kappa;
    result.terms += 1.0;
  }
}

}  // namespace

bool isSmallSource(const ClippedPolygon<double>& polygon) { return relativeExtent(polygon) <= kSmallSourceExtent; }

bool fanOverlaps(const ClippedPolygon<double>& polygon) {
  const std::vector<ClippedVertex<double>>& vertices = polygon.vertices;
  if (vertices.size() == 3) {
    return false;
  }
  const auto from_first = [&vertices](std::size_t i) {
    return narrow<double>(difference(vertices[i].position, vertices[0].position));
  };
  const auto area = [&from_first](std::size_t i) { return cross<double>(from_first(i), from_first(i + 1)); };
  Vector3<double> sum = Vector3<double>::Zero();
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    sum += area(i);
  }
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    if (area(i).dot(sum) < 0.0) {
      return true;
    }
  }
  return false;
}

std::optional<AreaRuleSums> areaRule(const ClippedPolygon<double>& polygon,
                                     std::span<const ClippedPolygon<double>> triangles, const Vector3<double>& normal) {
  const std::span<const ClippedPolygon<double>> fans = triangles.empty() ? std::span(&polygon, 1) : triangles;
  double extent = 0.0;
  std::size_t count = 0;
  for (const ClippedPolygon<double>& fan : fans) {
    extent = std::max(extent, relativeExtent(fan));
    count += fan.vertices.size() - 2;
  }
  if (!(extent <= kSmallSourceExtent)) {
    return std::nullopt;
  }
  const SmallSourceRule rule = smallSourceRule(extent);
  AreaRuleSums result{
      {}, static_cast<double>(rule.rule->nodes.size() * rule.rule->nodes.size() * count), rule.truncation};
  const TangentPlane<double> plane(normal);
  for (const ClippedPolygon<double>& fan : fans) {
    // A cut is right to 16 u^2 of the distances of its edge's ends, about 1, whatever the size of the visible part; in
    // units of kSmallSourceError u (docs/derivations/error_bounds.md, section 3.1).
    const double cut_error = fan.crosses_horizon ? 0x1p-52 : 0.0;
    for (std::size_t i = 1; i + 1 < fan.vertices.size(); ++i) {
      integrateTriangle(fan.vertices[0], fan.vertices[i], fan.vertices[i + 1], cut_error, normal, plane, *rule.rule,
                        result.sums);
    }
    // Their terms are multiples of n n^T and leave the tangential Hessian alone.
    subtractHorizonEdges(fan, cut_error, normal, result);
  }
  return result;
}

}  // namespace irradiff
