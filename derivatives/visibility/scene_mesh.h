#pragma once

#include "derivatives/boundary/vector.h"
#include "derivatives/scene/bounded_number.h"
#include "derivatives/scene/exact_number.h"
#include "derivatives/scene/polygon.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <vector>

namespace irradiff {

inline constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// A fixed point of the scene: a vertex, or the point in which the line through two vertices passes through the plane
/// of a face. In both cases (start_weight start + end_weight end) / (start_weight + end_weight) with weights >= 0.
struct MeshPoint {
  std::size_t start;         ///< a vertex
  std::size_t end;           ///< a vertex; that of `start` if the point is that vertex
  std::size_t face = kNone;  ///< whose plane the line passes through, kNone for a vertex
  ExactNumber start_weight{1.0};
  ExactNumber end_weight{};
};

/// A simple polygon that is planar to the last bit, or a triangle of a polygon that is not.
struct MeshFace {
  std::size_t polygon;                ///< index in the scene
  std::vector<std::size_t> vertices;  ///< in the order of the polygon
  std::vector<std::size_t> edges;     ///< edge i from vertex i to the next
  std::array<std::size_t, 3> plane;   ///< three of the vertices, not on one line
};

/// A straight line between two points, from `start` to `end`: an edge of faces, or a crease in which two faces pass
/// through each other.
struct MeshEdge {
  std::size_t start;               ///< a point
  std::size_t end;                 ///< a point
  std::vector<std::size_t> faces;  ///< those it bounds, or the two that pass through each other
  bool is_crease = false;
};

/// How one face lies to the plane of another.
enum class PlaneSide : std::int8_t {
  kBehind = -1,  ///< on its negative side, or partly in it
  kCrosses = 0,
  kFront = 1,
  kInPlane = 2,
};

/// The geometry of a scene as visibility sees it: every vertex, edge and face once, and the creases between faces that
/// pass through each other. A polygon whose vertices leave its plane, which validation allows to 1e-10 of its extent,
/// is a surface of triangles; so every edge lies in the planes of its faces to the last bit, and no predicate knows a
/// tolerance. Coordinates are scaled by a power of two, the largest being in [1/2, 1).
///
/// What enters are validated polygons; what leaves is data that does not change with the receiver. Predicates on a mesh
/// and a receiver: view_predicates.h.
class SceneMesh {
 public:
  /// Requires validated polygons. O(n^2) in the number of faces, with a test of boxes for most pairs.
  explicit SceneMesh(std::span<const Polygon> polygons);

  /// A length in metres is 2^exponent() times that in the mesh.
  int exponent() const { return exponent_; }

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  /// The vertices come first, with the same indices.
  const std::vector<MeshPoint>& points() const { return points_; }
  const std::vector<MeshFace>& faces() const { return faces_; }
  /// Those of faces come first, in the order of the polygons; creases follow.
  const std::vector<MeshEdge>& edges() const { return edges_; }
  std::size_t firstCrease() const { return first_crease_; }

  /// How `face` lies to the plane of `other`: on its positive side the points p with n.(q - p) > 0, q in the plane and
  /// n along the cross product of the edges of `other`'s plane triangle.
  PlaneSide sideOfPlane(std::size_t face, std::size_t other) const;

  /// Whether a point lies in the plane of a face, or on the line of an edge, because it was made there: what needs no
  /// arithmetic. A point may also lie there by chance.
  bool isKnownInPlane(std::size_t point, std::size_t face) const;
  bool isKnownOnLine(std::size_t point, std::size_t edge) const;

  /// The sign of n.(q - p) for the plane of a face and a point of the mesh, or for any position.
  int planeOffset(std::size_t face, std::size_t point) const;
  int planeOffset(std::size_t face, const Eigen::Vector3d& position) const;

 private:
  /// The points in which edges pass through planes, by the edge's vertices in increasing order and the face.
  using PiercedPoints = std::map<std::array<std::size_t, 3>, std::size_t>;

  void addPolygons(std::span<const Polygon> polygons);
  void addCreases(std::size_t a, std::size_t b, PiercedPoints& pierced_points);
  PlaneSide computeSideOfPlane(std::size_t face, std::size_t other) const;
  bool liesInPlane(const std::vector<std::size_t>& vertices, const std::array<std::size_t, 3>& plane) const;

  int exponent_ = 0;
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<MeshPoint> points_;
  std::vector<MeshFace> faces_;
  std::vector<MeshEdge> edges_;
  std::size_t first_crease_ = 0;
  std::vector<PlaneSide> sides_;  ///< of all pairs, empty where there are too many faces
};

}  // namespace irradiff
