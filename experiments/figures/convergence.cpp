#include "experiments/figures/convergence.h"

#include "derivatives/estimators/estimator.h"
#include "experiments/figures/view_evaluation.h"
#include "verification/report/parallel_tasks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace irradiff {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
constexpr std::array kStratifications{Stratification::kConcentric, Stratification::kPolar, Stratification::kHemicube};
constexpr std::array kCompared{Compared::kGradient, Compared::kHessian};
/// Receivers of one tile.
constexpr std::size_t kBatch = 64;

std::size_t batchesOf(const ConvergenceStep& step) { return (step.receivers + kBatch - 1) / kBatch; }

/// One stratification, number of rays and seed.
struct Combination {
  Stratification stratification;
  std::size_t step;  ///< an index of the plan's
  std::size_t seed;  ///< from the first one on
};

std::vector<Combination> combinationsOf(const ConvergencePlan& plan) {
  std::vector<Combination> all;
  for (const Stratification stratification : kStratifications) {
    // The longest first, so that no thread is left with them at the end.
    for (std::size_t step = plan.steps.size(); step-- > 0;) {
      for (std::size_t seed = 0; seed < plan.steps[step].seeds; ++seed) all.push_back({stratification, step, seed});
    }
  }
  return all;
}

std::vector<EstimatorChoice> choicesOf(Stratification stratification) {
  std::vector<EstimatorChoice> choices = allEstimators();
  std::erase_if(choices, [&](const EstimatorChoice& choice) { return choice.stratification != stratification; });
  return choices;
}

double slopeOf(const std::vector<double>& x, const std::vector<double>& y) {
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / static_cast<double>(x.size());
    mean_y += y[i] / static_cast<double>(x.size());
  }
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    products += (x[i] - mean_x) * (y[i] - mean_y);
    squares += (x[i] - mean_x) * (x[i] - mean_x);
  }
  return products / squares;
}

/// `medians[step][seed]`, unsorted.
ConvergenceOrder orderOf(const std::vector<ConvergencePoint>& points, const std::vector<std::vector<double>>& medians) {
  std::vector<double> orders;
  const std::size_t seeds = std::ranges::min(medians, {}, [](const auto& m) { return m.size(); }).size();
  for (std::size_t seed = 0; seed < seeds; ++seed) {
    std::vector<double> x;
    std::vector<double> y;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i].rays < kFirstRaysOfOrder || !(medians[i][seed] > 0.0)) continue;
      x.push_back(0.5 * std::log(static_cast<double>(points[i].rays)));
      y.push_back(std::log(medians[i][seed]));
    }
    if (x.size() >= 2) orders.push_back(-slopeOf(x, y));
  }
  if (orders.empty()) return {kMissing, kMissing, kMissing};
  std::ranges::sort(orders);
  return {percentile(orders, 0.5), percentile(orders, 0.05), percentile(orders, 0.95)};
}

/// The errors of all estimators with one combination, in the order [estimator][compared][receiver]; NaN where there is
/// nothing to compare.
class ErrorTable {
 public:
  ErrorTable(std::size_t estimators, std::size_t receivers)
      : receivers_(receivers), errors_(estimators * kCompared.size() * receivers, kMissing) {}

  double& at(std::size_t estimator, std::size_t compared, std::size_t receiver) {
    return errors_[(estimator * kCompared.size() + compared) * receivers_ + receiver];
  }

  /// Sorted, those that exist.
  std::vector<double> sorted(std::size_t estimator, std::size_t compared) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < receivers_; ++i) {
      const double error = at(estimator, compared, i);
      if (!std::isnan(error)) errors.push_back(error);
    }
    std::ranges::sort(errors);
    return errors;
  }

 private:
  std::size_t receivers_;
  std::vector<double> errors_;
};

}  // namespace

std::vector<Receiver> spreadReceivers(const ReceiverGrid& grid, std::size_t count) {
  constexpr double kRoot = 1.3247179572447460;
  std::vector<Receiver> receivers;
  receivers.reserve(count);
  const auto share = [](double step, std::size_t i) {
    const double multiple = 0.5 + step * static_cast<double>(i + 1);
    return multiple - std::floor(multiple);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const double u = share(1.0 / kRoot, i);
    const double v = share(1.0 / (kRoot * kRoot), i);
    receivers.push_back({grid.origin + u * grid.u + v * grid.v, grid.normal});
  }
  return receivers;
}

GridShape shapeForRays(Stratification stratification, std::size_t rays) {
  const auto count = static_cast<double>(rays);
  // A root is rounded; what counts is the product.
  const auto largest = [](double guess, const auto& strata, std::size_t most) {
    auto side = static_cast<std::size_t>(guess) + 1;
    while (side > 1 && strata(side) > most) --side;
    return side;
  };
  switch (stratification) {
    case Stratification::kConcentric: {
      const std::size_t side = largest(
          std::sqrt(count), [](std::size_t n) { return n * n; }, rays);
      return {side, side};
    }
    case Stratification::kPolar: {
      const auto rings = static_cast<std::size_t>(std::max(1.0, std::sqrt(count / std::numbers::pi)));
      return {rings, rays / rings};
    }
    case Stratification::kHemicube:
      break;
  }
  const std::size_t half = largest(
      std::sqrt(count / 12.0), [](std::size_t n) { return 12 * n * n; }, rays);
  return {6 * half, 2 * half};
}

std::string EstimatorChoice::label() const {
  switch (stratification) {
    case Stratification::kConcentric:
      return name;
    case Stratification::kPolar:
      return name + " (polar)";
    case Stratification::kHemicube:
      break;
  }
  return name.starts_with("hemicube") ? name : name + " (hemicube)";
}

