#pragma once

#include "derivatives/scene/polygon.h"
#include "experiments/figures/convergence.h"
#include "experiments/figures/derivative_map.h"
#include "experiments/figures/estimate_errors.h"
#include "experiments/figures/tile_store.h"
#include "experiments/io/receiver_grid.h"

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

/// Where the error of an estimate comes from; all relative to max|truth|, in the max norm over the components.
struct SplitError {
  double total = 0.0;           ///< root mean square over the seeds of estimate - truth
  double rounding = 0.0;        ///< what changes when the same samples are turned by half a turn, exactly
  double discretisation = 0.0;  ///< estimate - truth with a sample in the middle of each stratum: without noise
  double noise = 0.0;           ///< standard deviation over the seeds
};

struct ErrorSplitPoint {
  std::size_t rays = 0;
  std::size_t compared = 0;  ///< receivers with a truth that is not 0 to within its error bound
  SplitError medians;        ///< over them, each by itself; rounding is NaN where it cannot be told (errorSplits())
};

struct ErrorSplitCurve {
  std::string estimator;
  Compared compared = Compared::kGradient;
  std::vector<ErrorSplitPoint> points;
};

/// Curves of the gradient and the tangential Hessian for all estimators of concentric samples that know them.
///
/// Half a turn about the normal takes the concentric strata to themselves and changes no digit of a direction, but
/// reverses the order of every sum: what it changes is rounding. It cannot be told of an estimator that casts rays of
/// its own. For threads, tiles and progress as convergenceCurves(). Requires at least 2 seeds in each step.
std::vector<ErrorSplitCurve> errorSplits(std::span<const Polygon> polygons, const ReceiverGrid& grid,
                                         const ConvergencePlan& plan, unsigned threads, const TileStore* finished,
                                         std::size_t first_tile,
                                         const std::function<void(std::size_t, std::size_t)>& progress = {});

/// How many tiles that takes.
std::size_t errorSplitTiles(const ConvergencePlan& plan);

/// Concentric samples turned by half a turn about the normal. Requires kConcentric.
HemisphereSamples halfTurned(const HemisphereSamples& samples);

}  // namespace irradiff
