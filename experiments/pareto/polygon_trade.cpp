#include "experiments/pareto/polygon_trade.h"

#include "experiments/pareto/pareto_front.h"
#include "experiments/pareto/stopwatch.h"

#include <algorithm>
#include <cmath>

namespace irradiff {

namespace {

/// A turn takes at least as long, so that the clock's own steps do not count.
constexpr double kTurn = 2e4;

void compare(const PolygonMethod& method, const FamilyInputs& inputs, MethodTrade& trade) {
  std::array<std::vector<double>, 4> errors;
  for (std::size_t i = 0; i < inputs.inputs.size(); ++i) {
    if (!method.knows_horizon && !inputs.above_horizon[i]) continue;
    const Configuration& input = inputs.inputs[i];
    FormFactor<long double> value = method.evaluate(input.polygon, input.receiver);
    if (method.of_either_side && inputs.truths[i].form_factor < 0) {
      value = {-value.value, -value.gradient, -value.hessian};
    }
    const std::array<double, 4> all = relativeErrors(value, inputs.truths[i]);
    if (std::isnan(all[kLargestError])) continue;
    for (std::size_t k = 0; k < errors.size(); ++k) errors[k].push_back(all[k]);
  }
  trade.compared = errors[kLargestError].size();
  if (trade.compared == 0) return;
  for (std::size_t k = 0; k < errors.size(); ++k) trade.errors[k] = statisticsOf(errors[k]);
}

void markFront(std::vector<MethodTrade>& methods) {
  std::vector<TimeAndError> points;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    if (methods[i].compared == 0) continue;
    points.push_back({methods[i].nanoseconds.median, methods[i].errors[kLargestError].percentile99});
    places.push_back(i);
  }
  const std::vector<bool> on_front = paretoFront(points);
  for (std::size_t i = 0; i < places.size(); ++i) methods[places[i]].on_front = on_front[i];
}

}  // namespace

ErrorStatistics statisticsOf(std::vector<double> errors) {
  std::ranges::sort(errors);
  const auto at = [&errors](double share) {
    const auto place = static_cast<std::size_t>(std::ceil(share * static_cast<double>(errors.size())));
    return errors[std::max<std::size_t>(place, 1) - 1];
  };
  return {at(0.5), at(0.99), errors.back()};
}

FamilyTrade tradeOf(const FamilyInputs& inputs, std::size_t rounds) {
  const std::vector<PolygonMethod>& methods = polygonMethods();
  FamilyTrade result{std::string(inputs.family->name), std::string(inputs.family->description), inputs.inputs.size(),
                     std::vector<MethodTrade>(methods.size())};
  const auto passOf = [&inputs](const PolygonMethod& method) {
    return [&inputs, &method] {
      for (const Configuration& input : inputs.inputs) keep(method.evaluate(input.polygon, input.receiver));
    };
  };
  std::vector<std::size_t> calls;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    result.methods[m].method = methods[m].name;
    result.methods[m].group = methods[m].group;
    compare(methods[m], inputs, result.methods[m]);
    calls.push_back(callsFor(passOf(methods[m]), kTurn));
  }
  std::vector<std::vector<double>> times(methods.size());
  std::vector<std::vector<double>> ratios(methods.size());
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t m = 0; m < methods.size(); ++m) {
      times[m].push_back(nanosecondsOf(passOf(methods[m]), calls[m]) / static_cast<double>(inputs.inputs.size()));
      ratios[m].push_back(times[m].back() / times[0].back());
    }
  }
  for (std::size_t m = 0; m < methods.size(); ++m) {
    result.methods[m].nanoseconds = spreadOf(times[m]);
    result.methods[m].ratio = spreadOf(ratios[m]);
  }
  markFront(result.methods);
  return result;
}

}  // namespace irradiff
