#include "experiments/figures/estimator_comparison.h"

#include "experiments/figures/estimate_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>
#include <utility>

namespace irradiff {
namespace {

constexpr std::array kStratifications{Stratification::kConcentric, Stratification::kPolar, Stratification::kHemicube};
/// Those whose headers claim it (ward_heckbert.h, triangulated.h, docs/derivations/sample_estimators.md).
constexpr std::array<std::string_view, 3> kClaimZero{"ward-heckbert", "triangulated-closed", "discontinuity"};

/// What one estimator says of a grid's receivers.
struct ChosenMap {
  EstimatorChoice estimator;
  std::size_t rays;
  EstimateMap map;
};

/// In the order of allEstimators().
std::vector<ChosenMap> mapsOf(const std::vector<Polygon>& polygons, const ReceiverGrid& grid,
                              const ComparisonPlan& plan, unsigned threads,
                              const std::function<void(std::size_t, std::size_t)>& progress) {
  const std::vector<EstimatorChoice> choices = allEstimators();
  std::vector<ChosenMap> maps;
  for (std::size_t k = 0; k < kStratifications.size(); ++k) {
    const Stratification stratification = kStratifications[k];
    const SamplingPlan sampling{stratification, shapeForRays(stratification, plan.rays), SamplePattern::kJittered,
                                plan.seed};
    std::vector<std::string> names;
    for (const EstimatorChoice& choice : choices) {
      if (choice.stratification == stratification) names.push_back(choice.name);
    }
    const auto rows = [&](std::size_t done, std::size_t all) {
      if (progress) progress(k * all + done, kStratifications.size() * all);
    };
    for (EstimateMap& map : estimateMaps(polygons, grid, sampling, names, threads, nullptr, 0, rows)) {
      EstimatorChoice choice{map.estimator, stratification};
      maps.push_back({std::move(choice), sampling.shape.size(), std::move(map)});
    }
  }
  std::ranges::stable_sort(maps, {}, [&](const ChosenMap& map) {
    return std::ranges::find(choices, map.estimator.label(), &EstimatorChoice::label) - choices.begin();
  });
  return maps;
}

std::optional<ErrorSummary> errorsOf(const EstimateMap& map, const DerivativeMap& truth, Compared compared) {
  return knows(map, compared) ? std::optional(summarise(map, truth, compared)) : std::nullopt;
}

std::optional<double> largestOf(const EstimateMap& map, Compared compared) {
  if (!knows(map, compared)) return std::nullopt;
  double largest = 0.0;
  for (const EstimateValues& at : map.values) {
    for (const EstimateValue value : quantityOf(compared).values) {
      // std::max would lose a NaN.
      if (!(std::abs(at[value]) <= largest)) largest = std::abs(at[value]);
      if (std::isnan(largest)) return largest;
    }
  }
  return largest;
}

/// Of the receivers where the channel has a value, those where it is above `limit`.
std::optional<double> shareAbove(const MapChannel& channel, double limit) {
  const auto exist = std::ranges::count_if(channel.values, [](double value) { return !std::isnan(value); });
  if (exist == 0) return std::nullopt;
  const auto above = std::ranges::count_if(channel.values, [limit](double value) { return value > limit; });
  return static_cast<double>(above) / static_cast<double>(exist);
}

ResultTable::Cell numberOrNone(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

EstimatorComparison compareEstimators(std::vector<FigureScene> scenes, const FigureScene& room,
                                      const ComparisonPlan& plan, unsigned threads, const QualityProgress& progress) {
  const auto telling = [&progress](const std::string& work) {
    return [&progress, work](std::size_t done, std::size_t all) {
      if (progress) progress(work, done, all);
    };
  };
  EstimatorComparison comparison;
  comparison.plan = plan;
  for (FigureScene& scene : scenes) {
    const ReceiverGrid grid = withResolution(*scene.scene.grid, plan.resolution);
    const std::string work = "estimators in " + scene.name;
    const AnalyticFigure exact = analyticFigure(std::move(scene), grid, threads);
    EstimatorComparison::InScene result{exact.scene, grid, {}, shareAbove(exact.map.channel("gap.hessian"), 0.1)};
    for (const ChosenMap& chosen : mapsOf(exact.scene.scene.polygons, grid, plan, threads, telling(work))) {
      result.errors.push_back({chosen.estimator, chosen.rays, errorsOf(chosen.map, exact.map, Compared::kGradient),
                               errorsOf(chosen.map, exact.map, Compared::kHessian)});
    }
    comparison.scenes.push_back(std::move(result));
  }
  std::vector<Polygon> walls = room.scene.polygons;
  std::erase_if(walls, [](const Polygon& polygon) { return polygon.radiance == 0.0; });
  const ReceiverGrid grid = withResolution(*room.scene.grid, plan.room_receivers);
  for (const ChosenMap& chosen : mapsOf(walls, grid, plan, threads, telling("constant radiance"))) {
    const bool claims = std::ranges::find(kClaimZero, chosen.estimator.name) != kClaimZero.end();
    comparison.leaks.push_back({chosen.estimator, claims, largestOf(chosen.map, Compared::kGradient),
                                largestOf(chosen.map, Compared::kHessian)});
  }
  return comparison;
}

double leakOfRounding(const ComparisonPlan& plan) {
  return static_cast<double>(plan.rays) * std::numeric_limits<double>::epsilon() * std::numbers::pi;
}

bool isClosed(const ConstantRadianceLeak& leak, const ComparisonPlan& plan) {
  const double most = leakOfRounding(plan);
  return leak.gradient.value_or(0.0) <= most && leak.hessian.value_or(0.0) <= most;
}

const ConvergenceCurve* findCurve(std::span<const QualityFigure::Curves> curves, const std::string& scene,
                                  const EstimatorChoice& estimator, Compared compared) {
  for (const QualityFigure::Curves& group : curves) {
    if (group.scene.name != scene) continue;
    for (const ConvergenceCurve& curve : group.curves) {
      if (curve.compared == compared && curve.estimator.label() == estimator.label()) return &curve;
    }
  }
  return nullptr;
}

ResultTable comparisonTable(const EstimatorComparison& comparison, std::span<const QualityFigure::Curves> curves) {
  ResultTable table({"scene", "quantity", "estimator", "rays", "receivers", "compared", "median", "percentile_99",
                     "rms", "constant_radiance", "order", "order_low_5", "order_high_95"});
  for (const EstimatorComparison::InScene& in : comparison.scenes) {
    for (const Compared compared : {Compared::kGradient, Compared::kHessian}) {
      for (std::size_t i = 0; i < in.errors.size(); ++i) {
        const EstimatorErrors& row = in.errors[i];
        const auto& errors = compared == Compared::kGradient ? row.gradient : row.hessian;
        if (!errors) continue;
        const ConstantRadianceLeak& leak = comparison.leaks.at(i);
        const ConvergenceCurve* curve = findCurve(curves, in.scene.name, row.estimator, compared);
        const auto order = [curve](double ConvergenceOrder::*value) {
          return numberOrNone(curve == nullptr ? std::nullopt : std::optional(curve->order.*value));
        };
        table.add({in.scene.name, std::string(quantityOf(compared).name), row.estimator.label(), row.rays,
                   in.grid.width * in.grid.height, errors->compared, errors->median, errors->percentile99, errors->rms,
                   numberOrNone(compared == Compared::kGradient ? leak.gradient : leak.hessian),
                   order(&ConvergenceOrder::median), order(&ConvergenceOrder::low), order(&ConvergenceOrder::high)});
      }
    }
  }
  return table;
}

}  // namespace irradiff
