#pragma once

#include "experiments/cache/record_field.h"
#include "experiments/figures/analytic_figure.h"
#include "experiments/figures/tile_store.h"
#include "experiments/io/receiver_grid.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace irradiff {

struct PlaneFieldPlan {
  std::size_t resolution = 256;  ///< receivers along the longer side
  std::size_t rays = 0;          ///< for each record, at most; 0: exact derivatives
  std::uint64_t seed = 1;
  unsigned threads = 1;  ///< nothing depends on it
};

/// Error profiles of the field have so many directions and distances, from one pixel to the grid's diagonal.
inline constexpr std::size_t kPlaneProfileDirections = 16;
inline constexpr std::size_t kPlaneProfileDistances = 24;

/// What the numbers of a field's tiles depend on, for the TileStore.
std::string planeFieldFingerprint(const FigureScene& scene, const PlaneFieldPlan& plan);

// Direct irradiance on the plane of a scene's grid, as in Figure 5 of [Schwarzhaupt et al. 2012]. The image is upright:
// its first row is the grid's last. The reference is exact. Metrics: recordMetrics(), with "second-order" where records
// are exact.
//
// Without rays records are exact (ExactKnowledge), and `reprojection` predicts by the polygons of which the record sees
// some part, those behind others left out. With rays all that a record knows is from its samples (SampledKnowledge).
//
// Rows are taken from `finished` if it is not null, by a fingerprint that holds planeFieldFingerprint. `progress(done,
// all)` counts rows. Throws InvalidScene as ExactKnowledge, and std::invalid_argument naming the scene or the plan if
// the grid has no light at all, or fewer than 2 receivers along a side, or rays are 1 to 3.
RecordField planeField(const FigureScene& scene, const PlaneFieldPlan& plan, const TileStore* finished,
                       const std::function<void(std::size_t, std::size_t)>& progress = {});

}  // namespace irradiff
