#pragma once

#include "experiments/figures/analytic_figure.h"
#include "experiments/figures/convergence.h"
#include "experiments/pareto/polygon_trade.h"
#include "experiments/pareto/spread.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

struct EstimatorPlan {
  std::vector<std::size_t> rays;    ///< at a receiver, at most: shapeForRays()
  std::size_t receivers = 0;        ///< of spreadReceivers() that errors are taken over
  std::size_t timed_receivers = 0;  ///< the first so many of them are timed
  std::size_t rounds = 0;
  std::uint64_t seed = 1;
};

/// An estimator with a number of rays: what it knows, how wrong, and what it takes.
struct EstimatorTrade {
  EstimatorChoice estimator;
  Compared compared = Compared::kGradient;
  std::size_t rays = 0;       ///< that it had
  std::size_t receivers = 0;  ///< with a truth that is not 0 to within its error bound
  ErrorStatistics errors;     ///< relative, over these receivers
  Spread microseconds;        ///< for a receiver: directions, rays and estimate
  Spread estimate_share;      ///< of that time the estimator's own; 1 for one that casts its own rays
  bool on_front = false;      ///< of time and median error among those of the same quantity
};

/// All estimators of allEstimators() on the scene, with each number of rays; gradients along the plane and tangential
/// Hessians. Errors do not depend on times. Times on this thread, estimators taking turns.
std::vector<EstimatorTrade> estimatorTrades(const FigureScene& scene, const EstimatorPlan& plan);

}  // namespace irradiff
