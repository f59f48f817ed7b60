#pragma once

#include "experiments/cache/record_field.h"
#include "experiments/cache_2d/flatland_room.h"

#include <cstddef>
#include <functional>
#include <string_view>

namespace irradiff {

/// What a flatland field holds. Section 4 of [Schwarzhaupt et al. 2012] caches indirect light alone.
enum class FlatlandLight {
  kIndirect,  ///< what walls reflect of the direct light, once
  kTotal      ///< that and the direct light
};

/// By the names "indirect" and "total". Throws std::invalid_argument naming what was given and the names that there
/// are.
FlatlandLight flatlandLightOf(std::string_view name);

struct FlatlandFieldPlan {
  std::size_t receivers = 4096;  ///< along all walls, equally spaced: as many to within one for each side of a wall
  FlatlandLight light = FlatlandLight::kIndirect;
  unsigned threads = 1;  ///< nothing depends on it
};

/// Irradiance along all walls that reflect: of one bounce by quadrature to 1e-10, or that and direct light. Derivatives
/// are exact, and the truth is where records are made. Receivers are at the middles of cells of equal length on both
/// sides of each segment that reflects, from its first vertex to the second and back on the other side; a side on which
/// no light arrives anywhere, such as the outside of a wall, has none, and neither has a cell whose middle is on
/// another segment. A face is a side; the first axis runs along the tangent.
///
/// Metrics: the published five, from exact derivatives with and without occlusion; `reprojection`, whose error is
/// predicted from what the record sees (FlatlandReprojection); `oracle`, whose error is the true one at all receivers
/// on the record's line. Of these two R is the half-length at which the error, summed over the interval as Eq. (4) of
/// [Schwarzhaupt et al. 2012] (or its mean over it), first exceeds the threshold. docs/derivations/flatland_bounce.md,
/// sections 6 and 7.
///
/// Throws std::invalid_argument naming it if no receiver is asked for or there are more than kMaxReceivers, and
/// InvalidScene if no light arrives on any wall, or as visibleParts() does.
RecordField flatlandField(const FlatlandRoom& room, const FlatlandFieldPlan& plan,
                          const std::function<void(std::size_t, std::size_t)>& progress = {});

}  // namespace irradiff
