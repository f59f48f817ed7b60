#include "experiments/figures/error_split.h"

#include "experiments/figures/view_evaluation.h"
#include "verification/report/parallel_tasks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace irradiff {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
constexpr std::array kCompared{Compared::kGradient, Compared::kHessian};
constexpr std::size_t kBatch = 64;
constexpr std::size_t kNumbersOfSplit = 4;

std::size_t batchesOf(const ConvergenceStep& step) { return (step.receivers + kBatch - 1) / kBatch; }

/// max|a - b| over the components of a quantity.
double difference(const EstimateValues& a, const EstimateValues& b, const ComparedQuantity& quantity) {
  double largest = 0.0;
  for (const EstimateValue k : quantity.values) {
    const double here = std::abs(a[k] - b[k]);
    largest = here > largest || std::isnan(here) ? here : largest;
  }
  return largest;
}

/// The truth at one receiver, in the places of an estimate.
EstimateValues truthAt(const DerivativeMap& truth, std::size_t receiver) {
  EstimateValues values{};
  for (const Compared compared : kCompared) {
    const ComparedQuantity& quantity = quantityOf(compared);
    for (std::size_t k = 0; k < quantity.values.size(); ++k) {
      values[quantity.values[k]] = truth.channel(quantity.truth[k]).values[receiver];
    }
  }
  return values;
}

/// An estimate in the frame turned by half a turn, in the first frame.
EstimateValues turnedBack(EstimateValues values) {
  values[kEstimateGradientX] = -values[kEstimateGradientX];
  values[kEstimateGradientY] = -values[kEstimateGradientY];
  return values;
}

/// All estimates of one estimator at one receiver.
struct Estimates {
  std::vector<EstimateValues> seeds;
  EstimateValues centred{};
  std::optional<EstimateValues> turned;  ///< those of the first seed, from its samples turned
};

SplitError splitOf(const Estimates& estimates, const EstimateValues& truth, Compared compared) {
  const ComparedQuantity& quantity = quantityOf(compared);
  const auto count = static_cast<double>(estimates.seeds.size());
  EstimateValues mean{};
  for (const EstimateValues& values : estimates.seeds) {
    for (const EstimateValue k : quantity.values) mean[k] += values[k] / count;
  }
  double errors = 0.0;
  double deviations = 0.0;
  for (const EstimateValues& values : estimates.seeds) {
    errors += std::pow(difference(values, truth, quantity), 2);
    deviations += std::pow(difference(values, mean, quantity), 2);
  }
  const double size = difference(truth, EstimateValues{}, quantity);
  return {std::sqrt(errors / count) / size,
          estimates.turned ? difference(*estimates.turned, estimates.seeds[0], quantity) / size : kMissing,
          difference(estimates.centred, truth, quantity) / size, std::sqrt(deviations / (count - 1.0)) / size};
}

/// The splits of a batch, in the order [receiver][estimator][compared].
std::vector<double> batchOf(const RayCaster& caster, const ReceiverGrid& grid, const ConvergencePlan& plan,
                            const ConvergenceStep& step, std::span<const std::string> names,
                            std::span<const Receiver> receivers, const DerivativeMap& truth, std::size_t begin,
                            std::size_t count) {
  const GridShape shape = shapeForRays(Stratification::kConcentric, step.rays);
  std::vector<PointEstimator> estimators;
  for (const std::string& name : names) {
    estimators.push_back(pointEstimator(name, Stratification::kConcentric, shape));
  }
  std::vector<double> numbers;
  for (std::size_t i = begin; i < begin + count; ++i) {
    const SampleFrame frame{receivers[i].position, grid.u.normalized(), grid.v.normalized(), grid.normal};
    const ReceiverRays rays = caster.from(frame);
    std::vector<Estimates> all(names.size());
    SamplingPlan sampling{Stratification::kConcentric, shape, SamplePattern::kCentred, plan.first_seed};
    const PointSamples centred = gatherSamples(rays, frame, sampling, i);
    for (std::size_t e = 0; e < names.size(); ++e) all[e].centred = valuesOf(estimators[e](centred));
    sampling.pattern = SamplePattern::kJittered;
    for (std::size_t seed = 0; seed < step.seeds; ++seed) {
      sampling.seed = plan.first_seed + seed;
      PointSamples samples = gatherSamples(rays, frame, sampling, i);
      for (std::size_t e = 0; e < names.size(); ++e) all[e].seeds.push_back(valuesOf(estimators[e](samples)));
      if (seed > 0) continue;
      samples.samples = halfTurned(samples.samples);
      for (std::size_t e = 0; e < names.size(); ++e) {
        if (castsItsOwn(names[e])) continue;
        all[e].turned = turnedBack(valuesOf(estimators[e](samples)));
      }
    }
    const EstimateValues exact = truthAt(truth, i);
    for (const Estimates& estimates : all) {
      for (const Compared compared : kCompared) {
        const bool is_compared = !std::isnan(relativeError(estimates.centred, truth, i, compared));
        const SplitError split =
            is_compared ? splitOf(estimates, exact, compared) : SplitError{kMissing, kMissing, kMissing, kMissing};
        numbers.insert(numbers.end(), {split.total, split.rounding, split.discretisation, split.noise});
      }
    }
  }
  return numbers;
}

