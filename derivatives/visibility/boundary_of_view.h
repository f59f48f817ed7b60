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

/// Error of a place on an edge, relative to its distance, that rounding in doubled precision leaves where nothing
/// cancels: the unit of all `..._slack` (docs/derivations/visibility.md, section 5.1).
inline constexpr double kPlaceError = 64.0 * 0x1p-53 * 0x1p-53;

/// How much of the relative errors of an arc's ends comes to its share of the gradient and of the Hessian, times the
/// largest inverse distance and its square (section 5.2 there).
inline constexpr double kGradientSlack = 40.0;
inline constexpr double kHessianSlack = 400.0;

/// Relative error of an apparent vertex' term in units of u times its size, next to its slack (section 5.3 there).
inline constexpr double kVertexError = 80.0;

/// What one apparent vertex adds to the Hessian, and how well that is known.
template <class Scalar>
struct ApparentVertexTerm {
  Matrix3<Scalar> hessian;  ///< symmetric; W/m^4
  Scalar size;              ///< of the largest entry: what rounding errors are proportional to
  Scalar slack;             ///< what the places of the vertex on both edges add to the errors, in units of kPlaceError
};

/// The radiance boundary of a view whose topology is given, with all that occlusion adds to it. Lengths in units of the
/// mesh.
template <class Scalar>
struct BoundaryOfView {
  RadianceBoundary<Scalar> boundary;
  std::vector<ApparentVertexTerm<Scalar>> vertex_terms;
  std::size_t horizon_arcs = 0;  ///< that radiate: so many terms are in the boundary's horizon_angle
  /// What the places of the ends of arcs add to the errors of irradiance, gradient and Hessian, in units of
  /// kPlaceError: an end that is cut by another edge moves with the rounding of both.
  Scalar irradiance_slack = lift<Scalar>(0.0);
  Scalar gradient_slack = lift<Scalar>(0.0);
  Scalar hessian_slack = lift<Scalar>(0.0);
  /// Bound of the errors of places relative to their distance, in the same units.
  Scalar largest_place_error = lift<Scalar>(0.0);
};

namespace detail {

/// The numbers behind the topology of a view, at any scalar: where points and places are. Frozen, it can be
/// differentiated.
template <class Scalar, class WideScalar>
class ViewGeometry {
 public:
  ViewGeometry(const SceneMesh& mesh, int exponent, const Vector3<Scalar>& position, const Vector3<Scalar>& normal)
      : mesh_(mesh), exponent_(exponent), position_(position), normal_(normal) {}

  /// A place relative to the receiver.
  struct Place {
    Vector3<WideScalar> position;
    WideScalar height;  ///< over the horizon
    Scalar distance;
    Scalar error;   ///< bound of those of position and height, relative to the distance, in units of kPlaceError
    Scalar across;  ///< the same for what leads off the edge: not for where on the edge the place is

    ClippedVertex<Scalar, WideScalar> end() const { return {position, static_cast<Scalar>(height)}; }
  };

  Place place(std::size_t edge, const EdgePlace& place) const {
    const MeshEdge& e = mesh_.edges()[edge];
    Place start = point(e.start);
    Place end = point(e.end);
    const Scalar one = lift<Scalar>(1.0);
    if (place.kind == EdgePlace::Kind::kStart) return start;
    if (place.kind == EdgePlace::Kind::kEnd) return end;
    if (place.kind == EdgePlace::Kind::kHorizon) {
      Place cut = between(start, end, end.height, start.height, one);
      cut.height = WideScalar(lift<Scalar>(0.0));
      return cut;
    }
    if (place.kind == EdgePlace::Kind::kPoint) {
      // In view the point is on the edge: the plane through it across the edge's plane of view cuts the edge there.
      const Place crossing = point(place.id);
      const Vector3<WideScalar> across = cross(cross(start.position, end.position), crossing.position);
      return between(
          start, end, dot(across, end.position), dot(across, start.position),
          start.distance * end.distance * crossing.distance * (one + start.error + end.error + crossing.error));
    }
    const MeshEdge& other = mesh_.edges()[place.id];
    const Place other_start = point(other.start);
    const Place other_end = point(other.end);
    if (place.kind == EdgePlace::Kind::kInLine) {
      // The plane through the other line, across the common plane of view.
      const Vector3<WideScalar> along = difference(other_end.position, other_start.position);
      const Vector3<WideScalar> across = cross(cross(start.position, end.position), along);
      const auto offset = [&](const Place& at) { return dot(across, difference(at.position, other_start.position)); };
      const Scalar reach = other_start.distance + other_end.distance;
      return between(start, end, offset(end), offset(start),
                     lift<Scalar>(2.0) * start.distance * end.distance * reach *
                         (one + start.error + end.error + other_start.error + other_end.error) *
                         (one + reach / (start.distance < end.distance ? start.distance : end.distance)));
    }
    const Vector3<WideScalar> plane = cross(other_start.position, other_end.position);
    return between(start, end, dot(plane, end.position), dot(plane, start.position),
                   other_start.distance * other_end.distance * (one + other_start.error + other_end.error));
  }

