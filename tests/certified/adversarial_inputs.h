#pragma once

#include "verification/checks/configuration.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace irradiff {

/// A polygon and a receiver that are meant to hurt: one of the input families in turn, and then one of several blows
/// that keep the polygon planar to the last bit: axes stretched by powers of two, the receiver moved into the line of
/// an edge, into the height of a vertex or almost onto an edge, the normal laid along an axis, across an edge or into
/// the polygon's plane. Depends on seed and index alone. Nothing where the blow leaves no valid input.
std::optional<Configuration> adversarialInput(std::uint64_t seed, std::size_t index);

}  // namespace irradiff
