#pragma once

#include "experiments/cache/record_field.h"
#include "experiments/figures/analytic_figure.h"
#include "experiments/figures/tile_store.h"
#include "experiments/io/receiver_grid.h"

#include <cstddef>
#include <cstdint>
#include <functional>

namespace irradiff {

struct PlaneFieldPlan {
  std::size_t resolution = 256;  ///< receivers along the longer side
  std::size_t rays = 0;          ///< for each record; 0: exact derivatives
  std::uint64_t seed = 1;
  unsigned threads = 1;  ///< nothing depends on it
};

/// Direct irradiance on the plane of a scene's grid, as in Figure 5 of [Schwarzhaupt et al. 2012].
RecordField planeField(const FigureScene& scene, const PlaneFieldPlan& plan, const TileStore* finished,
                       const std::function<void(std::size_t, std::size_t)>& progress = {});

}  // namespace irradiff
