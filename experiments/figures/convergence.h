#pragma once

#include "derivatives/scene/polygon.h"
#include "experiments/figures/derivative_map.h"
#include "experiments/figures/estimate_errors.h"
#include "experiments/figures/point_estimator.h"
#include "experiments/figures/tile_store.h"
#include "experiments/io/receiver_grid.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

/// Receivers spread evenly over a grid's parallelogram, whatever its resolution: multiples of the powers of
/// 1/1.3247..., the root of x^3 = x + 1, modulo 1 (M. Roberts, "The unreasonable effectiveness of quasirandom
/// sequences", 2018).
std::vector<Receiver> spreadReceivers(const ReceiverGrid& grid, std::size_t count);

/// The largest shape of a stratification with at most so many strata: concentric N x N; polar M x K, K being about
/// pi M (Ward and Heckbert 1992); hemicube (3 n, n). Requires rays of at least 12 for a hemicube, or else 1.
GridShape shapeForRays(Stratification stratification, std::size_t rays);

/// An estimator with the stratification of its samples.
struct EstimatorChoice {
  std::string name;
  Stratification stratification = Stratification::kConcentric;

  /// "ward-heckbert", "ward-heckbert (polar)": the stratification where it is not the concentric one.
  std::string label() const;
};

/// All that exist: those for concentric samples, the gradient of Ward and Heckbert as published, from polar ones, and
/// those that need a hemicube.
std::vector<EstimatorChoice> allEstimators();

/// One number of rays of a study of convergence.
struct ConvergenceStep {
  std::size_t rays = 0;       ///< at a receiver, at most
  std::size_t receivers = 0;  ///< the first so many of spreadReceivers()
  std::size_t seeds = 0;      ///< from the plan's first one on
};

struct ConvergencePlan {
  std::vector<ConvergenceStep> steps;
  std::uint64_t first_seed = 1;
};

/// Of one estimator at one number of rays: the median relative error over the receivers (relativeErrors()), for each
/// seed, sorted.
struct ConvergencePoint {
  std::size_t rays = 0;  ///< that it had
  std::size_t receivers = 0;
  std::size_t compared = 0;  ///< those with a truth that is not 0 to within its error bound
  std::vector<double> medians;

  double median() const { return percentile(medians, 0.5); }
  double low() const { return percentile(medians, 0.05); }
  double high() const { return percentile(medians, 0.95); }
};

/// The order p of an error that falls like 1/N^p with N^2 rays, fitted by least squares in logarithms to the
/// medians of each seed that all steps have.
struct ConvergenceOrder {
  double median = 0.0;  ///< over the seeds
  double low = 0.0;     ///< 5 % of the seeds are below
  double high = 0.0;    ///< 5 % are above
};

struct ConvergenceCurve {
  EstimatorChoice estimator;
  Compared compared = Compared::kGradient;
  std::vector<ConvergencePoint> points;
  ConvergenceOrder order;  ///< from kFirstRaysOfOrder rays on; NaN where fewer than two points have so many
};
inline constexpr std::size_t kFirstRaysOfOrder = 256;

/// Curves of the gradient and the tangential Hessian for all estimators that know them, in their order. Estimators with
/// one stratification share their rays. As estimateMaps for threads, finished tiles and progress, which counts batches.
std::vector<ConvergenceCurve> convergenceCurves(std::span<const Polygon> polygons, const ReceiverGrid& grid,
                                                const ConvergencePlan& plan, unsigned threads,
                                                const TileStore* finished, std::size_t first_tile,
                                                const std::function<void(std::size_t, std::size_t)>& progress = {});

/// How many tiles that takes.
std::size_t convergenceTiles(const ConvergencePlan& plan);

}  // namespace irradiff
