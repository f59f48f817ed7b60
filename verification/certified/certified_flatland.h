#pragma once

#include "derivatives/scene/segment.h"
#include "verification/certified/certified_scene.h"

#include <span>

namespace irradiff {

/// The flatland counterpart of certifyScene: who is seen is decided without rounding, and each part that is seen is a
/// source of its own. Throws as evaluateScene does, and std::invalid_argument for a tolerance outside
/// [kSmallestTolerance, 1].
CertifiedScene<2> certifyScene(std::span<const Segment> segments, const FlatlandReceiver& receiver, double tolerance);

}  // namespace irradiff
