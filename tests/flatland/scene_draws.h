#pragma once

#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"
#include "verification/checks/random.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

struct FlatlandScene {
  std::vector<Segment> segments;
  FlatlandReceiver receiver;
};

/// A family of seeded random scenes of 2 to 12 segments unless it says otherwise; the receiver is on none of them.
struct SceneFamily {
  const char* name;
  FlatlandScene (*draw)(KeyedRandom&);
};

/// Random coordinates: scattered segments, many of which cross; chains of shared ends around obstacles in a room.
std::span<const SceneFamily> smoothFamilies();

/// Nearly degenerate: ends almost in line, receivers 1e-12 from a segment, segments that cross at flat angles, slivers,
/// ends just off the horizon, far and near ones together.
std::span<const SceneFamily> harshFamilies();

/// 40 segments, as scattered as those of a few.
FlatlandScene drawCrowd(KeyedRandom& random);

/// Small integer coordinates and four radiances no two of which add up to another two: full of ends in line, shared
/// ends, T-junctions, crossings in line with ends, end-on segments, ends on the horizon and overlaps on one line.
FlatlandScene drawGrid(KeyedRandom& random);

/// The scene as a line of a scene file, for messages.
std::string sceneLine(const FlatlandScene& scene);

/// Whether the receiver is on some segment, by exact arithmetic.
bool isOnASegment(const FlatlandScene& scene);

}  // namespace irradiff
