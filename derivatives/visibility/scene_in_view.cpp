#include "derivatives/visibility/scene_in_view.h"

#include <algorithm>

namespace irradiff {

SceneInView::SceneInView(const SceneMesh& mesh, std::span<const Polygon> polygons, const std::vector<bool>& is_present,
                         const ViewPredicates& predicates)
    : mesh_(mesh), polygons_(polygons), is_present_(is_present), predicates_(predicates) {
  first_polygons_.assign(mesh_.points().size(), kNone);
  for (const MeshEdge& edge : mesh_.edges()) {
    for (const std::size_t p : {edge.start, edge.end}) {
      first_polygons_[p] = std::min(first_polygons_[p], polygonOf(edge.faces.front()));
    }
  }
  heights_.reserve(mesh_.points().size());
  for (std::size_t p = 0; p < mesh_.points().size(); ++p) heights_.push_back(predicates_.height(p));
  receiver_offsets_.reserve(mesh_.faces().size());
  for (std::size_t f = 0; f < mesh_.faces().size(); ++f) {
    receiver_offsets_.push_back(isPresentFace(f) ? predicates_.receiverOffset(f) : 0);
  }
}

bool SceneInView::isPresentEdge(std::size_t edge) const {
  const MeshEdge& e = mesh_.edges()[edge];
  const auto isPresent = [&](std::size_t face) { return isPresentFace(face); };
  return e.is_crease ? std::ranges::all_of(e.faces, isPresent) : std::ranges::any_of(e.faces, isPresent);
}

std::string SceneInView::describeFace(std::size_t face) const {
  const std::size_t polygon = polygonOf(face);
  return "polygons[" + std::to_string(polygon) + "] \"" + polygons_[polygon].name + '"';
}

std::string SceneInView::describeEdge(std::size_t edge) const {
  const MeshEdge& e = mesh_.edges()[edge];
  if (e.is_crease) {
    return "the line in which " + describeFace(e.faces.front()) + " and " + describeFace(e.faces.back()) +
           " pass through each other";
  }
  return "an edge of " + describeFace(e.faces.front());
}

}  // namespace irradiff
