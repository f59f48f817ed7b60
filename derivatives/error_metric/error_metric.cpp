#include "derivatives/error_metric/error_metric.h"

#include "derivatives/scene/number_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace irradiff {
namespace {

constexpr std::array kCatalogue{
    ErrorMetricDescription{"split-sphere", "Ward, Rubinstein and Clear 1988, harmonic mean distance", "", true, false,
                           false},
    ErrorMetricDescription{"bounded-split-sphere",
                           "Schwarzhaupt et al. 2012, section 5: split sphere clamped to gradient and radii",
                           "ward-heckbert", true, true, false},
    ErrorMetricDescription{"radiometric-hessian", "Jarosz et al. 2012, occlusion-unaware Hessian", "radiometric", false,
                           false, true},
    ErrorMetricDescription{"geometric-hessian", "Jarosz et al. 2012, Hessian without radiance", "geometric", false,
                           false, true},
    ErrorMetricDescription{"occlusion-hessian", "Schwarzhaupt et al. 2012, Eqs. (7), (10) and (14)", "triangulated",
                           false, false, true},
};

const ErrorMetricDescription& descriptionOf(std::string_view name) {
  std::string known;
  for (const ErrorMetricDescription& description : kCatalogue) {
    if (description.name == name) return description;
    known += (known.empty() ? " " : ", ") + std::string(description.name);
  }
  throw std::invalid_argument("unknown error metric \"" + std::string(name) + "\": must be one of" + known);
}

void requireLimits(const ErrorMetricDescription& metric, double smallest, double largest) {
  const std::string text = "error metric " + std::string(metric.name) + ": the limits of the radius are " +
                           numberText(smallest) + " and " + numberText(largest) + ", must be ";
  if (metric.takes_gradient && !(smallest > 0.0 && largest < std::numeric_limits<double>::infinity())) {
    throw std::invalid_argument(text + "positive and finite");
  }
  if (!(smallest >= 0.0 && largest >= smallest && largest > 0.0 && std::isfinite(smallest))) {
    throw std::invalid_argument(text + "0 <= smallest <= largest, the smallest finite and the largest positive");
  }
}

[[noreturn]] void rejectRecord(const ErrorMetricDescription& metric, const std::string& why) {
  throw std::invalid_argument("error metric " + std::string(metric.name) + ": " + why);
}

/// What the metric takes is there and in range.
void requireRecord(const ErrorMetricDescription& metric, const RecordDerivatives& record) {
  const double irradiance = record.irradiance.value;
  if (!(irradiance >= 0.0) || std::isinf(irradiance)) {
    rejectRecord(metric, "the irradiance of a record is " + numberText(irradiance) + ", must be finite and >= 0");
  }
  if (metric.takes_distance) {
    if (!record.harmonic_mean_distance) rejectRecord(metric, "the record has no harmonic mean distance");
    if (!(*record.harmonic_mean_distance > 0.0)) {
      rejectRecord(metric, "the harmonic mean distance of a record is " + numberText(*record.harmonic_mean_distance) +
                               ", must be positive");
    }
  }
  if (metric.takes_gradient) {
    if (!record.tangential_gradient) rejectRecord(metric, "the record has no translational gradient");
    if (!record.tangential_gradient->allFinite()) {
      rejectRecord(metric, "the tangential gradient of a record is " + pointText(*record.tangential_gradient) +
                               ", must be finite");
    }
  }
  if (metric.takes_hessian) {
    if (!record.tangential_hessian) rejectRecord(metric, "the record has no tangential Hessian");
    const Eigen::Matrix2d& h = record.tangential_hessian->value;
    if (!h.allFinite()) {
      rejectRecord(metric, "the tangential Hessian of a record has the rows " + pointText(h.row(0).transpose()) +
                               " and " + pointText(h.row(1).transpose()) + ", must be finite");
    }
  }
}

ValidRegion circle(double radius) { return {Eigen::Vector2d::Constant(radius), Eigen::Matrix2d::Identity()}; }

}  // namespace

std::span<const ErrorMetricDescription> errorMetricDescriptions() { return kCatalogue; }

ErrorMetric::ErrorMetric(std::string_view name, const ErrorMetricOptions& options)
    : description_(&descriptionOf(name)), options_(options) {
  if (!(options.threshold > 0.0) || std::isinf(options.threshold)) {
    throw std::invalid_argument("error metric " + std::string(name) + ": the threshold is " +
                                numberText(options.threshold) + ", must be positive and finite");
  }
  options.ellipse.require();
  requireLimits(*description_, options.smallest_radius, options.largest_radius);
}

double ErrorMetric::splitSphereRadius(const RecordDerivatives& record) const {
  double distance = *record.harmonic_mean_distance;
  if (description_->takes_gradient) {
    const double slope = std::hypot((*record.tangential_gradient)(0), (*record.tangential_gradient)(1));
    if (slope > 0.0) distance = std::min(distance, record.irradiance.value / slope);
  }
  return options_.threshold * distance;
}

double ErrorMetric::limited(double radius) const {
  const double result = std::min(std::max(radius, options_.smallest_radius), options_.largest_radius);
  if (!(result > 0.0)) {
    throw std::range_error("error metric " + std::string(description_->name) + ": at the threshold " +
                           numberText(options_.threshold) + " a radius is too small for double");
  }
  return result;
}

ValidRegion ErrorMetric::region(const RecordDerivatives& record) const {
  requireRecord(*description_, record);
  ValidRegion region = description_->takes_hessian ? errorEllipse(*record.tangential_hessian, record.irradiance,
                                                                  options_.threshold, options_.ellipse)
                                                   : circle(splitSphereRadius(record));
  region.half_axes = {limited(region.half_axes(0)), limited(region.half_axes(1))};
  return region;
}

double ErrorMetric::halfLength(const FlatlandRecordDerivatives& record) const {
  // The same record in space, where nothing changes along the other tangent.
  RecordDerivatives extruded{record.irradiance, {}, {}, record.harmonic_mean_distance};
  if (record.tangential_gradient) extruded.tangential_gradient = Eigen::Vector2d(*record.tangential_gradient, 0.0);
  if (record.tangential_hessian) {
    extruded.tangential_hessian =
        TangentialHessian<double>{Eigen::Vector2d(*record.tangential_hessian, 0.0).asDiagonal()};
  }
  requireRecord(*description_, extruded);
  if (!description_->takes_hessian) return limited(splitSphereRadius(extruded));
  const TangentialHessian<double, 2> hessian{Eigen::Matrix<double, 1, 1>(*record.tangential_hessian)};
  return limited(
      errorInterval(hessian, record.irradiance, options_.threshold, options_.ellipse.scale, options_.ellipse.measure));
}

}  // namespace irradiff
