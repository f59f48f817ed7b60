#pragma once

#include "derivatives/estimators/jump_lattice.h"
#include "derivatives/estimators/radiance_jump.h"
#include "derivatives/estimators/traced_boundary.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace irradiff {

/// Looks whether boundaries have the corners that their lines make: where a short edge cuts one off, the Hessian is
/// another by the terms of its apparent vertices, however short it is.
class CornerProbe {
 public:
  /// Casts a ray beside each corner between runs, inside the angle that they make, that was not looked at before. Where
  /// it sees the region on the other side, finds one jump on what cuts the corner off beside each of the two lines, and
  /// puts both into the chain. Whether there were any; `traced` are then out of date.
  bool findCuts(JumpGraph& graph, std::vector<JumpChain>& chains, std::span<const TracedChain> traced, RayBudget& rays);

 private:
  std::vector<std::pair<std::size_t, std::size_t>> seen_;  ///< the jumps beside corners that were looked at
};

}  // namespace irradiff
