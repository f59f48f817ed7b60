#pragma once

#include "derivatives/estimators/radiance_jump.h"
#include "derivatives/samples/ray_query.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace irradiff {

/// Rays of which there are no more than a budget.
class RayBudget {
 public:
  RayBudget(const RayQuery& query, std::size_t budget) : query_(query), budget_(budget) {}

  std::size_t used() const { return used_; }
  std::size_t left() const { return budget_ - used_; }
  std::size_t all() const { return budget_; }
  /// Requires left() > 0. Throws std::invalid_argument naming the direction and the value if an inverse distance or a
  /// radiance is not finite or below 0.
  SeenPoint cast(const Eigen::Vector3d& direction);

 private:
  const RayQuery& query_;
  std::size_t budget_;
  std::size_t used_ = 0;
};

/// What a lattice of rays over the hemisphere tells: where radiance jumps between them, and the smooth rest.
struct LatticeView {
  JumpGraph graph;
  /// The nodes of the first lattice, row by row.
  std::size_t nodes_along_side = 0;
  std::vector<SeenPoint> nodes;
  std::vector<double> smooth_radiance;         ///< of the nodes, less that of their regions; W/(m^2 sr)
  std::vector<double> projected_solid_angles;  ///< of the nodes' surroundings
};

// Casts rays in a lattice of nodes_along_side^2 nodes, equally spaced in the concentric map of Shirley and Chiu 1997
// turned counterclockwise by `rotation` radians, and closes in on the cells in whose corners radiance differs: they are
// parted in four while what is left of the budget suffices to narrow the jumps down afterwards. A cell beside a finer
// one is parted as well where the finer shows a jump on their common side, so that boundaries have no gaps. Cells in
// which regions meet are parted further.
// Where radiance varies everywhere the lattice is not refined.
// Requires nodes_along_side >= 2 and a budget of its square at least.
LatticeView viewThroughLattice(RayBudget& rays, std::size_t nodes_along_side, double rotation);

}  // namespace irradiff