  /// An edge from its start to its end.
  struct Edge {
    Vector3<WideScalar> vector;
    Scalar length;
    Scalar error;  ///< bound of that of its direction, in units of kPlaceError
  };

  Edge edge(std::size_t index) const {
    const Place start = point(mesh_.edges()[index].start);
    const Place end = point(mesh_.edges()[index].end);
    const Vector3<WideScalar> vector = difference(end.position, start.position);
    const Scalar length = norm(narrow<Scalar>(vector));
    return {vector, length, (start.error * start.distance + end.error * end.distance) / length};
  }

 private:
  Place point(std::size_t index) const {
    const MeshPoint& p = mesh_.points()[index];
    if (p.face == kNone) {
      const Vector3<Scalar> vertex = lifted(index);
      const Vector3<WideScalar> position = wideDifference<WideScalar>(vertex, position_);
      return {position, horizonHeight<WideScalar>(vertex, position_, normal_), norm(narrow<Scalar>(position)),
              lift<Scalar>(0.0), lift<Scalar>(0.0)};
    }
    const auto [start_weight, end_weight] = weights(p);
    return between(point(p.start), point(p.end), start_weight, -end_weight, lift<Scalar>(0.0));
  }

  Vector3<Scalar> lifted(std::size_t vertex) const {
    const auto scale = [this](double c) { return lift<Scalar>(std::ldexp(c, -exponent_)); };
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

  /// (end_side start - start_side end) / (end_side - start_side), the sides being of opposite signs. `side_error`
  /// bounds those of the sides, for each unit of distance of an end and in units of kPlaceError, if the ends are
  /// without error.
  Place between(const Place& start, const Place& end, const WideScalar& end_side, const WideScalar& start_side,
                const Scalar& side_error) const {
    using std::abs;
    const WideScalar sum = end_side - start_side;
    Place result;
    for (int k = 0; k < 3; ++k) {
      result.position(k) = (end_side * start.position(k) - start_side * end.position(k)) / sum;
    }
    result.height = (end_side * start.height - start_side * end.height) / sum;
    result.distance = norm(narrow<Scalar>(result.position));
    const Scalar reach = start.distance + end.distance;
    const Scalar length = norm(narrow<Scalar>(difference(end.position, start.position)));
    const Scalar amplified = lift<Scalar>(1.0) + start.error + end.error;
    result.across = amplified * reach / result.distance;
    result.error = result.across * (lift<Scalar>(1.0) + length * side_error / abs(static_cast<Scalar>(sum)));
    return result;
  }

  const SceneMesh& mesh_;
  int exponent_;
  Vector3<Scalar> position_;
  Vector3<Scalar> normal_;
};

/// What relative errors of the ends of an arc are multiplied with in its terms.
template <class Scalar>
struct ArcSensitivity {
  Scalar angle_over_sine;  ///< of the whole arc; 1 or more
  Scalar kappa;            ///< largest inverse distance of an end, or of the foot where the arc is cut there
};

/// Of an edge's arcs, of which there may be none where its `length` is 0.
template <class Scalar>
ArcSensitivity<Scalar> arcSensitivity(std::span<const BoundaryArc<Scalar>> arcs, const Scalar& first_distance,
                                      const Scalar& last_distance, const Scalar& length) {
  const Scalar one = lift<Scalar>(1.0);
  ArcSensitivity<Scalar> result{one, Scalar(one / (first_distance < last_distance ? first_distance : last_distance))};
  Scalar angle_over_foot_distance = lift<Scalar>(0.0);
  for (const BoundaryArc<Scalar>& arc : arcs) {
    angle_over_foot_distance = angle_over_foot_distance + arc.angle_over_foot_distance;
    if (arc.last.inverse_distance > result.kappa) result.kappa = arc.last.inverse_distance;
  }
  if (arcs.empty()) return result;
  // |r0||r1| sin D = |e| d.
  const Scalar angle_over_sine = angle_over_foot_distance * first_distance * last_distance / length;
  if (angle_over_sine > one) result.angle_over_sine = angle_over_sine;
  return result;
}

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
  const auto far_edge = geometry.edge(vertex.farther);
  const auto near_edge = geometry.edge(vertex.nearer);
  const Scalar gap = norm(narrow<Scalar>(difference(far.position, near.position)));
  const Scalar one = lift<Scalar>(1.0);
  const Scalar two = lift<Scalar>(2.0);
  const Scalar kappa_difference = gap / (far.distance * near.distance);
  const Scalar nu = static_cast<Scalar>(far.height) / far.distance;
  // Of the lengths of both edges nothing is left: they divide out.
  const Scalar crossing = static_cast<Scalar>(dot(far.position, cross(near_edge.vector, far_edge.vector))) /
                          (far.distance * far_edge.length * near_edge.length);
  const Vector3<Scalar> far_moment =
      scaled(narrow<Scalar>(cross(far.position, far_edge.vector)), Scalar(one / (far.distance * far_edge.length)));
  const Vector3<Scalar> near_moment =
      scaled(narrow<Scalar>(cross(near.position, near_edge.vector)), Scalar(one / (near.distance * near_edge.length)));
  const Scalar factor_over_nu = jump_change * kappa_difference * kappa_difference / (two * crossing);
  const Scalar factor = factor_over_nu * nu;
  ApparentVertexTerm<Scalar> term;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      term.hessian(i, j) = factor * (far_moment(i) * near_moment(j) + near_moment(i) * far_moment(j));
    }
  }
  const Scalar far_sine = norm(far_moment);
  const Scalar near_sine = norm(near_moment);
  term.size = two * abs(factor) * far_sine * near_sine;
  // Errors of the ingredients: of both moments and of the crossing absolute, since all three are of directions. None of
  // them depends on where on its edge a place is, but for its distance.
  const Scalar far_error = one + far.across + far_edge.error;
  const Scalar near_error = one + near.across + near_edge.error;
  const Scalar relative_error =
      two * (far.error * (two + far.distance / gap) + near.error * (two + near.distance / gap)) +
      (far_error + near_error) / abs(crossing) + far_error / far_sine + near_error / near_sine;
  term.slack = term.size * relative_error + two * abs(factor_over_nu) * far_sine * near_sine * two * far.error;
  return term;
}

