#include "experiments/figures/estimate_errors.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace irradiff {

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

struct PointComparison {
  double difference = 0.0;  ///< max|estimate - truth|
  double size = 0.0;        ///< max|truth|; either is NaN where something has no value
  double bound = 0.0;
};

/// Compares at one receiver after another.
class Comparison {
 public:
  Comparison(const DerivativeMap& truth, Compared compared)
      : quantity_(quantityOf(compared)), bound_(truth.channel(quantity_.bound).values) {
    for (const char* name : quantity_.truth) truth_.push_back(&truth.channel(name).values);
  }

  PointComparison at(const EstimateValues& estimate, std::size_t place) const {
    PointComparison result{0.0, 0.0, bound_[place]};
    for (std::size_t k = 0; k < truth_.size(); ++k) {
      const double truth = (*truth_[k])[place];
      const double difference = std::abs(estimate[quantity_.values[k]] - truth);
      // std::max would lose a NaN.
      result.difference = difference > result.difference || std::isnan(difference) ? difference : result.difference;
      result.size = std::abs(truth) > result.size || std::isnan(truth) ? std::abs(truth) : result.size;
    }
    return result;
  }

 private:
  const ComparedQuantity& quantity_;
  const std::vector<double>& bound_;
  std::vector<const std::vector<double>*> truth_;
};

double relative(const PointComparison& at) { return at.size > at.bound ? at.difference / at.size : kMissing; }

}  // namespace

const ComparedQuantity& quantityOf(Compared compared) {
  static const std::array<ComparedQuantity, 3> kQuantities{
      {{Compared::kGradient,
        "gradient",
        "W/m^3",
        {kEstimateGradientX, kEstimateGradientY},
        {"gradient.x", "gradient.y"},
        "bound.gradient"},
       {Compared::kHessian,
        "hessian",
        "W/m^4",
        {kEstimateHessianXX, kEstimateHessianXY, kEstimateHessianYY},
        {"hessian.xx", "hessian.xy", "hessian.yy"},
        "bound.tangential_hessian"},
       {Compared::kEigenvalues,
        "eigenvalues",
        "W/m^4",
        {kEstimateLambda1, kEstimateLambda2, kEstimateLambda3},
        {"lambda1", "lambda2", "lambda3"},
        "bound.hessian"}}};
  return kQuantities[static_cast<std::size_t>(compared)];
}

bool knows(const EstimateMap& estimate, Compared compared) {
  const EstimateValue first = quantityOf(compared).values[0];
  return std::ranges::any_of(estimate.values, [first](const EstimateValues& at) { return !std::isnan(at[first]); });
}

std::vector<double> relativeErrors(const EstimateMap& estimate, const DerivativeMap& truth, Compared compared) {
  const Comparison comparison(truth, compared);
  std::vector<double> errors;
  errors.reserve(estimate.values.size());
  for (std::size_t place = 0; place < estimate.values.size(); ++place) {
    errors.push_back(relative(comparison.at(estimate.values[place], place)));
  }
  return errors;
}

double relativeError(const EstimateValues& estimate, const DerivativeMap& truth, std::size_t place, Compared compared) {
  return relative(Comparison(truth, compared).at(estimate, place));
}

double percentile(const std::vector<double>& sorted, double share) {
  const auto place = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(place, 1) - 1];
}

ErrorSummary summarise(const EstimateMap& estimate, const DerivativeMap& truth, Compared compared) {
  const Comparison comparison(truth, compared);
  ErrorSummary summary;
  std::vector<double> errors;
  double differences = 0.0;
  double sizes = 0.0;
  for (std::size_t place = 0; place < estimate.values.size(); ++place) {
    const PointComparison at = comparison.at(estimate.values[place], place);
    if (std::isnan(at.size)) {
      ++summary.no_truth;
    } else if (!(at.size > at.bound)) {
      ++summary.zero_truth;
    } else if (std::isnan(at.difference)) {
      ++summary.no_estimate;
    } else {
      errors.push_back(at.difference / at.size);
      differences += at.difference * at.difference;
      sizes += at.size * at.size;
    }
  }
  summary.compared = errors.size();
  if (errors.empty()) {
    summary.median = summary.percentile99 = summary.rms = kMissing;
    return summary;
  }
  std::ranges::sort(errors);
  summary.median = percentile(errors, 0.5);
  summary.percentile99 = percentile(errors, 0.99);
  summary.rms = std::sqrt(differences / sizes);
  return summary;
}

std::string errorNumber(double error) {
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "%.2g", error);
  return std::isnan(error) ? "none" : text.data();
}

}  // namespace irradiff
