#pragma once

#include "derivatives/boundary/irradiance.h"
#include "derivatives/estimators/jump_chain.h"
#include "derivatives/estimators/radiance_jump.h"

#include <span>
#include <vector>

namespace irradiff {

/// A boundary as it was traced: its straight runs in order, and the jumps at which it begins and ends.
struct TracedChain {
  std::vector<StraightRun> runs;
  std::size_t first = 0, last = 0;
  bool is_closed = false;
};

// Irradiance and its derivatives from traced boundaries, in the frame (t, b, n): the sums of
// derivatives/boundary/boundary_sums.h over one arc for each run, between the places where its line crosses in view
// those of the neighbouring runs, a junction's most transversal other line, or the horizon; with the terms of those
// places as apparent vertices, which vanish where the lines meet. Where no crossing is found, the boundary goes
// straight from one jump to the next. docs/derivations/discontinuity_estimator.md.
//
// Only jumps of the graph count: regions have one radiance each.
IrradianceDerivatives<double> tracedDerivatives(const JumpGraph& graph, std::span<const TracedChain> chains);

}  // namespace irradiff
