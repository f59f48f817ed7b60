#include "derivatives/visibility/scene_mesh.h"

#include "derivatives/scene/certified_sign.h"
#include "derivatives/scene/triangulation.h"
#include "derivatives/visibility/lifted_vector.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <type_traits>
#include <utility>

namespace irradiff {
namespace {

/// Faces for which the sides of all pairs are kept: a megabyte.
constexpr std::size_t kMostTabledFaces = 1024;

struct Box {
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d upper = -lower;

  bool overlaps(const Box& other) const {
    return (lower.array() <= other.upper.array()).all() && (other.lower.array() <= upper.array()).all();
  }
};

template <class Number>
Number offsetFromPlane(const std::array<Eigen::Vector3d, 3>& plane, const Eigen::Vector3d& position) {
  const Vector3<Number> p = lifted<Number>(position);
  return determinant<Number>(difference(lifted<Number>(plane[0]), p), difference(lifted<Number>(plane[1]), p),
                             difference(lifted<Number>(plane[2]), p));
}

/// Three vertices that span a wide triangle: the first, the one farthest from it, and the one farthest from the line
/// through both.
std::array<std::size_t, 3> widestTriangle(const std::vector<Eigen::Vector3d>& positions,
                                          const std::vector<std::size_t>& vertices) {
  const Eigen::Vector3d& first = positions[vertices[0]];
  const auto farthest = [&](auto distance) {
    return *std::ranges::max_element(vertices, {}, [&](std::size_t v) -> double { return distance(positions[v]); });
  };
  const std::size_t second = farthest([&](const Eigen::Vector3d& p) { return (p - first).lpNorm<Eigen::Infinity>(); });
  // Scaled up, so that the cross products of a tiny face do not underflow.
  const double extent = (positions[second] - first).lpNorm<Eigen::Infinity>();
  const Eigen::Vector3d along = (positions[second] - first) / extent;
  const std::size_t third =
      farthest([&](const Eigen::Vector3d& p) { return along.cross((p - first) / extent).lpNorm<Eigen::Infinity>(); });
  return {vertices[0], second, third};
}

/// A point on the line in which two planes meet, and where on it: numerator/denominator along the line's direction.
struct CreasePoint {
  MeshPoint point;
  ExactNumber numerator;
  ExactNumber denominator;  ///< > 0

  int compare(const CreasePoint& other) const {
    return (numerator * other.denominator - other.numerator * denominator).sign();
  }
};

}  // namespace

SceneMesh::SceneMesh(std::span<const Polygon> polygons) {
  double largest = 0.0;
  for (const Polygon& polygon : polygons) {
    for (const Eigen::Vector3d& vertex : polygon.vertices)
      largest = std::max(largest, vertex.lpNorm<Eigen::Infinity>());
  }
  std::frexp(largest, &exponent_);
  addPolygons(polygons);
  first_crease_ = edges_.size();

  std::vector<Box> boxes(faces_.size());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    for (const std::size_t v : faces_[f].vertices) {
      boxes[f].lower = boxes[f].lower.cwiseMin(vertices_[v]);
      boxes[f].upper = boxes[f].upper.cwiseMax(vertices_[v]);
    }
  }
  if (faces_.size() <= kMostTabledFaces) {
    std::vector<PlaneSide> sides(faces_.size() * faces_.size(), PlaneSide::kInPlane);
    for (std::size_t a = 0; a < faces_.size(); ++a) {
      for (std::size_t b = 0; b < faces_.size(); ++b) {
        if (a != b) sides[a * faces_.size() + b] = computeSideOfPlane(a, b);
      }
    }
    sides_ = std::move(sides);
  }
  PiercedPoints pierced_points;
  for (std::size_t a = 0; a < faces_.size(); ++a) {
    for (std::size_t b = a + 1; b < faces_.size(); ++b) {
      if (faces_[a].polygon != faces_[b].polygon && boxes[a].overlaps(boxes[b]) &&
          sideOfPlane(a, b) == PlaneSide::kCrosses && sideOfPlane(b, a) == PlaneSide::kCrosses) {
        addCreases(a, b, pierced_points);
      }
    }
  }
}