/// Of the numbers that exist; NaN without any.
double medianOf(std::vector<double> numbers) {
  std::erase_if(numbers, [](double number) { return std::isnan(number); });
  if (numbers.empty()) return kMissing;
  std::ranges::sort(numbers);
  return percentile(numbers, 0.5);
}

}  // namespace

HemisphereSamples halfTurned(const HemisphereSamples& samples) {
  // Half a turn takes the last stratum to the first, and so on.
  HemisphereSamples turned = samples;
  for (std::vector<double>* numbers :
       {&turned.direction_t, &turned.direction_b, &turned.direction_n, &turned.inverse_distance, &turned.radiance}) {
    std::ranges::reverse(*numbers);
  }
  for (double& t : turned.direction_t) t = -t;
  for (double& b : turned.direction_b) b = -b;
  return turned;
}

std::size_t errorSplitTiles(const ConvergencePlan& plan) {
  std::size_t tiles = 0;
  for (const ConvergenceStep& step : plan.steps) tiles += batchesOf(step);
  return tiles;
}

std::vector<ErrorSplitCurve> errorSplits(std::span<const Polygon> polygons, const ReceiverGrid& grid,
                                         const ConvergencePlan& plan, unsigned threads, const TileStore* finished,
                                         std::size_t first_tile,
                                         const std::function<void(std::size_t, std::size_t)>& progress) {
  const std::size_t most = std::ranges::max(plan.steps, {}, &ConvergenceStep::receivers).receivers;
  const std::vector<Receiver> receivers = spreadReceivers(grid, most);
  const DerivativeMap truth = derivativesAt(receivers, grid, viewEvaluator(polygons), threads);
  const RayCaster caster(polygons);
  const std::vector<std::string> names = estimatorsFor(Stratification::kConcentric);
  const std::size_t numbers_of_receiver = names.size() * kCompared.size() * kNumbersOfSplit;
  std::vector<std::vector<double>> splits;
  for (const ConvergenceStep& step : plan.steps) splits.emplace_back(step.receivers * numbers_of_receiver);
  std::vector<std::function<void()>> tasks;
  for (std::size_t s = plan.steps.size(); s-- > 0;) {
    for (std::size_t batch = 0; batch < batchesOf(plan.steps[s]); ++batch) {
      const std::size_t tile = first_tile + tasks.size();
      tasks.emplace_back([&, s, batch, tile] {
        const ConvergenceStep& step = plan.steps[s];
        const std::size_t begin = batch * kBatch;
        const std::size_t count = std::min(kBatch, step.receivers - begin);
        std::optional<std::vector<double>> numbers;
        if (finished != nullptr) numbers = finished->read(tile, count * numbers_of_receiver);
        if (!numbers) {
          numbers = batchOf(caster, grid, plan, step, names, receivers, truth, begin, count);
          if (finished != nullptr) finished->write(tile, *numbers);
        }
        std::ranges::copy(*numbers, splits[s].begin() + static_cast<std::ptrdiff_t>(begin * numbers_of_receiver));
      });
    }
  }
  runTasks(tasks, threads, progress);

  std::vector<ErrorSplitCurve> curves;
  for (std::size_t c = 0; c < kCompared.size(); ++c) {
    for (std::size_t e = 0; e < names.size(); ++e) {
      ErrorSplitCurve curve{names[e], kCompared[c], {}};
      for (std::size_t s = 0; s < plan.steps.size(); ++s) {
        std::array<std::vector<double>, kNumbersOfSplit> columns;
        for (std::size_t i = 0; i < plan.steps[s].receivers; ++i) {
          for (std::size_t k = 0; k < kNumbersOfSplit; ++k) {
            columns[k].push_back(splits[s][i * numbers_of_receiver + (e * kCompared.size() + c) * kNumbersOfSplit + k]);
          }
        }
        const auto compared = std::ranges::count_if(columns[0], [](double total) { return !std::isnan(total); });
        if (compared == 0) continue;
        curve.points.push_back(
            {shapeForRays(Stratification::kConcentric, plan.steps[s].rays).size(),
             static_cast<std::size_t>(compared),
             {medianOf(columns[0]), medianOf(columns[1]), medianOf(columns[2]), medianOf(columns[3])}});
      }
      if (!curve.points.empty()) curves.push_back(std::move(curve));
    }
  }
  return curves;
}

}  // namespace irradiff
