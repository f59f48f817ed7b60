#pragma once

#include "experiments/figures/analytic_figure.h"
#include "experiments/figures/convergence.h"
#include "experiments/figures/estimate_errors.h"
#include "experiments/figures/quality_figure.h"
#include "verification/report/result_table.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

/// What estimators are compared with.
struct ComparisonPlan {
  std::size_t rays = 4096;         ///< at a receiver, at most: shapeForRays()
  std::size_t resolution = 36;     ///< receivers along the longer side of a scene's grid
  std::size_t room_receivers = 6;  ///< likewise, where radiance is constant
  std::uint64_t seed = 1;
};

/// Errors of one estimator in one scene; without a value for what it does not know.
struct EstimatorErrors {
  EstimatorChoice estimator;
  std::size_t rays = 0;  ///< that it had
  std::optional<ErrorSummary> gradient;
  std::optional<ErrorSummary> hessian;
};

/// What an estimator makes of radiance 1 from everywhere, where the derivatives are 0.
struct ConstantRadianceLeak {
  EstimatorChoice estimator;
  bool claims_zero = false;        ///< its header says that it gives 0
  std::optional<double> gradient;  ///< the largest component in the tangent plane at any receiver, W/m^3
  std::optional<double> hessian;   ///< likewise of the tangential Hessian, W/m^4
};

/// All estimators side by side, those with one stratification from the same rays.
struct EstimatorComparison {
  struct InScene {
    FigureScene scene;
    ReceiverGrid grid;
    std::vector<EstimatorErrors> errors;  ///< in the order of allEstimators()
    /// The share of the receivers with a Hessian in space at which the gap-filled scene, which meshes over samples tend
    /// to, loses more than a tenth of it, max|dH|/max|H|. Without a value where it exists at none.
    std::optional<double> gap_share;
  };

  ComparisonPlan plan;
  std::vector<InScene> scenes;
  std::vector<ConstantRadianceLeak> leaks;  ///< likewise
};

/// `room` is a closed room of radiance 1 seen from inside once its black polygons are gone, with a grid. As
/// estimateMaps for threads, errors and progress.
EstimatorComparison compareEstimators(std::vector<FigureScene> scenes, const FigureScene& room,
                                      const ComparisonPlan& plan, unsigned threads,
                                      const QualityProgress& progress = {});

/// What a leak may be and still be rounding: one rounding of E = pi for each ray, distances being about 1 m.
double leakOfRounding(const ComparisonPlan& plan);

/// Whether an estimator's derivatives of constant radiance are 0 to rounding, those that it knows.
bool isClosed(const ConstantRadianceLeak& leak, const ComparisonPlan& plan);

/// A row for each scene, quantity and estimator, with what constant radiance gives and the order from the curves (null
/// without).
ResultTable comparisonTable(const EstimatorComparison& comparison, std::span<const QualityFigure::Curves> curves);

/// That of the scene, estimator and quantity; null if there is none.
const ConvergenceCurve* findCurve(std::span<const QualityFigure::Curves> curves, const std::string& scene,
                                  const EstimatorChoice& estimator, Compared compared);

}  // namespace irradiff
