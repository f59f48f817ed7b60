#include "derivatives/visibility/view_predicates.h"

#include "derivatives/scene/certified_sign.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace irradiff {
namespace {

template <class Number>
Vector3<Number> sum(const Vector3<Number>& a, const Vector3<Number>& b) {
  return {a(0) + b(0), a(1) + b(1), a(2) + b(2)};
}

template <class Number>
Number magnitude(const Number& number, int sign) {
  return sign < 0 ? -number : number;
}

BoundedNumber bounded(const ExactNumber& number) {
  const double value = number.rounded();
  return {value, 0x1p-52 * std::abs(value) + std::numeric_limits<double>::min()};
}

}  // namespace

ViewPredicates::ViewPredicates(const SceneMesh& mesh, const Eigen::Vector3d& position, const Eigen::Vector3d& normal)
    : mesh_(mesh), position_(position), normal_(normal) {
  const std::vector<MeshPoint>& points = mesh_.points();
  bounded_rays_.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].face == kNone) {
      bounded_rays_.push_back(difference(lifted<BoundedNumber>(mesh_.vertices()[i]), lifted<BoundedNumber>(position_)));
    } else {
      bounded_rays_.push_back(sum(scaled(bounded_rays_[points[i].start], bounded(points[i].start_weight)),
                                  scaled(bounded_rays_[points[i].end], bounded(points[i].end_weight))));
    }
  }
  bounded_planes_.reserve(mesh_.edges().size());
  for (const MeshEdge& edge : mesh_.edges()) {
    bounded_planes_.push_back(cross(bounded_rays_[edge.start], bounded_rays_[edge.end]));
  }
}

template <class Number>
Vector3<Number> ViewPredicates::ray(std::size_t point) const {
  if constexpr (std::is_same_v<Number, BoundedNumber>) {
    return bounded_rays_[point];
  } else {
    const auto known = exact_rays_.find(point);
    if (known != exact_rays_.end()) return known->second;
    const MeshPoint& p = mesh_.points()[point];
    Vector3<ExactNumber> value =
        p.face == kNone
            ? difference(lifted<ExactNumber>(mesh_.vertices()[point]), lifted<ExactNumber>(position_))
            : sum(scaled(ray<ExactNumber>(p.start), p.start_weight), scaled(ray<ExactNumber>(p.end), p.end_weight));
    exact_rays_.emplace(point, value);
    return value;
  }
}
template Vector3<BoundedNumber> ViewPredicates::ray(std::size_t) const;
template Vector3<ExactNumber> ViewPredicates::ray(std::size_t) const;

template <class Number>
Number ViewPredicates::weight(std::size_t point) const {
  const MeshPoint& p = mesh_.points()[point];
  if (p.face == kNone) return Number(1.0);
  if constexpr (std::is_same_v<Number, ExactNumber>) {
    return p.start_weight + p.end_weight;
  } else {
    return bounded(p.start_weight) + bounded(p.end_weight);
  }
}

template <class Number>
Vector3<Number> ViewPredicates::planeOfView(std::size_t edge) const {
  if constexpr (std::is_same_v<Number, BoundedNumber>) {
    return bounded_planes_[edge];
  } else {
    const MeshEdge& e = mesh_.edges()[edge];
    return cross(ray<Number>(e.start), ray<Number>(e.end));
  }
}

template <class Number>
Vector3<Number> ViewPredicates::faceNormal(std::size_t face) const {
  const std::array<std::size_t, 3>& plane = mesh_.faces()[face].plane;
  const Vector3<Number> origin = lifted<Number>(mesh_.vertices()[plane[0]]);
  return cross<Number>(difference(lifted<Number>(mesh_.vertices()[plane[1]]), origin),
                       difference(lifted<Number>(mesh_.vertices()[plane[2]]), origin));
}

template <class Number>
Number ViewPredicates::faceDistance(std::size_t face) const {
  const std::array<std::size_t, 3>& plane = mesh_.faces()[face].plane;
  return determinant(ray<Number>(plane[0]), ray<Number>(plane[1]), ray<Number>(plane[2]));
}

int ViewPredicates::side(std::size_t edge, std::size_t point) const {
  if (mesh_.isKnownOnLine(point, edge)) return 0;
  return certifiedSign(
      [&]<class Number>(std::type_identity<Number>) { return dot(planeOfView<Number>(edge), ray<Number>(point)); });
}

