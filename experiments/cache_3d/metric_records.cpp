#include "experiments/cache_3d/metric_records.h"

#include "derivatives/error_metric/error_metric.h"
#include "derivatives/scene/number_text.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace irradiff {
namespace {

constexpr std::string_view kReprojection = "reprojection";
constexpr std::string_view kSecondOrder = "second-order";
constexpr std::string_view kOracle = "oracle";

bool takesProfile(std::string_view metric) {
  return metric == kReprojection || metric == kSecondOrder || metric == kOracle;
}

void requireKnown(std::string_view metric, const FieldKnowledge& field) {
  const std::vector<std::string> known = recordMetrics(static_cast<bool>(field.predicted));
  if (std::ranges::find(known, metric) != known.end()) return;
  std::string text = "unknown error metric \"" + std::string(metric) + "\": must be one of ";
  for (std::size_t i = 0; i < known.size(); ++i) text += (i > 0 ? ", " : "") + known[i];
  throw std::invalid_argument(text);
}

std::size_t shareNumber(const MetricChoice& choice) {
  const auto found = std::ranges::find(kRadianceShares, choice.radiance_share);
  if (found == kRadianceShares.end()) {
    throw std::invalid_argument("error metric " + choice.metric + ": the share of radiance that is added is " +
                                numberText(choice.radiance_share) + ", must be 0 or 0.01");
  }
  return static_cast<std::size_t>(std::distance(kRadianceShares.begin(), found));
}

ErrorMetricOptions optionsOf(const MetricChoice& choice, double pixel_size) {
  return {choice.threshold, choice.ellipse, choice.smallest_pixels * pixel_size, choice.largest_pixels * pixel_size};
}

/// As ErrorMetric, for the metrics that it does not know.
void requireProfileOptions(const MetricChoice& choice) {
  const auto reject = [&](const std::string& why) {
    throw std::invalid_argument("error metric " + choice.metric + ": " + why);
  };
  if (!(choice.threshold > 0.0) || std::isinf(choice.threshold)) {
    reject("the threshold is " + numberText(choice.threshold) + ", must be positive and finite");
  }
  choice.ellipse.require();
  const double smallest = choice.smallest_pixels;
  const double largest = choice.largest_pixels;
  if (!(smallest >= 0.0 && std::isfinite(smallest) && largest >= smallest && largest > 0.0)) {
    reject("the limits of the radius are " + numberText(smallest) + " and " + numberText(largest) +
           " pixels, must be 0 <= smallest <= largest, the smallest finite and the largest positive");
  }
}

/// As if the samples had said so.
RecordKnowledge withKnownGeometry(RecordKnowledge known) {
  known.irradiance = known.known_geometry.irradiance;
  known.gradient = known.known_geometry.gradient;
  known.rotational_gradient = known.known_geometry.rotational_gradient;
  return known;
}

/// For a record without light. The oracle knows what is around it all the same.
MetricChoice inTheDark(MetricChoice choice) {
  if (choice.metric != kOracle) {
    choice.largest_pixels = std::min(choice.largest_pixels, std::max(choice.smallest_pixels, choice.black_pixels));
  }
  return choice;
}

const Eigen::Matrix2d& hessianOf(std::string_view metric, const MetricHessians& hessians) {
  if (metric == "radiometric-hessian") return hessians.radiometric;
  if (metric == "geometric-hessian") return hessians.geometric;
  return hessians.occlusion;
}

ValidRegion publishedRegion(const MetricChoice& choice, const RecordKnowledge& known, const Receiver& receiver,
                            double pixel_size, std::size_t share) {
  const ErrorMetric metric(choice.metric, optionsOf(choice, pixel_size));
  RecordDerivatives derivatives{{known.irradiance}, {}, {}, known.harmonic_mean_distance};
  derivatives.tangential_gradient = tangentFrame<double>(receiver.normal).transpose() * known.gradient;
  if (metric.description().takes_hessian) {
    const MetricHessians& hessians = known.hessians[share];
    derivatives.irradiance = {hessians.irradiance};
    derivatives.tangential_hessian = TangentialHessian<double>{hessianOf(choice.metric, hessians)};
  }
  return metric.region(derivatives);
}

ValidRegion largestRegion(const FieldKnowledge& field, const MetricChoice& choice, const ErrorProfile& profile,
                          double unit, std::size_t receiver) {
  const ErrorMetricOptions options = optionsOf(choice, field.pixel_sizes[receiver]);
  return largestEllipse(profile, {unit}, options.threshold, options.ellipse, options.smallest_radius,
                        options.largest_radius);
}

ValidRegion profileRegion(const FieldKnowledge& field, const MetricChoice& choice, double irradiance,
                          std::size_t receiver) {
  const double unit = std::max(irradiance, field.least_irradiance);
  if (choice.metric == kOracle) {
    MetricChoice within = choice;
    if (field.reach) {
      const double reach = field.reach(receiver) / field.pixel_sizes[receiver];
      within.largest_pixels = std::min(choice.largest_pixels, std::max(choice.smallest_pixels, reach));
    }
    return largestRegion(field, within, field.oracle(receiver), unit, receiver);
  }
  // What a black record predicts is in units of the mean.
  return largestRegion(field, choice, field.reprojection(receiver), irradiance == 0.0 ? field.meanIrradiance() : unit,
                       receiver);
}

/// The region in which the second order is predicted to keep the threshold, and with what it is then extrapolated.
ValidRegion toSecondOrder(const FieldKnowledge& field, const MetricChoice& choice, const RecordKnowledge& known,
                          std::size_t receiver, CacheRecord& record) {
  // Without light there is nothing to extrapolate.
  if (known.irradiance == 0.0) return profileRegion(field, choice, 0.0, receiver);
  const Eigen::Matrix<double, 3, 2> frame = tangentFrame<double>(record.receiver.normal);
  const QuadraticIrradiance taylor{known.irradiance, frame.transpose() * known.gradient,
                                   known.hessians.front().occlusion};
  const IrradianceAround predicted =
      [&taylor, remainder = field.predicted(receiver)](const Eigen::Vector2d& step) -> std::optional<double> {
    const std::optional<double> beside = remainder(step);
    if (!beside) return std::nullopt;
    return taylor.irradiance + taylor.gradient.dot(step) + *beside;
  };
  ErrorProfile errors = errorsOf(taylor, predicted, field.profile_distances(receiver), field.profile_directions);
  if (field.add_unseen) field.add_unseen(receiver, errors);
  const ValidRegion region =
      largestRegion(field, choice, errors, std::max(known.irradiance, field.least_irradiance), receiver);
  const QuadraticIrradiance nearest =
      region.half_axes.allFinite() ? nearestQuadratic(taylor, predicted, region) : taylor;
  record.gradient += frame * (nearest.gradient - taylor.gradient);
  record.hessian = frame * nearest.hessian * frame.transpose();
  return region;
}

}  // namespace

