#pragma once

#include "experiments/cache/record_field.h"
#include "experiments/cache_2d/flatland_room.h"

#include <cstddef>
#include <functional>

namespace irradiff {

struct FlatlandFieldPlan {
  std::size_t receivers = 4096;  ///< along all walls, equally spaced
  unsigned threads = 1;          ///< nothing depends on it
};

/// Irradiance along all walls of a flatland room: direct, and one bounce by quadrature to 1e-10. Derivatives are exact,
/// and the truth is where records are made. Metrics: the published five, `oracle` and `reprojection`.
RecordField flatlandField(const FlatlandRoom& room, const FlatlandFieldPlan& plan,
                          const std::function<void(std::size_t, std::size_t)>& progress = {});

}  // namespace irradiff