bool ViewPredicates::isRadial(std::size_t edge) const {
  const Vector3<BoundedNumber> plane = planeOfView<BoundedNumber>(edge);
  for (int i = 0; i < 3; ++i) {
    if (plane(i).hasSign() && plane(i).sign() != 0) return false;
  }
  const Vector3<ExactNumber> exact = planeOfView<ExactNumber>(edge);
  return exact(0).sign() == 0 && exact(1).sign() == 0 && exact(2).sign() == 0;
}

int ViewPredicates::height(std::size_t point) const {
  return certifiedSign(
      [&]<class Number>(std::type_identity<Number>) { return dot(normal<Number>(), ray<Number>(point)); });
}

int ViewPredicates::receiverOffset(std::size_t face) const {
  return certifiedSign([&]<class Number>(std::type_identity<Number>) { return faceDistance<Number>(face); });
}

bool ViewPredicates::runsTowards(std::size_t point, std::size_t face) const {
  const int along = certifiedSign(
      [&]<class Number>(std::type_identity<Number>) { return dot(faceNormal<Number>(face), ray<Number>(point)); });
  return along * receiverOffset(face) > 0;
}

template <class Number>
PlaceWeights<Number> ViewPredicates::weights(std::size_t edge, const EdgePlace& place) const {
  const MeshEdge& e = mesh_.edges()[edge];
  switch (place.kind) {
    case EdgePlace::Kind::kStart:
      return {Number(1.0), Number(0.0)};
    case EdgePlace::Kind::kEnd:
      return {Number(0.0), Number(1.0)};
    case EdgePlace::Kind::kEdge: {
      // The ends are on opposite sides of the other edge's plane of view.
      const int start_side = side(place.id, e.start);
      const Vector3<Number> plane = planeOfView<Number>(place.id);
      return {magnitude(dot(plane, ray<Number>(e.end)), -start_side),
              magnitude(dot(plane, ray<Number>(e.start)), start_side)};
    }
    case EdgePlace::Kind::kPoint: {
      const Vector3<Number> plane = planeOfView<Number>(edge);
      return {determinant(ray<Number>(place.id), ray<Number>(e.end), plane),
              determinant(ray<Number>(e.start), ray<Number>(place.id), plane)};
    }
    case EdgePlace::Kind::kInLine: {
      const Number at_start = inLineExcess<Number>(edge, place.id, ray<Number>(e.start), weight<Number>(e.start));
      const Number at_end = inLineExcess<Number>(edge, place.id, ray<Number>(e.end), weight<Number>(e.end));
      const int start_sign = certifiedSign([&]<class N>(std::type_identity<N>) {
        return inLineExcess<N>(edge, place.id, ray<N>(e.start), weight<N>(e.start));
      });
      return {magnitude(at_end, -start_sign), magnitude(at_start, start_sign)};
    }
    case EdgePlace::Kind::kHorizon:
      break;
  }
  const int start_side = height(e.start);
  return {magnitude(dot(normal<Number>(), ray<Number>(e.end)), -start_side),
          magnitude(dot(normal<Number>(), ray<Number>(e.start)), start_side)};
}
template PlaceWeights<BoundedNumber> ViewPredicates::weights(std::size_t, const EdgePlace&) const;
template PlaceWeights<ExactNumber> ViewPredicates::weights(std::size_t, const EdgePlace&) const;

PlaceWeights<int> ViewPredicates::weightSigns(std::size_t edge, const EdgePlace& place) const {
  return {certifiedSign([&]<class Number>(std::type_identity<Number>) { return weights<Number>(edge, place).start; }),
          certifiedSign([&]<class Number>(std::type_identity<Number>) { return weights<Number>(edge, place).end; })};
}

int ViewPredicates::compare(std::size_t edge, const EdgePlace& a, const EdgePlace& b) const {
  if (a == b) return 0;
  return certifiedSign([&]<class Number>(std::type_identity<Number>) {
    const PlaceWeights<Number> of_a = weights<Number>(edge, a);
    const PlaceWeights<Number> of_b = weights<Number>(edge, b);
    return of_a.end * of_b.start - of_b.end * of_a.start;
  });
}

