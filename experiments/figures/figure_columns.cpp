#include "experiments/figures/figure_columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace irradiff {
namespace {

/// In the order of the paper's figure; the tangential Hessian comes last.
constexpr std::array kOrder{Compared::kGradient, Compared::kEigenvalues, Compared::kHessian};

/// Of EstimateValues: the channel of a DerivativeMap that means the same.
constexpr std::array<const char*, kEstimateValueCount> kChannelNames{
    "E",          "gradient.x", "gradient.y", "gradient.z", "hessian.xx",
    "hessian.xy", "hessian.yy", "lambda1",    "lambda2",    "lambda3"};

const char* mappingOf(Compared compared) {
  switch (compared) {
    case Compared::kGradient:
      return "(dE/dx, dE/dy) as (red, green)";
    case Compared::kEigenvalues:
      return "eigenvalues of the Hessian in space as (red, green, blue)";
    case Compared::kHessian:
      break;
  }
  return "tangential Hessian (xx, xy, yy) as (red, green, blue)";
}

std::vector<const MapChannel*> pointersTo(const std::vector<MapChannel>& channels) {
  std::vector<const MapChannel*> pointers;
  pointers.reserve(channels.size());
  for (const MapChannel& channel : channels) pointers.push_back(&channel);
  return pointers;
}

/// The components of a quantity as an estimator has them, or how far they are from the truth.
std::vector<MapChannel> componentsOf(const EstimateMap& estimate, const ComparedQuantity& quantity,
                                     const DerivativeMap* subtracted) {
  std::vector<MapChannel> components;
  components.reserve(quantity.values.size());
  for (std::size_t k = 0; k < quantity.values.size(); ++k) {
    MapChannel component{quantity.truth[k], quantity.unit, "", ChannelKind::kSigned, {}};
    component.values = estimate.channel(quantity.values[k]);
    if (subtracted != nullptr) {
      const std::vector<double>& truth = subtracted->channel(quantity.truth[k]).values;
      for (std::size_t i = 0; i < truth.size(); ++i) component.values[i] -= truth[i];
    }
    components.push_back(std::move(component));
  }
  return components;
}

bool existsSomewhere(const DerivativeMap& truth, const ComparedQuantity& quantity) {
  return std::ranges::any_of(truth.channel(quantity.truth[0]).values, [](double value) { return !std::isnan(value); });
}

FigureColumn truthColumn(const DerivativeMap& truth, const ComparedQuantity& quantity) {
  std::vector<const MapChannel*> components;
  components.reserve(quantity.truth.size());
  for (const char* name : quantity.truth) components.push_back(&truth.channel(name));
  FigureColumn column;
  column.compared = quantity.compared;
  column.source = "analytic";
  column.picture = triplePicture(truth.grid, quantity.name + std::string(".analytic"),
                                 std::string("exact: ") + mappingOf(quantity.compared), components,
                                 limitOf(components, kShareWithinLimit));
  column.channels.assign(quantity.truth.begin(), quantity.truth.end());
  return column;
}

FigureColumn estimateColumn(const DerivativeMap& truth, const EstimateMap& estimate, const ComparedQuantity& quantity,
                            double limit) {
  const auto pictureOf = [&](const std::vector<MapChannel>& components, const std::string& ending,
                             const std::string& title) {
    const std::vector<const MapChannel*> pointers = pointersTo(components);
    return triplePicture(truth.grid, std::string(quantity.name) + '.' + estimate.estimator + ending, title, pointers,
                         limitAt(pointers, limit));
  };
  FigureColumn column;
  column.compared = quantity.compared;
  column.source = estimate.estimator;
  column.picture = pictureOf(componentsOf(estimate, quantity, nullptr), "",
                             estimate.estimator + ": " + mappingOf(quantity.compared));
  column.difference = pictureOf(componentsOf(estimate, quantity, &truth), ".difference",
                                estimate.estimator + " less the truth: " + mappingOf(quantity.compared));
  column.errors = summarise(estimate, truth, quantity.compared);
  for (const EstimateValue value : quantity.values) {
    column.channels.push_back(estimate.estimator + '.' + kChannelNames[value]);
  }
  column.channels.push_back(estimate.estimator + ".error." + quantity.name);
  return column;
}

}  // namespace

std::vector<FigureColumn> figureColumns(const DerivativeMap& truth, std::span<const EstimateMap> estimates) {
  std::vector<FigureColumn> columns;
  for (const Compared compared : kOrder) {
    const ComparedQuantity& quantity = quantityOf(compared);
    if (!existsSomewhere(truth, quantity)) continue;
    const FigureColumn exact = truthColumn(truth, quantity);
    bool is_known = false;
    for (const EstimateMap& estimate : estimates) {
      if (!knows(estimate, compared)) continue;
      if (!is_known) columns.push_back(exact);
      is_known = true;
      columns.push_back(estimateColumn(truth, estimate, quantity, exact.picture.bars[0].high));
    }
  }
  return columns;
}

std::vector<MapChannel> comparedChannels(const DerivativeMap& truth, std::span<const EstimateMap> estimates) {
  std::vector<MapChannel> channels;
  for (const EstimateMap& estimate : estimates) {
    for (std::size_t k = 0; k < kEstimateValueCount; ++k) {
      std::vector<double> values = estimate.channel(static_cast<EstimateValue>(k));
      const bool is_known = std::ranges::any_of(values, [](double value) { return !std::isnan(value); });
      if (!is_known) continue;
      const MapChannel& exact = truth.channel(kChannelNames[k]);
      channels.push_back({estimate.estimator + '.' + exact.name, exact.unit, exact.meaning + ", " + estimate.estimator,
                          exact.kind, std::move(values)});
    }
    for (const Compared compared : kAllCompared) {
      if (!knows(estimate, compared)) continue;
      const std::string name = quantityOf(compared).name;
      channels.push_back({estimate.estimator + ".error." + name, "1", "relative error of the " + name,
                          ChannelKind::kAmount, relativeErrors(estimate, truth, compared)});
    }
  }
  return channels;
}

}  // namespace irradiff