/// The arcs of a view across which radiance jumps, with those that follow each other between equal radiances as one:
/// what a black polygon behind an edge divides would else be summed with other roundings.
inline std::vector<VisibleArc> radianceArcs(const VisibleBoundary& view, std::span<const double> radiances) {
  const auto radiance = [&](std::size_t polygon) { return polygon == kNone ? 0.0 : radiances[polygon]; };
  std::vector<VisibleArc> arcs;
  for (const VisibleArc& arc : view.arcs) {
    if (radiance(arc.sides.left) == radiance(arc.sides.right)) continue;
    if (!arcs.empty() && arcs.back().edge == arc.edge && arcs.back().last == arc.first &&
        radiance(arcs.back().sides.left) == radiance(arc.sides.left) &&
        radiance(arcs.back().sides.right) == radiance(arc.sides.right)) {
      arcs.back().last = arc.last;
    } else {
      arcs.push_back(arc);
    }
  }
  return arcs;
}

// Everything that a view adds up to, from its topology: arcs with their radiance jumps, arcs of the horizon, apparent
// vertices. `radiances` of the polygons in W/(m^2 sr); lengths, the position's included, in units of 2^exponent of the
// mesh's. Requires that the topology is that of the receiver, or of one near it on the same side of all visibility
// events.
template <class Scalar, class WideScalar = Wide<Scalar>>
BoundaryOfView<Scalar> boundaryOfView(const SceneMesh& mesh, const VisibleBoundary& view,
                                      std::span<const double> radiances, const Vector3<Scalar>& position,
                                      const Vector3<Scalar>& normal, int exponent = 0) {
  using std::abs;
  using std::atan2;
  const detail::ViewGeometry<Scalar, WideScalar> geometry(mesh, exponent, position, normal);
  const auto radiance = [&](std::size_t polygon) { return lift<Scalar>(polygon == kNone ? 0.0 : radiances[polygon]); };
  const Scalar zero = lift<Scalar>(0.0);
  const Scalar one = lift<Scalar>(1.0);
  BoundaryOfView<Scalar> result;
  std::vector<BoundaryArc<Scalar>>& arcs = result.boundary.arcs;
  for (const VisibleArc& arc : radianceArcs(view, radiances)) {
    const Scalar radiance_jump = radiance(arc.sides.right) - radiance(arc.sides.left);
    const auto first = geometry.place(arc.edge, arc.first);
    const auto last = geometry.place(arc.edge, arc.last);
    ClippedVertex<Scalar, WideScalar> start = first.end();
    ClippedVertex<Scalar, WideScalar> end = last.end();
    // A place that is cut out above the horizon may come to lie below it by rounding.
    if (start.height < zero) start.height = zero;
    if (end.height < zero) end.height = zero;
    // Two cuts may come to lie in one place by rounding: what is between them is less than their errors.
    const std::size_t count = arcs.size();
    const Scalar length = norm(narrow<Scalar>(difference(last.position, first.position)));
    if (isPositive(length)) appendEdgeArcs(start, end, normal, radiance_jump, arcs);
    const auto sensitivity = detail::arcSensitivity<Scalar>(std::span<const BoundaryArc<Scalar>>(arcs).subspan(count),
                                                            first.distance, last.distance, length);
    for (const Scalar& error : {first.error, last.error}) {
      if (error > result.largest_place_error) result.largest_place_error = error;
    }
    const Scalar slack = abs(radiance_jump) * (one + first.error + last.error) * sensitivity.angle_over_sine;
    result.irradiance_slack = result.irradiance_slack + slack;
    result.gradient_slack = result.gradient_slack + lift<Scalar>(kGradientSlack) * slack * sensitivity.kappa;
    result.hessian_slack =
        result.hessian_slack + lift<Scalar>(kHessianSlack) * slack * sensitivity.kappa * sensitivity.kappa;
  }
  for (std::size_t i = 0; i < view.horizon.size(); ++i) {
    const HorizonPlace& here = view.horizon[i];
    const HorizonPlace& next = view.horizon[(i + 1) % view.horizon.size()];
    if (radiance(here.counterclockwise) == zero) continue;
    const auto from = geometry.place(here.edge, here.place);
    const auto to = geometry.place(next.edge, next.place);
    const Vector3<Scalar> moment = narrow<Scalar>(cross(from.position, to.position));
    const Scalar cosine_product = dot(narrow<Scalar>(from.position), narrow<Scalar>(to.position));
    const Scalar angle = norm(normal) * radiance(here.counterclockwise) * Scalar(atan2(norm(moment), cosine_product));
    result.boundary.horizon_angle = result.boundary.horizon_angle + angle;
    result.boundary.horizon_size = result.boundary.horizon_size + angle;
    ++result.horizon_arcs;
    result.irradiance_slack = result.irradiance_slack + radiance(here.counterclockwise) * (one + from.error + to.error);
  }
  for (const ApparentVertex& vertex : view.apparent_vertices) {
    // Four radiances, of which large ones may cancel.
    const auto wide = [&](std::size_t polygon) { return WideScalar(radiance(polygon)); };
    const auto change = static_cast<Scalar>((wide(vertex.before.right) - wide(vertex.before.left)) +
                                            (wide(vertex.after.left) - wide(vertex.after.right)));
    if (change == zero) continue;
    result.vertex_terms.push_back(apparentVertexTerm<Scalar, WideScalar>(geometry, vertex, change));
  }
  return result;
}

}  // namespace irradiff