std::vector<EstimatorChoice> allEstimators() {
  std::vector<EstimatorChoice> all;
  const std::vector<std::string> concentric = estimatorsFor(Stratification::kConcentric);
  all.push_back({"ward-heckbert", Stratification::kPolar});
  for (const std::string& name : concentric) all.push_back({name, Stratification::kConcentric});
  for (const std::string& name : estimatorsFor(Stratification::kHemicube)) {
    if (std::ranges::find(concentric, name) == concentric.end()) all.push_back({name, Stratification::kHemicube});
  }
  return all;
}

std::size_t convergenceTiles(const ConvergencePlan& plan) {
  std::size_t tiles = 0;
  for (const Combination& combination : combinationsOf(plan)) tiles += batchesOf(plan.steps[combination.step]);
  return tiles;
}

std::vector<ConvergenceCurve> convergenceCurves(std::span<const Polygon> polygons, const ReceiverGrid& grid,
                                                const ConvergencePlan& plan, unsigned threads,
                                                const TileStore* finished, std::size_t first_tile,
                                                const std::function<void(std::size_t, std::size_t)>& progress) {
  const std::size_t most = std::ranges::max(plan.steps, {}, &ConvergenceStep::receivers).receivers;
  const std::vector<Receiver> receivers = spreadReceivers(grid, most);
  const DerivativeMap truth = derivativesAt(receivers, grid, viewEvaluator(polygons), threads);
  const RayCaster caster(polygons);
  const std::vector<Combination> combinations = combinationsOf(plan);
  std::vector<ErrorTable> tables;
  std::vector<std::function<void()>> tasks;
  tables.reserve(combinations.size());
  for (const Combination& combination : combinations) {
    const std::vector<EstimatorChoice> choices = choicesOf(combination.stratification);
    const ConvergenceStep& step = plan.steps[combination.step];
    ErrorTable& table = tables.emplace_back(choices.size(), step.receivers);
    for (std::size_t batch = 0; batch < batchesOf(step); ++batch) {
      const std::size_t tile = first_tile + tasks.size();
      tasks.emplace_back([&, choices, combination, batch, tile] {
        const std::size_t begin = batch * kBatch;
        const std::size_t count = std::min(kBatch, step.receivers - begin);
        const std::size_t numbers = choices.size() * count * kEstimateValueCount;
        std::optional<std::vector<double>> values;
        if (finished != nullptr) values = finished->read(tile, numbers);
        if (!values) {
          values.emplace();
          values->reserve(numbers);
          const SamplingPlan sampling{combination.stratification, shapeForRays(combination.stratification, step.rays),
                                      SamplePattern::kJittered, plan.first_seed + combination.seed};
          std::vector<PointEstimator> estimators;
          estimators.reserve(choices.size());
          for (const EstimatorChoice& choice : choices) {
            estimators.push_back(pointEstimator(choice.name, sampling.stratification, sampling.shape));
          }
          for (std::size_t i = begin; i < begin + count; ++i) {
            const SampleFrame frame{receivers[i].position, grid.u.normalized(), grid.v.normalized(), grid.normal};
            const ReceiverRays rays = caster.from(frame);
            const PointSamples samples = gatherSamples(rays, frame, sampling, i);
            for (const PointEstimator& estimator : estimators) {
              const EstimateValues estimate = valuesOf(estimator(samples));
              values->insert(values->end(), estimate.begin(), estimate.end());
            }
          }
          if (finished != nullptr) finished->write(tile, *values);
        }
        auto from = values->begin();
        for (std::size_t i = begin; i < begin + count; ++i) {
          for (std::size_t e = 0; e < choices.size(); ++e) {
            EstimateValues estimate{};
            std::copy_n(from, kEstimateValueCount, estimate.begin());
            from += kEstimateValueCount;
            for (std::size_t c = 0; c < kCompared.size(); ++c) {
              table.at(e, c, i) = relativeError(estimate, truth, i, kCompared[c]);
            }
          }
        }
      });
    }
  }
  runTasks(tasks, threads, progress);

  std::vector<ConvergenceCurve> curves;
  for (std::size_t c = 0; c < kCompared.size(); ++c) {
    for (const EstimatorChoice& choice : allEstimators()) {
      const std::vector<EstimatorChoice> group = choicesOf(choice.stratification);
      const auto place =
          static_cast<std::size_t>(std::ranges::find(group, choice.name, &EstimatorChoice::name) - group.begin());
      ConvergenceCurve curve{choice, kCompared[c], {}, {}};
      std::vector<std::vector<double>> medians(plan.steps.size());
      for (const ConvergenceStep& step : plan.steps) {
        curve.points.push_back({shapeForRays(choice.stratification, step.rays).size(), step.receivers, 0, {}});
      }
      for (std::size_t k = 0; k < combinations.size(); ++k) {
        if (combinations[k].stratification != choice.stratification) continue;
        const std::vector<double> errors = tables[k].sorted(place, c);
        if (errors.empty()) continue;
        curve.points[combinations[k].step].compared = errors.size();
        medians[combinations[k].step].push_back(percentile(errors, 0.5));
      }
      for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        curve.points[i].medians = medians[i];
        std::ranges::sort(curve.points[i].medians);
      }
      const bool is_known = !medians.empty() && std::ranges::none_of(medians, [](const auto& m) { return m.empty(); });
      if (!is_known) continue;
      curve.order = orderOf(curve.points, medians);
      curves.push_back(std::move(curve));
    }
  }
  return curves;
}

}  // namespace irradiff
