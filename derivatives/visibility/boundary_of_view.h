#pragma once

#include "derivatives/boundary/edge_arcs.h"
#include "derivatives/boundary/horizon_height.h"
#include "derivatives/boundary/radiance_boundary.h"
#include "derivatives/visibility/visible_boundary.h"

#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace irradiff {

/// What one apparent vertex adds to the Hessian, and how well that is known.
template <class Scalar>
struct ApparentVertexTerm {
  Matrix3<Scalar> hessian;  ///< symmetric; W/m^4
  Scalar size;              ///< of the largest entry: what rounding errors are proportional to
  Scalar slack;             ///< what the places of both edges add to the error, in units of the wider roundoff
};

/// The radiance boundary of a view whose topology is given, with all that occlusion adds to it.
template <class Scalar>
struct BoundaryOfView {
  RadianceBoundary<Scalar> boundary;
  std::vector<ApparentVertexTerm<Scalar>> vertex_terms;
  /// What the ends of arcs add to the errors of irradiance, gradient and Hessian, in units of the wider scalar's
  /// roundoff: an end that is cut by another edge moves with the rounding of both.
  Scalar irradiance_slack = lift<Scalar>(0.0);
  Scalar gradient_slack = lift<Scalar>(0.0);
  Scalar hessian_slack = lift<Scalar>(0.0);
};

namespace detail {

/// The numbers behind the topology of a view, at any scalar: where points and places are. Frozen, it can be
/// differentiated.
template <class Scalar, class WideScalar>
class ViewGeometry {
 public:
  ViewGeometry(const SceneMesh& mesh, int exponent, const Vector3<Scalar>& position, const Vector3<Scalar>& normal)
      : mesh_(mesh), exponent_(exponent), position_(position), normal_(normal) {}

  /// A place relative to the receiver, and how far it moves, relative to its distance, for a relative error of one in
  /// the products of the wider scalar.
  struct Place {
    Vector3<WideScalar> position;
    WideScalar height;
    Scalar sensitivity;

    ClippedVertex<Scalar, WideScalar> rounded() const { return {position, static_cast<Scalar>(height)}; }
  };

  Place place(std::size_t edge, const EdgePlace& place) const {
    const MeshEdge& e = mesh_.edges()[edge];
    const Place start = point(e.start);
    const Place end = point(e.end);
    if (place.kind == EdgePlace::Kind::kStart) return start;
    if (place.kind == EdgePlace::Kind::kEnd) return end;
    if (place.kind == EdgePlace::Kind::kHorizon) {
      Place cut = between(start, end, end.height, start.height, lift<Scalar>(1.0));
      cut.height = WideScalar(lift<Scalar>(0.0));
      return cut;
    }
    if (place.kind == EdgePlace::Kind::kPoint) {
      // In view the point is on the edge: the plane through it across the edge's plane of view cuts the edge there.
      const Vector3<WideScalar> across = cross(planeOfView(edge), point(place.id).position);
      return between(start, end, dot(across, end.position), dot(across, start.position),
                     norm(narrow<Scalar>(start.position)) * norm(narrow<Scalar>(end.position)) *
                         norm(narrow<Scalar>(point(place.id).position)));
    }
    if (place.kind == EdgePlace::Kind::kInLine) {
      const Place other_start = point(mesh_.edges()[place.id].start);
      const Place other_end = point(mesh_.edges()[place.id].end);
      // The plane through the other line, across the common plane of view.
      const Vector3<WideScalar> along = difference(other_end.position, other_start.position);
      const Vector3<WideScalar> across = cross(planeOfView(edge), along);
      const auto offset = [&](const Place& at) { return dot(across, difference(at.position, other_start.position)); };
      return between(
          start, end, offset(end), offset(start),
          norm(narrow<Scalar>(start.position)) * norm(narrow<Scalar>(end.position)) * norm(narrow<Scalar>(along)));
    }
    const MeshEdge& other = mesh_.edges()[place.id];
    const Vector3<WideScalar> plane = planeOfView(place.id);
    return between(start, end, dot(plane, end.position), dot(plane, start.position),
                   norm(narrow<Scalar>(point(other.start).position)) * norm(narrow<Scalar>(point(other.end).position)));
  }

  Vector3<WideScalar> edgeVector(std::size_t edge) const {
    const MeshEdge& e = mesh_.edges()[edge];
    return difference(point(e.end).position, point(e.start).position);
  }

  Place point(std::size_t index) const {
    const MeshPoint& p = mesh_.points()[index];
    if (p.face == kNone) {
      return {vertex(index), horizonHeight<WideScalar>(lifted(index), position_, normal_), lift<Scalar>(0.0)};
    }
    const Place start = point(p.start);
    const Place end = point(p.end);
    const auto [start_weight, end_weight] = weights(p);
    return between(start, end, start_weight, -end_weight, lift<Scalar>(0.0));
  }

