#pragma once

#include "derivatives/scene/polygon.h"
#include "experiments/figures/point_estimator.h"
#include "experiments/figures/tile_store.h"
#include "experiments/io/receiver_grid.h"

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

/// What one estimator says of the receivers of a grid, row-major, row 0 at the grid's origin; x along u, y along v, z
/// along the normal.
struct EstimateMap {
  std::string estimator;
  std::vector<EstimateValues> values;

  std::vector<double> channel(EstimateValue value) const;
};

/// The frame of a grid's receiver for its samples: t along u, b along v.
SampleFrame sampleFrame(const ReceiverGrid& grid, std::size_t i, std::size_t j);

/// Maps of several estimators from the same rays, in the order of their names. The rays of receiver (i, j) depend on
/// the plan and the receiver's number j * width + i alone, and so nothing depends on the number of threads, of which up
/// to `threads` work on rows. Rows that `finished` holds, if it is not null, are taken from there, others are put there
/// when they are done: row j is its tile first_tile + j. `progress(done, all)` counts rows; it may be empty, and is
/// never called twice at a time.
///
/// Requires validated polygons and a grid that validateFrame accepts. Throws as pointEstimator and what estimators
/// throw.
std::vector<EstimateMap> estimateMaps(std::span<const Polygon> polygons, const ReceiverGrid& grid,
                                      const SamplingPlan& plan, std::span<const std::string> estimators,
                                      unsigned threads, const TileStore* finished, std::size_t first_tile,
                                      const std::function<void(std::size_t, std::size_t)>& progress = {});

}  // namespace irradiff
