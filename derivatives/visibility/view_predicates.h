#pragma once

#include "derivatives/visibility/lifted_vector.h"
#include "derivatives/visibility/scene_mesh.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace irradiff {

/// A place on an edge as the receiver sees it: an end, or where something crosses it.
struct EdgePlace {
  enum class Kind : std::uint8_t {
    kStart,
    kEnd,
    kEdge,     ///< where the edge `id` crosses it in view
    kPoint,    ///< where the point `id` lies on it in view
    kInLine,   ///< where the edge `id`, in the same plane of view, passes through it in space
    kHorizon,  ///< where it crosses the receiver's horizon
  };
  Kind kind;
  std::size_t id = kNone;

  bool operator==(const EdgePlace&) const = default;
};

/// The direction of a place on an edge: start times the ray to the edge's start plus end times that to its end. Both
/// are >= 0 between the ends.
template <class Number>
struct PlaceWeights {
  Number start;
  Number end;
};

/// What a receiver sees of a mesh, as signs that are right however degenerate the scene: a filter with error bounds
/// first, exact numbers where it cannot tell.
///
/// The ray to a point is any positive multiple of its position relative to the receiver. The plane of view of an edge
/// has the normal ray(start) x ray(end); positive is the right of the edge, seen along it (docs/derivations/
/// radiance_boundary.md, section 1). Not to be shared between threads: exact rays are kept.
class ViewPredicates {
 public:
  /// Position in the mesh's units. Keeps a reference to the mesh.
  ViewPredicates(const SceneMesh& mesh, const Eigen::Vector3d& position, const Eigen::Vector3d& normal);

  const SceneMesh& mesh() const { return mesh_; }
  const Eigen::Vector3d& position() const { return position_; }

  /// Which side of the plane of view of `edge` a point is on: 1 right, -1 left, 0 in it.
  int side(std::size_t edge, std::size_t point) const;

  /// Whether the edge's line passes through the receiver: it has no plane of view.
  bool isRadial(std::size_t edge) const;

  /// 1 above the receiver's horizon, -1 below, 0 on it.
  int height(std::size_t point) const;

  /// On which side of the plane of a face the receiver is, as SceneMesh::planeOffset.
  int receiverOffset(std::size_t face) const;

  /// Whether the ray to the point runs towards the plane of a face, and not away from it or along it.
  bool runsTowards(std::size_t point, std::size_t face) const;

  /// The weights of a place on an edge; up to a positive factor.
  template <class Number>
  PlaceWeights<Number> weights(std::size_t edge, const EdgePlace& place) const;

  /// Signs of the weights of a place: both positive between the edge's ends.
  PlaceWeights<int> weightSigns(std::size_t edge, const EdgePlace& place) const;

  /// Negative where place a comes before place b on the edge, 0 where they are one direction. Requires weights >= 0.
  int compare(std::size_t edge, const EdgePlace& a, const EdgePlace& b) const;

  /// Which is nearer in the direction of a place on `edge`: 1 the edge, -1 the plane of the face, 0 neither.
  /// Requires that the direction runs towards the face's plane.
  int compareDepth(std::size_t edge, const EdgePlace& place, std::size_t face) const;

  /// The same for the planes of two faces: 1 if the first is nearer.
  int compareFaces(std::size_t edge, const EdgePlace& place, std::size_t first, std::size_t second) const;

  /// The same as compareFaces just to the right of the edge, for planes that meet in its plane of view.
  int compareFacesRight(std::size_t edge, std::size_t first, std::size_t second) const;

  /// Which of two edges that cross in view is nearer where they cross: 1 the first, -1 the second, 0 neither: they
  /// meet.
  int compareCrossing(std::size_t first, std::size_t second) const;

  /// Which is nearer, a point or an edge that it lies on in view: 1 the point, -1 the edge, 0 neither.
  int comparePoint(std::size_t point, std::size_t edge) const;

  /// Which is nearer of two points in the same direction.
  int comparePoints(std::size_t first, std::size_t second) const;

  /// For two edges in one plane of view: whether `other` covers the piece of `edge` between two places, of which none
  /// of its ends is within, and which is nearer there (1 `edge`, -1 `other`, 0: on one line).
  bool covers(std::size_t other, std::size_t edge, const EdgePlace& first, const EdgePlace& last) const;
  int compareInLine(std::size_t edge, std::size_t other, const EdgePlace& first, const EdgePlace& last) const;

  /// Whether two edges in one plane of view change their order in depth between the ends of the first, on its line.
  bool passThroughInLine(std::size_t edge, std::size_t other) const;

  /// Whether two edges are pieces of one straight line of the scene.
  bool shareLine(std::size_t edge, std::size_t other) const;

  /// The direction of a place on an edge, a positive multiple of it.
  template <class Number>
  Vector3<Number> direction(std::size_t edge, const EdgePlace& place) const;
  const Eigen::Vector3d& normal() const { return normal_; }
  template <class Number>
  Vector3<Number> normal() const {
    return lifted<Number>(normal_);
  }

  template <class Number>
  Vector3<Number> ray(std::size_t point) const;

 private:
  template <class Number>
  Number weight(std::size_t point) const;
  /// For edges in one plane of view: by how much the inverse distance of `edge` exceeds that of the line of `other` in
  /// the direction c, in which the former is `inverse_distance`; up to the sign of inLineOrientation.
  template <class Number>
  Number inLineExcess(std::size_t edge, std::size_t other, const Vector3<Number>& c,
                      const Number& inverse_distance) const;
  /// Whether the point of the edge at a place is in the plane of a face because it was made there.
  bool isKnownInPlane(std::size_t edge, const EdgePlace& place, std::size_t face) const;
  int inLineOrientation(std::size_t edge, std::size_t other) const;
  template <class Number>
  Vector3<Number> planeOfView(std::size_t edge) const;
  template <class Number>
  Vector3<Number> faceNormal(std::size_t face) const;
  /// faceNormal . (a point of the plane - receiver): the inverse distance of the plane in direction c is
  /// faceNormal.c / faceDistance.
  template <class Number>
  Number faceDistance(std::size_t face) const;

  const SceneMesh& mesh_;
  Eigen::Vector3d position_;
  Eigen::Vector3d normal_;
  std::vector<Vector3<BoundedNumber>> bounded_rays_;
  std::vector<Vector3<BoundedNumber>> bounded_planes_;
  mutable std::unordered_map<std::size_t, Vector3<ExactNumber>> exact_rays_;
};

}  // namespace irradiff