std::vector<std::string> recordMetrics(bool has_second_order) {
  std::vector<std::string> names;
  for (const ErrorMetricDescription& description : errorMetricDescriptions()) names.emplace_back(description.name);
  names.emplace_back(kReprojection);
  if (has_second_order) names.emplace_back(kSecondOrder);
  names.emplace_back(kOracle);
  return names;
}

RecordMaker recordMaker(std::shared_ptr<const FieldKnowledge> field, const MetricChoice& choice) {
  requireKnown(choice.metric, *field);
  if (choice.knows_geometry && !field->offers_known_geometry) {
    throw std::invalid_argument("error metric " + choice.metric +
                                ": records with known geometry are asked for, which only rooms in space offer, from " +
                                std::to_string(kFewestRaysWithGeometry) + " rays on");
  }
  const std::size_t share = shareNumber(choice);
  if (takesProfile(choice.metric)) {
    requireProfileOptions(choice);
  } else {
    ErrorMetric(choice.metric, optionsOf(choice, 1.0));
  }
  if (!(choice.black_pixels > 0.0)) {
    throw std::invalid_argument("error metric " + choice.metric + ": the limit of black records is " +
                                numberText(choice.black_pixels) + " pixels, must be positive");
  }
  const MetricChoice black = inTheDark(choice);
  return [field = std::move(field), lit = choice, black, share](std::size_t i) {
    const RecordKnowledge known = lit.knows_geometry ? withKnownGeometry(field->record(i)) : field->record(i);
    const MetricChoice& chosen = known.irradiance == 0.0 ? black : lit;
    const Receiver& receiver = field->receivers[i];
    CacheRecord record;
    record.receiver = receiver;
    record.irradiance = known.irradiance;
    record.gradient = known.gradient;
    record.rotational_gradient = known.rotational_gradient;
    const ValidRegion region = chosen.metric == kSecondOrder ? toSecondOrder(*field, chosen, known, i, record)
                               : takesProfile(chosen.metric)
                                   ? profileRegion(*field, chosen, known.irradiance, i)
                                   : publishedRegion(chosen, known, receiver, field->pixel_sizes[i], share);
    const Eigen::Matrix<double, 3, 2> axes = tangentFrame<double>(receiver.normal) * region.axes;
    record.first_axis = axes.col(0);
    record.second_axis = axes.col(1);
    record.half_axes = region.half_axes;
    return record;
  };
}

std::function<double(std::size_t, const CacheRecord&)> trueError(std::shared_ptr<const FieldKnowledge> field) {
  return [field = std::move(field)](std::size_t receiver, const CacheRecord& record) {
    const Eigen::Matrix<double, 3, 2> frame = tangentFrame<double>(record.receiver.normal);
    Eigen::Matrix2d axes;
    axes << frame.transpose() * record.first_axis, frame.transpose() * record.second_axis;
    if (!field->truth) return integratedError(field->oracle(receiver), {record.half_axes, axes});
    const QuadraticIrradiance extrapolation{record.irradiance, frame.transpose() * record.gradient,
                                            frame.transpose() * record.hessian * frame};
    return integratedError(
        errorsOf(extrapolation, field->truth(receiver), field->true_distances(receiver), field->profile_directions),
        {record.half_axes, axes});
  };
}

}  // namespace irradiff