bool ViewPredicates::isKnownInPlane(std::size_t edge, const EdgePlace& place, std::size_t face) const {
  const MeshEdge& e = mesh_.edges()[edge];
  if (std::ranges::find(e.faces, face) != e.faces.end()) return true;
  switch (place.kind) {
    case EdgePlace::Kind::kStart:
      return mesh_.isKnownInPlane(e.start, face);
    case EdgePlace::Kind::kEnd:
      return mesh_.isKnownInPlane(e.end, face);
    case EdgePlace::Kind::kPoint:
      return mesh_.isKnownOnLine(place.id, edge) && mesh_.isKnownInPlane(place.id, face);
    default:
      return false;
  }
}

int ViewPredicates::compareDepth(std::size_t edge, const EdgePlace& place, std::size_t face) const {
  if (isKnownInPlane(edge, place, face)) return 0;
  // Inverse distances: of the edge the weights' sum, each weight times that of the ray; of the plane normal.c/distance.
  const MeshEdge& e = mesh_.edges()[edge];
  const int difference_sign = certifiedSign([&]<class Number>(std::type_identity<Number>) {
    const PlaceWeights<Number> at = weights<Number>(edge, place);
    const Number of_edge = at.start * weight<Number>(e.start) + at.end * weight<Number>(e.end);
    const Vector3<Number> c = sum(scaled(ray<Number>(e.start), at.start), scaled(ray<Number>(e.end), at.end));
    return of_edge * faceDistance<Number>(face) - dot(faceNormal<Number>(face), c);
  });
  return difference_sign * receiverOffset(face);
}

int ViewPredicates::compareFaces(std::size_t edge, const EdgePlace& place, std::size_t first,
                                 std::size_t second) const {
  if (isKnownInPlane(edge, place, first) && isKnownInPlane(edge, place, second)) return 0;
  const int difference_sign = certifiedSign([&]<class Number>(std::type_identity<Number>) {
    const Vector3<Number> c = direction<Number>(edge, place);
    return dot(faceNormal<Number>(first), c) * faceDistance<Number>(second) -
           dot(faceNormal<Number>(second), c) * faceDistance<Number>(first);
  });
  return difference_sign * receiverOffset(first) * receiverOffset(second);
}

int ViewPredicates::compareFacesRight(std::size_t edge, std::size_t first, std::size_t second) const {
  const int difference_sign = certifiedSign([&]<class Number>(std::type_identity<Number>) {
    const Vector3<Number> right = planeOfView<Number>(edge);
    return dot(faceNormal<Number>(first), right) * faceDistance<Number>(second) -
           dot(faceNormal<Number>(second), right) * faceDistance<Number>(first);
  });
  return difference_sign * receiverOffset(first) * receiverOffset(second);
}

int ViewPredicates::compareCrossing(std::size_t first, std::size_t second) const {
  const MeshEdge& a = mesh_.edges()[first];
  const MeshEdge& b = mesh_.edges()[second];
  const EdgePlace on_a{EdgePlace::Kind::kEdge, second};
  const EdgePlace on_b{EdgePlace::Kind::kEdge, first};
  // |c| is the same on both: the weights are those of the cross product of the two planes of view.
  return certifiedSign([&]<class Number>(std::type_identity<Number>) {
    const PlaceWeights<Number> at_a = weights<Number>(first, on_a);
    const PlaceWeights<Number> at_b = weights<Number>(second, on_b);
    return at_a.start * weight<Number>(a.start) + at_a.end * weight<Number>(a.end) -
           (at_b.start * weight<Number>(b.start) + at_b.end * weight<Number>(b.end));
  });
}

int ViewPredicates::comparePoint(std::size_t point, std::size_t edge) const {
  if (mesh_.isKnownOnLine(point, edge)) return 0;
  const MeshEdge& e = mesh_.edges()[edge];
  return certifiedSign([&]<class Number>(std::type_identity<Number>) {
    // The weights are those of the ray times the square of the plane's normal.
    const PlaceWeights<Number> at = weights<Number>(edge, {EdgePlace::Kind::kPoint, point});
    const Vector3<Number> plane = planeOfView<Number>(edge);
    return weight<Number>(point) * dot(plane, plane) -
           (at.start * weight<Number>(e.start) + at.end * weight<Number>(e.end));
  });
}