void SceneMesh::addPolygons(std::span<const Polygon> polygons) {
  const auto less = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  std::map<Eigen::Vector3d, std::size_t, decltype(less)> known(less);
  std::vector<std::vector<std::size_t>> loops;
  for (const Polygon& polygon : polygons) {
    std::vector<std::size_t>& loop = loops.emplace_back();
    for (const Eigen::Vector3d& vertex : polygon.vertices) {
      const Eigen::Vector3d scaled = vertex.unaryExpr([&](double c) { return std::ldexp(c, -exponent_); });
      const auto [position, is_new] = known.try_emplace(scaled, vertices_.size());
      if (is_new) {
        vertices_.push_back(scaled);
        points_.push_back({position->second, position->second});
      }
      loop.push_back(position->second);
    }
  }
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> edges;
  const auto edgeBetween = [&](std::size_t start, std::size_t end) {
    const auto [position, is_new] = edges.try_emplace(std::minmax(start, end), edges_.size());
    if (is_new) edges_.push_back({start, end, {}});
    return position->second;
  };
  const auto addFace = [&](std::size_t polygon, std::vector<std::size_t> vertices) {
    MeshFace face{polygon, std::move(vertices), {}, {}};
    face.plane = widestTriangle(vertices_, face.vertices);
    for (std::size_t i = 0; i < face.vertices.size(); ++i) {
      const std::size_t edge = edgeBetween(face.vertices[i], face.vertices[(i + 1) % face.vertices.size()]);
      face.edges.push_back(edge);
      edges_[edge].faces.push_back(faces_.size());
    }
    faces_.push_back(std::move(face));
  };
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const std::vector<std::size_t>& loop = loops[i];
    const std::array<std::size_t, 3> plane = widestTriangle(vertices_, loop);
    if (loop.size() == 3 || liesInPlane(loop, plane)) {
      addFace(i, loop);
      continue;
    }
    for (const std::array<std::size_t, 3>& triangle : triangulate(polygons[i])) {
      addFace(i, {loop[triangle[0]], loop[triangle[1]], loop[triangle[2]]});
    }
  }
}

bool SceneMesh::liesInPlane(const std::vector<std::size_t>& vertices, const std::array<std::size_t, 3>& plane) const {
  const std::array<Eigen::Vector3d, 3> corners{vertices_[plane[0]], vertices_[plane[1]], vertices_[plane[2]]};
  return std::ranges::all_of(vertices, [&](std::size_t v) {
    return certifiedSign([&]<class Number>(std::type_identity<Number>) {
             return offsetFromPlane<Number>(corners, vertices_[v]);
           }) == 0;
  });
}

int SceneMesh::planeOffset(std::size_t face, const Eigen::Vector3d& position) const {
  const std::array<std::size_t, 3>& plane = faces_[face].plane;
  const std::array<Eigen::Vector3d, 3> corners{vertices_[plane[0]], vertices_[plane[1]], vertices_[plane[2]]};
  return certifiedSign(
      [&]<class Number>(std::type_identity<Number>) { return offsetFromPlane<Number>(corners, position); });
}

bool SceneMesh::isKnownInPlane(std::size_t point, std::size_t face) const {
  const MeshPoint& p = points_[point];
  const std::vector<std::size_t>& vertices = faces_[face].vertices;
  const auto isVertex = [&](std::size_t v) { return std::ranges::find(vertices, v) != vertices.end(); };
  // Faces are planar to the last bit.
  return p.face == face || (isVertex(p.start) && (p.end == p.start || isVertex(p.end)));
}

bool SceneMesh::isKnownOnLine(std::size_t point, std::size_t edge) const {
  const MeshEdge& e = edges_[edge];
  if (point == e.start || point == e.end) return true;
  const MeshPoint& p = points_[point];
  if (p.face != kNone && std::minmax(p.start, p.end) == std::minmax(e.start, e.end)) return true;
  return e.is_crease && std::ranges::all_of(e.faces, [&](std::size_t face) { return isKnownInPlane(point, face); });
}

int SceneMesh::planeOffset(std::size_t face, std::size_t point) const {
  if (isKnownInPlane(point, face)) return 0;
  const MeshPoint& p = points_[point];
  if (p.face == kNone) return planeOffset(face, vertices_[point]);
  const int start = planeOffset(face, p.start);
  const int end = planeOffset(face, p.end);
  if (start * end >= 0) return start + end > 0 ? 1 : (start + end < 0 ? -1 : 0);
  const std::array<std::size_t, 3>& plane = faces_[face].plane;
  const std::array<Eigen::Vector3d, 3> corners{vertices_[plane[0]], vertices_[plane[1]], vertices_[plane[2]]};
  return (p.start_weight * offsetFromPlane<ExactNumber>(corners, vertices_[p.start]) +
          p.end_weight * offsetFromPlane<ExactNumber>(corners, vertices_[p.end]))
      .sign();
}