 private:
  Vector3<WideScalar> vertex(std::size_t index) const { return wideDifference<WideScalar>(lifted(index), position_); }

  Vector3<Scalar> lifted(std::size_t vertex) const {
    const auto scale = [&](double c) { return lift<Scalar>(std::ldexp(c, -exponent_)); };
    const Eigen::Vector3d& v = mesh_.vertices()[vertex];
    return {scale(v(0)), scale(v(1)), scale(v(2))};
  }

  /// The weights of a point on an edge, both scaled by one power of two.
  std::array<WideScalar, 2> weights(const MeshPoint& p) const {
    const int exponent = std::max(p.start_weight.exponent(), p.end_weight.exponent());
    const auto widened = [exponent](const ExactNumber& weight) {
      WideScalar sum(lift<Scalar>(0.0));
      for (const double part : weight.parts(exponent)) sum = sum + WideScalar(lift<Scalar>(part));
      return sum;
    };
    return {widened(p.start_weight), widened(p.end_weight)};
  }

  Vector3<WideScalar> planeOfView(std::size_t edge) const {
    const MeshEdge& e = mesh_.edges()[edge];
    return cross(point(e.start).position, point(e.end).position);
  }

  /// (end_side start - start_side end) / (end_side - start_side), the sides being of opposite signs. `plane_size` is
  /// what the errors of the sides are proportional to, for each unit of distance.
  Place between(const Place& start, const Place& end, const WideScalar& end_side, const WideScalar& start_side,
                const Scalar& plane_size) const {
    const WideScalar sum = end_side - start_side;
    Place result;
    for (int k = 0; k < 3; ++k) {
      result.position(k) = (end_side * start.position(k) - start_side * end.position(k)) / sum;
    }
    result.height = (end_side * start.height - start_side * end.height) / sum;
    const Scalar start_distance = norm(narrow<Scalar>(start.position));
    const Scalar end_distance = norm(narrow<Scalar>(end.position));
    const Scalar length = norm(narrow<Scalar>(difference(end.position, start.position)));
    const Scalar reach = start_distance + end_distance;
    using std::abs;
    const Scalar moved = length * plane_size * reach / abs(static_cast<Scalar>(sum)) + reach;
    result.sensitivity = start.sensitivity + end.sensitivity + moved / norm(narrow<Scalar>(result.position));
    return result;
  }

  const SceneMesh& mesh_;
  int exponent_;
  Vector3<Scalar> position_;
  Vector3<Scalar> normal_;
};

}  // namespace detail

// The term of an apparent vertex, both edges' together:
//   sigma J nu (kappa - kappa')^2 / (2 w.(e' x e)) Q(w x e, w x e'),   Q(a, b) = a b^T + b a^T
// with e, kappa the direction and inverse distance of the farther edge, e', kappa' of the nearer, sigma J =
// `jump_change` the farther edge's radiance jump before the vertex less that after it.
// docs/derivations/radiance_boundary.md, section 5. Unit: that of the jump over m^2.
template <class Scalar, class WideScalar = Wide<Scalar>>
ApparentVertexTerm<Scalar> apparentVertexTerm(const detail::ViewGeometry<Scalar, WideScalar>& geometry,
                                              const ApparentVertex& vertex, const Scalar& jump_change) {
  using std::abs;
  const auto far = geometry.place(vertex.farther, {EdgePlace::Kind::kEdge, vertex.nearer});
  const auto near = geometry.place(vertex.nearer, {EdgePlace::Kind::kEdge, vertex.farther});
  const Vector3<WideScalar> far_edge = geometry.edgeVector(vertex.farther);
  const Vector3<WideScalar> near_edge = geometry.edgeVector(vertex.nearer);
  const Scalar far_distance = norm(narrow<Scalar>(far.position));
  const Scalar near_distance = norm(narrow<Scalar>(near.position));
  const Scalar gap = norm(narrow<Scalar>(difference(far.position, near.position)));
  const Scalar one = lift<Scalar>(1.0);
  const Scalar kappa_difference = gap / (far_distance * near_distance);
  const Scalar nu = static_cast<Scalar>(far.height) / far_distance;
  // Of the lengths of both edges nothing is left: they divide out.
  const Scalar far_length = norm(narrow<Scalar>(far_edge));
  const Scalar near_length = norm(narrow<Scalar>(near_edge));
  const Scalar crossing =
      static_cast<Scalar>(dot(far.position, cross(near_edge, far_edge))) / (far_distance * far_length * near_length);
  const Vector3<Scalar> far_moment =
      scaled(narrow<Scalar>(cross(far.position, far_edge)), Scalar(one / (far_distance * far_length)));
  const Vector3<Scalar> near_moment =
      scaled(narrow<Scalar>(cross(near.position, near_edge)), Scalar(one / (near_distance * near_length)));
  const Scalar factor = jump_change * nu * kappa_difference * kappa_difference / (lift<Scalar>(2.0) * crossing);
  ApparentVertexTerm<Scalar> term;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      term.hessian(i, j) = factor * (far_moment(i) * near_moment(j) + near_moment(i) * far_moment(j));
    }
  }
  const Scalar two = lift<Scalar>(2.0);
  const Scalar far_size = norm(far_moment);
  const Scalar near_size = norm(near_moment);
  term.size = two * abs(factor) * far_size * near_size;
  // The term is bare nu (kappa - kappa')^2; each factor moves with the places, the bare one relative to its sines.
  const Scalar bare = abs(jump_change) / abs(crossing);
  const Scalar squared = kappa_difference * kappa_difference;
  term.slack =
      (far.sensitivity + near.sensitivity) * bare *
      (squared * nu * (far_size * near_size / abs(crossing) + near_size + far_size) +
       far_size * near_size * (squared + two * nu * kappa_difference * (one / far_distance + one / near_distance)));
  return term;
}