int ViewPredicates::comparePoints(std::size_t first, std::size_t second) const {
  if (first == second) return 0;
  return certifiedSign([&]<class Number>(std::type_identity<Number>) {
    const Vector3<Number> a = ray<Number>(first);
    const Vector3<Number> b = ray<Number>(second);
    return dot(a, b) * weight<Number>(first) - dot(a, a) * weight<Number>(second);
  });
}

int ViewPredicates::inLineOrientation(std::size_t edge, std::size_t other) const {
  const MeshEdge& o = mesh_.edges()[other];
  return certifiedSign([&]<class Number>(std::type_identity<Number>) {
    return determinant(planeOfView<Number>(edge), ray<Number>(o.start), ray<Number>(o.end));
  });
}

template <class Number>
Number ViewPredicates::inLineExcess(std::size_t edge, std::size_t other, const Vector3<Number>& c,
                                    const Number& inverse_distance) const {
  // c = a ray(start) + b ray(end) of the other edge, with a, b as determinants over that of both rays.
  const MeshEdge& o = mesh_.edges()[other];
  const Vector3<Number> plane = planeOfView<Number>(edge);
  const Number of_other = determinant(plane, c, ray<Number>(o.end)) * weight<Number>(o.start) +
                          determinant(plane, ray<Number>(o.start), c) * weight<Number>(o.end);
  return inverse_distance * determinant(plane, ray<Number>(o.start), ray<Number>(o.end)) - of_other;
}

bool ViewPredicates::covers(std::size_t other, std::size_t edge, const EdgePlace& first, const EdgePlace& last) const {
  const MeshEdge& o = mesh_.edges()[other];
  const auto turn = [&](bool from_start) {
    return certifiedSign([&]<class Number>(std::type_identity<Number>) {
      const Vector3<Number> middle = sum(direction<Number>(edge, first), direction<Number>(edge, last));
      const Vector3<Number> plane = planeOfView<Number>(edge);
      return from_start ? determinant(plane, ray<Number>(o.start), middle)
                        : determinant(plane, middle, ray<Number>(o.end));
    });
  };
  const int orientation = inLineOrientation(edge, other);
  return turn(true) == orientation && turn(false) == orientation;
}

int ViewPredicates::compareInLine(std::size_t edge, std::size_t other, const EdgePlace& first,
                                  const EdgePlace& last) const {
  const MeshEdge& e = mesh_.edges()[edge];
  const int difference_sign = certifiedSign([&]<class Number>(std::type_identity<Number>) {
    const PlaceWeights<Number> at_first = weights<Number>(edge, first);
    const PlaceWeights<Number> at_last = weights<Number>(edge, last);
    const Number start = at_first.start + at_last.start;
    const Number end = at_first.end + at_last.end;
    const Vector3<Number> c = sum(scaled(ray<Number>(e.start), start), scaled(ray<Number>(e.end), end));
    return inLineExcess<Number>(edge, other, c, start * weight<Number>(e.start) + end * weight<Number>(e.end));
  });
  return difference_sign * inLineOrientation(edge, other);
}

bool ViewPredicates::passThroughInLine(std::size_t edge, std::size_t other) const {
  const MeshEdge& e = mesh_.edges()[edge];
  const auto excessAt = [&](std::size_t point) {
    return certifiedSign([&]<class Number>(std::type_identity<Number>) {
      return inLineExcess<Number>(edge, other, ray<Number>(point), weight<Number>(point));
    });
  };
  return excessAt(e.start) * excessAt(e.end) < 0;
}

bool ViewPredicates::shareLine(std::size_t edge, std::size_t other) const {
  const MeshEdge& o = mesh_.edges()[other];
  return side(edge, o.start) == 0 && side(edge, o.end) == 0 && comparePoint(o.start, edge) == 0 &&
         comparePoint(o.end, edge) == 0;
}

template <class Number>
Vector3<Number> ViewPredicates::direction(std::size_t edge, const EdgePlace& place) const {
  const MeshEdge& e = mesh_.edges()[edge];
  const PlaceWeights<Number> at = weights<Number>(edge, place);
  return sum(scaled(ray<Number>(e.start), at.start), scaled(ray<Number>(e.end), at.end));
}
template Vector3<BoundedNumber> ViewPredicates::direction(std::size_t, const EdgePlace&) const;
template Vector3<ExactNumber> ViewPredicates::direction(std::size_t, const EdgePlace&) const;

}  // namespace irradiff