PlaneSide SceneMesh::computeSideOfPlane(std::size_t face, std::size_t other) const {
  bool any_front = false;
  bool any_behind = false;
  for (const std::size_t v : faces_[face].vertices) {
    if (std::ranges::find(faces_[other].vertices, v) != faces_[other].vertices.end()) continue;
    const int side = planeOffset(other, v);
    any_front = any_front || side > 0;
    any_behind = any_behind || side < 0;
    if (any_front && any_behind) return PlaneSide::kCrosses;
  }
  if (any_front) return PlaneSide::kFront;
  return any_behind ? PlaneSide::kBehind : PlaneSide::kInPlane;
}

PlaneSide SceneMesh::sideOfPlane(std::size_t face, std::size_t other) const {
  return sides_.empty() ? computeSideOfPlane(face, other) : sides_[face * faces_.size() + other];
}

void SceneMesh::addCreases(std::size_t a, std::size_t b, PiercedPoints& pierced_points) {
  const auto normalOf = [&](std::size_t face) {
    const std::array<std::size_t, 3>& plane = faces_[face].plane;
    const Vector3<ExactNumber> origin = lifted<ExactNumber>(vertices_[plane[0]]);
    return cross<ExactNumber>(difference(lifted<ExactNumber>(vertices_[plane[1]]), origin),
                              difference(lifted<ExactNumber>(vertices_[plane[2]]), origin));
  };
  const Vector3<ExactNumber> along = cross<ExactNumber>(normalOf(a), normalOf(b));
  const auto positioned = [&](MeshPoint p) {
    const ExactNumber numerator = p.start_weight * dot(along, lifted<ExactNumber>(vertices_[p.start])) +
                                  p.end_weight * dot(along, lifted<ExactNumber>(vertices_[p.end]));
    const ExactNumber denominator = p.start_weight + p.end_weight;
    return CreasePoint{std::move(p), numerator, denominator};
  };
  // Where the boundary of `face` passes through the plane of `other`, in order. Of the pieces between them some may lie
  // outside a face that is not convex: an edge that bounds nothing does no harm.
  const auto pierced = [&](std::size_t face, std::size_t other) {
    const std::array<std::size_t, 3>& plane = faces_[other].plane;
    const std::array<Eigen::Vector3d, 3> corners{vertices_[plane[0]], vertices_[plane[1]], vertices_[plane[2]]};
    std::vector<CreasePoint> positions;
    const std::vector<std::size_t>& loop = faces_[face].vertices;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::size_t start = loop[i];
      const std::size_t end = loop[(i + 1) % loop.size()];
      const int start_side = planeOffset(other, start);
      const int end_side = planeOffset(other, end);
      if (start_side == 0) positions.push_back(positioned(points_[start]));
      if (start_side * end_side >= 0) continue;
      MeshPoint point{start, end, other, offsetFromPlane<ExactNumber>(corners, vertices_[end]),
                      offsetFromPlane<ExactNumber>(corners, vertices_[start])};
      if (point.start_weight.sign() < 0) point.start_weight = -point.start_weight;
      if (point.end_weight.sign() < 0) point.end_weight = -point.end_weight;
      positions.push_back(positioned(std::move(point)));
    }
    std::ranges::sort(positions, [](const CreasePoint& p, const CreasePoint& q) { return p.compare(q) < 0; });
    return positions;
  };
  std::vector<CreasePoint> of_a = pierced(a, b);
  const std::vector<CreasePoint> of_b = pierced(b, a);
  const CreasePoint& first = of_a.front().compare(of_b.front()) < 0 ? of_b.front() : of_a.front();
  const CreasePoint& last = of_a.back().compare(of_b.back()) < 0 ? of_a.back() : of_b.back();
  if (first.compare(last) >= 0) return;
  std::vector<CreasePoint> all;
  std::ranges::merge(of_a, of_b, std::back_inserter(all),
                     [](const CreasePoint& p, const CreasePoint& q) { return p.compare(q) < 0; });
  // The triangles of a polygon share edges, and what passes through one of them may end where the next begins.
  const auto indexOf = [&](const MeshPoint& point) {
    if (point.face == kNone) return point.start;
    const auto [lower, upper] = std::minmax(point.start, point.end);
    const auto [known, is_new] = pierced_points.try_emplace({lower, upper, point.face}, points_.size());
    if (is_new) points_.push_back(point);
    return known->second;
  };
  std::size_t previous = kNone;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].compare(first) < 0 || all[i].compare(last) > 0) continue;
    if (previous != kNone && all[previous].compare(all[i]) == 0) continue;
    if (previous != kNone) edges_.push_back({indexOf(all[previous].point), indexOf(all[i].point), {a, b}, true});
    previous = i;
  }
}

}  // namespace irradiff
