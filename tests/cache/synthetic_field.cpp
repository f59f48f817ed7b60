#include "tests/cache/synthetic_field.h"

#include "derivatives/error_metric/error_ellipse.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

namespace irradiff::cache_test {
namespace {

/// The middle of a pixel of an image, from 0 to 1 along both sides; row by row.
Eigen::Vector2d middleOf(std::size_t pixel, std::size_t width) {
  const std::size_t row = pixel / width;
  const std::size_t column = pixel % width;
  return (Eigen::Vector2d(static_cast<double>(column), static_cast<double>(row)).array() + 0.5) /
         static_cast<double>(width);
}

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

ValidRegion circle(double radius) { return {Eigen::Vector2d::Constant(radius), Eigen::Matrix2d::Identity()}; }

ValidRegion regionOf(const PlaneIrradiance& at, const MetricChoice& choice) {
  if (choice.metric == "circle") return circle(choice.threshold);
  if (choice.metric == "bright") return circle(choice.threshold * at.irradiance);
  double threshold = choice.threshold;
  if (choice.metric == "steep") threshold = std::pow(threshold, 16.0);
  if (choice.metric == "flat") threshold = std::pow(threshold, 1.0 / 16.0);
  return errorEllipse(TangentialHessian<double>{at.hessian}, {at.irradiance}, threshold, choice.ellipse);
}

void requireMetric(const std::vector<std::string>& metrics, const std::string& metric) {
  if (std::ranges::find(metrics, metric) == metrics.end()) {
    throw std::invalid_argument("unknown error metric \"" + metric + "\" of a synthetic field");
  }
}

}  // namespace

PlaneIrradiance bumpyIrradiance(const std::vector<Bump>& bumps, const Eigen::Vector2d& position) {
  PlaneIrradiance sum{1.0, Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()};
  for (const Bump& bump : bumps) {
    const Eigen::Vector2d step = (position - bump.middle) / bump.width;
    const double value = bump.height * std::exp(-0.5 * step.squaredNorm());
    sum.irradiance += value;
    sum.gradient -= value / bump.width * step;
    sum.hessian += value / (bump.width * bump.width) * (step * step.transpose() - Eigen::Matrix2d::Identity());
  }
  return sum;
}

std::vector<Bump> fourBumps() {
  return {{{0.25, 0.3}, 1.0, 0.12}, {{0.7, 0.65}, 2.0, 0.2}, {{0.75, 0.2}, 0.7, 0.08}, {{0.2, 0.8}, -0.4, 0.15}};
}

RecordField bumpyField(std::size_t width, const std::vector<Bump>& bumps) {
  RecordField field;
  field.name = "bumps";
  field.width = width;
  field.height = width;
  const double pixel = 1.0 / static_cast<double>(width);
  for (std::size_t i = 0; i < width * width; ++i) {
    const Eigen::Vector2d position = middleOf(i, width);
    field.pixels.push_back(i);
    field.receivers.push_back({{position(0), position(1), 0.0}, kUp});
    field.faces.push_back(0);
    field.reference.push_back(bumpyIrradiance(bumps, position).irradiance);
    field.pixel_sizes.push_back(pixel);
  }
  field.metrics = {"hessian", "steep", "flat", "circle", "bright"};
  const auto receivers = std::make_shared<const std::vector<Receiver>>(field.receivers);
  field.records = [receivers, pixel, bumps, names = field.metrics](const MetricChoice& choice) {
    requireMetric(names, choice.metric);
    return [receivers, pixel, bumps, choice](std::size_t i) {
      const Receiver& receiver = (*receivers)[i];
      const PlaneIrradiance at = bumpyIrradiance(bumps, receiver.position.head<2>());
      ValidRegion region = regionOf(at, choice);
      region.half_axes = region.half_axes.cwiseMax(choice.smallest_pixels * pixel);
      region.half_axes = region.half_axes.cwiseMin(choice.largest_pixels * pixel);
      CacheRecord record;
      record.receiver = receiver;
      record.irradiance = at.irradiance;
      record.gradient = {at.gradient(0), at.gradient(1), 0.0};
      record.rotational_gradient.setZero();
      record.first_axis = {region.axes(0, 0), region.axes(1, 0), 0.0};
      record.second_axis = {region.axes(0, 1), region.axes(1, 1), 0.0};
      record.half_axes = region.half_axes;
      return record;
    };
  };
  return field;
}

double AffineIrradiance::at(const Receiver& receiver) const {
  return constant + slope.dot(receiver.position) + source.dot(receiver.normal);
}

CacheRecord AffineIrradiance::record(const Receiver& receiver, double radius) const {
  const Eigen::Matrix<double, 3, 2> frame = tangentFrame<double>(receiver.normal);
  CacheRecord record;
  record.receiver = receiver;
  record.irradiance = at(receiver);
  record.gradient = slope;
  record.rotational_gradient = receiver.normal.cross(source);
  record.first_axis = frame.col(0);
  record.second_axis = frame.col(1);
  record.half_axes = Eigen::Vector2d::Constant(radius);
  return record;
}

RecordField capField(std::size_t width, const AffineIrradiance& irradiance) {
  RecordField field;
  field.name = "cap";
  field.width = width;
  field.height = width;
  const double pixel = 2.0 / static_cast<double>(width);
  for (std::size_t i = 0; i < width * width; ++i) {
    const Eigen::Vector2d seen = 2.0 * middleOf(i, width).array() - 1.0;
    const double square = seen.squaredNorm();
    if (square > 0.75) continue;
    const Eigen::Vector3d direction = Eigen::Vector3d(seen(0), seen(1), std::sqrt(1.0 - square)).normalized();
    field.pixels.push_back(i);
    field.receivers.push_back({direction, direction});
    field.faces.push_back(0);
    field.reference.push_back(irradiance.at(field.receivers.back()));
    field.pixel_sizes.push_back(pixel);
  }
  field.metrics = {"circle"};
  const auto receivers = std::make_shared<const std::vector<Receiver>>(field.receivers);
  field.records = [receivers, irradiance, names = field.metrics](const MetricChoice& choice) {
    requireMetric(names, choice.metric);
    return
        [receivers, irradiance, choice](std::size_t i) { return irradiance.record((*receivers)[i], choice.threshold); };
  };
  return field;
}

MetricChoice choiceOf(const std::string& metric, double threshold) {
  MetricChoice choice;
  choice.metric = metric;
  choice.threshold = threshold;
  return choice;
}

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing refused";
}

}  // namespace irradiff::cache_test
