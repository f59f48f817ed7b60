#include "experiments/pareto/estimator_trade.h"

#include "experiments/figures/estimate_errors.h"
#include "experiments/figures/point_estimator.h"
#include "experiments/pareto/pareto_front.h"
#include "experiments/pareto/stopwatch.h"
#include "experiments/ray_casting/ray_caster.h"

#include <array>
#include <cmath>

namespace irradiff {

namespace {

constexpr std::array kStratifications{Stratification::kConcentric, Stratification::kPolar, Stratification::kHemicube};
constexpr std::array kCompared{Compared::kGradient, Compared::kHessian};

/// Estimators that share their samples.
struct Group {
  SamplingPlan sampling;
  std::vector<EstimatorChoice> choices;
  std::vector<PointEstimator> estimators;
};

Group groupOf(Stratification stratification, std::size_t rays, std::uint64_t seed) {
  Group group{{stratification, shapeForRays(stratification, rays), SamplePattern::kJittered, seed}, {}, {}};
  for (const EstimatorChoice& choice : allEstimators()) {
    if (choice.stratification != stratification) continue;
    group.choices.push_back(choice);
    group.estimators.push_back(pointEstimator(choice.name, stratification, group.sampling.shape));
  }
  return group;
}

class EstimatorMeasurement {
 public:
  EstimatorMeasurement(const FigureScene& scene, const EstimatorPlan& plan)
      : plan_(plan), grid_(*scene.scene.grid), caster_(scene.scene.polygons) {
    receivers_ = spreadReceivers(grid_, plan.receivers);
    truth_ = derivativesAt(receivers_, grid_, viewEvaluator(scene.scene.polygons), 1);
  }

  void addTrades(const Group& group, std::vector<EstimatorTrade>& trades) const {
    std::vector<Spread> microseconds;
    std::vector<Spread> shares;
    measure(group, microseconds, shares);
    for (const Compared compared : kCompared) {
      for (std::size_t e = 0; e < group.choices.size(); ++e) {
        const std::vector<double> errors = errorsOf(group, e, compared);
        if (errors.empty()) continue;
        trades.push_back({group.choices[e], compared, group.sampling.shape.size(), errors.size(), statisticsOf(errors),
                          microseconds[e], shares[e]});
      }
    }
  }

 private:
  SampleFrame frameOf(std::size_t i) const {
    return {receivers_[i].position, grid_.u.normalized(), grid_.v.normalized(), grid_.normal};
  }

  std::vector<double> errorsOf(const Group& group, std::size_t estimator, Compared compared) const {
    std::vector<double> errors;
    for (std::size_t i = 0; i < receivers_.size(); ++i) {
      const SampleFrame frame = frameOf(i);
      const ReceiverRays rays = caster_.from(frame);
      const EstimateValues values =
          valuesOf(group.estimators[estimator](gatherSamples(rays, frame, group.sampling, i)));
      const double error = relativeError(values, truth_, i, compared);
      if (!std::isnan(error)) errors.push_back(error);
    }
    return errors;
  }

  void measure(const Group& group, std::vector<Spread>& microseconds, std::vector<Spread>& shares) const {
    std::vector<std::vector<double>> times(group.choices.size());
    std::vector<std::vector<double>> parts(group.choices.size());
    for (std::size_t round = 0; round < plan_.rounds; ++round) {
      double gathering = 0.0;
      std::vector<double> estimating(group.choices.size(), 0.0);
      for (std::size_t i = 0; i < plan_.timed_receivers; ++i) {
        const SampleFrame frame = frameOf(i);
        gathering += nanosecondsOf(
            [&] {
              const ReceiverRays rays = caster_.from(frame);
              keep(gatherSamples(rays, frame, group.sampling, i));
            },
            1);
        const ReceiverRays rays = caster_.from(frame);
        const PointSamples samples = gatherSamples(rays, frame, group.sampling, i);
        for (std::size_t e = 0; e < group.choices.size(); ++e) {
          estimating[e] += nanosecondsOf([&] { keep(group.estimators[e](samples)); }, 1);
        }
      }
      for (std::size_t e = 0; e < group.choices.size(); ++e) {
        const double all = (castsItsOwn(group.choices[e].name) ? 0.0 : gathering) + estimating[e];
        times[e].push_back(1e-3 * all / static_cast<double>(plan_.timed_receivers));
        parts[e].push_back(estimating[e] / all);
      }
    }
    for (std::size_t e = 0; e < group.choices.size(); ++e) {
      microseconds.push_back(spreadOf(times[e]));
      shares.push_back(spreadOf(parts[e]));
    }
  }

  const EstimatorPlan& plan_;
  ReceiverGrid grid_;
  RayCaster caster_;
  std::vector<Receiver> receivers_;
  DerivativeMap truth_;
};

void markFront(std::vector<EstimatorTrade>& trades, Compared compared) {
  std::vector<TimeAndError> points;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < trades.size(); ++i) {
    if (trades[i].compared != compared) continue;
    points.push_back({trades[i].microseconds.median, trades[i].errors.median});
    places.push_back(i);
  }
  const std::vector<bool> on_front = paretoFront(points);
  for (std::size_t i = 0; i < places.size(); ++i) trades[places[i]].on_front = on_front[i];
}

}  // namespace

std::vector<EstimatorTrade> estimatorTrades(const FigureScene& scene, const EstimatorPlan& plan) {
  const EstimatorMeasurement measurement(scene, plan);
  std::vector<EstimatorTrade> trades;
  for (const Stratification stratification : kStratifications) {
    for (const std::size_t rays : plan.rays) measurement.addTrades(groupOf(stratification, rays, plan.seed), trades);
  }
  for (const Compared compared : kCompared) markFront(trades, compared);
  return trades;
}

}  // namespace irradiff
