#pragma once

#include "derivatives/visibility/scene_mesh.h"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace irradiff {

/// A rectangle in the disk of directions above the horizon, seen from above: (w.t, w.b) for a direction w and tangents
/// t, b of the receiver's plane.
struct ViewBox {
  Eigen::Array2d lower = Eigen::Array2d::Constant(1.0);
  Eigen::Array2d upper = Eigen::Array2d::Constant(-1.0);

  bool overlaps(const ViewBox& other) const { return (lower <= other.upper).all() && (other.lower <= upper).all(); }
};

/// Cells along each side of the grid that suits a mesh of so many faces: one for few, for which a finer grid costs more
/// than it saves, else as many cells as faces. `./run bench` measures where one begins to be worth more than the other.
int viewGridResolution(std::size_t faces);

/// Which faces and creases of a mesh may meet which edges in view: rectangles about them in a grid, so that a pair far
/// apart costs nothing. What is far apart is left out; what is kept is not sure to meet.
class ViewGrid {
 public:
  /// Position in the mesh's units; `resolution`, at least 1, is the number of cells along each side. What is collected
  /// does not depend on it.
  ViewGrid(const SceneMesh& mesh, const Eigen::Vector3d& position, const Eigen::Vector3d& normal, int resolution);

  /// The rectangle about an edge of the mesh.
  ViewBox boxOfEdge(std::size_t edge) const;

  /// Adds what may meet the edge, each once and in increasing order. Not to be called by two threads at once.
  void collect(std::size_t edge, std::vector<std::size_t>& faces, std::vector<std::size_t>& creases) const;

  /// Puts a face or a crease into the grid.
  void insertFace(std::size_t face);
  void insertCrease(std::size_t crease);

 private:
  struct Item {
    std::size_t index;
    bool is_crease;
    ViewBox box;
  };
  struct Direction {
    Eigen::Vector3d unit;
    bool is_above;
  };

  void insert(const Item& item);
  ViewBox boxOfFace(std::size_t face) const;
  void includeArc(ViewBox& box, const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;
  void includeCap(ViewBox& box, const Eigen::Vector3d& center, double radius) const;
  /// The cells that a rectangle overlaps, first and last along both axes.
  Eigen::Array4i cells(const ViewBox& box) const;

  const SceneMesh& mesh_;
  Eigen::Matrix<double, 3, 2> frame_;
  std::vector<Direction> directions_;  ///< of each point
  int resolution_;
  std::vector<Item> items_;
  std::vector<std::vector<std::size_t>> cells_;
  mutable std::vector<std::size_t> stamps_;  ///< of items, the last query that met them
  mutable std::size_t query_ = 0;
};

}  // namespace irradiff
