#pragma once

#include "derivatives/visibility/scene_mesh.h"
#include "derivatives/visibility/view_predicates.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

/// A mesh as one receiver sees it: which of its polygons count, how bright they are, and the signs that everything
/// about the view asks for again and again.
class SceneInView {
 public:
  /// `is_present` tells the polygons that count. Keeps references to all four.
  SceneInView(const SceneMesh& mesh, std::span<const Polygon> polygons, const std::vector<bool>& is_present,
              const ViewPredicates& predicates);

  const SceneMesh& mesh() const { return mesh_; }
  const ViewPredicates& predicates() const { return predicates_; }
  const MeshEdge& edge(std::size_t edge) const { return mesh_.edges()[edge]; }
  const MeshFace& face(std::size_t face) const { return mesh_.faces()[face]; }

  bool isPresentFace(std::size_t face) const { return is_present_[mesh_.faces()[face].polygon]; }
  /// Whether an edge bounds a face that counts; of a crease, whether both faces count.
  bool isPresentEdge(std::size_t edge) const;

  /// The polygon of a face; kNone, the background, of kNone.
  std::size_t polygonOf(std::size_t face) const { return face == kNone ? kNone : mesh_.faces()[face].polygon; }
  /// The radiance of a face; 0, that of the background, of kNone. Unit: W/(m^2 sr).
  double radianceOf(std::size_t face) const { return face == kNone ? 0.0 : polygons_[polygonOf(face)].radiance; }

  /// The first of the polygons whose edges end in a point, in the order of the scene.
  std::size_t firstPolygonAt(std::size_t point) const { return first_polygons_[point]; }

  /// ViewPredicates::height, of a point.
  int height(std::size_t point) const { return heights_[point]; }
  /// ViewPredicates::receiverOffset, of a face that counts.
  int receiverOffset(std::size_t face) const { return receiver_offsets_[face]; }

  /// As messages name the polygon of a face, and an edge.
  std::string describeFace(std::size_t face) const;
  std::string describeEdge(std::size_t edge) const;

 private:
  const SceneMesh& mesh_;
  std::span<const Polygon> polygons_;
  const std::vector<bool>& is_present_;
  const ViewPredicates& predicates_;
  std::vector<std::size_t> first_polygons_;  ///< of each point
  std::vector<int> heights_;                 ///< of each point
  std::vector<int> receiver_offsets_;        ///< of each face
};

}  // namespace irradiff