// Everything that a view adds up to, from its topology: arcs with their radiance jumps, arcs of the horizon, apparent
// vertices. `radiances` of the polygons in W/(m^2 sr); lengths, the position's included, in units of 2^exponent of the
// mesh's. Requires that the topology is
// that of the receiver, or of one near it on the same side of all visibility events.
template <class Scalar, class WideScalar = Wide<Scalar>>
BoundaryOfView<Scalar> boundaryOfView(const SceneMesh& mesh, const VisibleBoundary& view,
                                      std::span<const double> radiances, const Vector3<Scalar>& position,
                                      const Vector3<Scalar>& normal, int exponent = 0) {
  using std::abs;
  using std::atan2;
  const detail::ViewGeometry<Scalar, WideScalar> geometry(mesh, exponent, position, normal);
  const auto radiance = [&](std::size_t polygon) { return polygon == kNone ? 0.0 : radiances[polygon]; };
  const auto jump = [&](const ArcSides& sides) { return radiance(sides.right) - radiance(sides.left); };
  const Scalar zero = lift<Scalar>(0.0);
  BoundaryOfView<Scalar> result;
  for (const VisibleArc& arc : view.arcs) {
    const double radiance_jump = jump(arc.sides);
    if (radiance_jump == 0.0) continue;
    const auto first = geometry.place(arc.edge, arc.first);
    const auto last = geometry.place(arc.edge, arc.last);
    ClippedVertex<Scalar, WideScalar> start = first.rounded();
    ClippedVertex<Scalar, WideScalar> end = last.rounded();
    // A place that is cut out above the horizon may come to lie below it by rounding.
    if (start.height < zero) start.height = zero;
    if (end.height < zero) end.height = zero;
    if (!(start.height > zero) && !(end.height > zero)) continue;
    appendEdgeArcs(start, end, normal, lift<Scalar>(radiance_jump), result.boundary.arcs);
    const Scalar size = lift<Scalar>(std::abs(radiance_jump));
    for (const auto* place : {&first, &last}) {
      const Scalar kappa = lift<Scalar>(1.0) / norm(narrow<Scalar>(place->position));
      const Scalar slack = size * place->sensitivity;
      result.irradiance_slack = result.irradiance_slack + slack;
      result.gradient_slack = result.gradient_slack + lift<Scalar>(3.0) * slack * kappa;
      result.hessian_slack = result.hessian_slack + lift<Scalar>(20.0) * slack * kappa * kappa;
    }
  }
  for (std::size_t i = 0; i < view.horizon.size(); ++i) {
    const HorizonPlace& here = view.horizon[i];
    const HorizonPlace& next = view.horizon[(i + 1) % view.horizon.size()];
    if (radiance(here.counterclockwise) == 0.0) continue;
    const auto from = geometry.place(here.edge, here.place);
    const auto to = geometry.place(next.edge, next.place);
    const Vector3<Scalar> moment = narrow<Scalar>(cross(from.position, to.position));
    const Scalar cosine_product = dot(narrow<Scalar>(from.position), narrow<Scalar>(to.position));
    const Scalar angle =
        norm(normal) * lift<Scalar>(radiance(here.counterclockwise)) * Scalar(atan2(norm(moment), cosine_product));
    result.boundary.horizon_angle = result.boundary.horizon_angle + angle;
    result.boundary.horizon_size = result.boundary.horizon_size + angle;
    result.irradiance_slack =
        result.irradiance_slack + lift<Scalar>(radiance(here.counterclockwise)) * (from.sensitivity + to.sensitivity);
  }
  for (const ApparentVertex& vertex : view.apparent_vertices) {
    const double change = jump(vertex.before) - jump(vertex.after);
    if (change != 0.0) {
      result.vertex_terms.push_back(apparentVertexTerm<Scalar, WideScalar>(geometry, vertex, lift<Scalar>(change)));
    }
  }
  return result;
}

}  // namespace irradiff
