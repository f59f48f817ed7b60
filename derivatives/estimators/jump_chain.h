#pragma once

#include "derivatives/estimators/radiance_jump.h"
#include "derivatives/estimators/seen_line.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace irradiff {

/// Jumps in their order along one boundary. A closed chain goes on from the last to the first.
struct JumpChain {
  std::vector<std::size_t> jumps;
  bool is_closed = false;
};

/// All jumps of the graph, each in one chain; between two of them the boundary passes no junction.
std::vector<JumpChain> jumpChains(const JumpGraph& graph);

/// Successive jumps of a chain that are on one straight edge.
struct StraightRun {
  std::vector<std::size_t> jumps;
  std::optional<SeenLine> line;  ///< none for a single jump
};

/// The end of a run that has a line: of its first jump or of its last.
LineEnd firstEnd(const StraightRun& run, std::span<const RadianceJump> jumps);
LineEnd lastEnd(const StraightRun& run, std::span<const RadianceJump> jumps);

/// Parts a chain into straight runs, as few as its jumps allow; those of a closed chain are in cyclic order. A single
/// jump between two runs whose lines cross next to it is left out: it is on a corner that is cut off by less than a
/// jump can tell. So is one at an end of an open chain that the run before it misses: near a junction a jump may be on
/// another boundary.
std::vector<StraightRun> straightRuns(const JumpChain& chain, std::span<const RadianceJump> jumps);

}  // namespace irradiff
