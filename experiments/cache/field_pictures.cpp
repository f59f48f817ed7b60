#include "experiments/cache/field_pictures.h"

#include "derivatives/scene/number_text.h"
#include "experiments/figures/colour_maps.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {
namespace {

template <class ColourAt>
RgbImage imageOfReceivers(const RecordField& field, std::span<const double> values, ColourAt colour_at) {
  if (values.size() != field.receivers.size()) {
    throw std::invalid_argument("a picture of field \"" + field.name + "\" with " + std::to_string(values.size()) +
                                " values, must be one for each of its " + std::to_string(field.receivers.size()) +
                                " receivers");
  }
  RgbImage image(field.width, field.height, kNoValueColour);
  for (std::size_t i = 0; i < values.size(); ++i) image.pixels[field.pixels[i]] = colour_at(values[i]);
  return image;
}

void requireScale(double low, double high) {
  if (!(low < high) || std::isinf(high)) {
    throw std::invalid_argument("the scale of a picture is from " + numberText(low) + " to " + numberText(high) +
                                ", must rise and be finite");
  }
}

}  // namespace

MapPicture irradiancePicture(const RecordField& field, std::span<const double> irradiance, double most) {
  requireScale(0.0, most);
  const auto colour = [most](double value) { return sequentialColour(value / most); };
  return {"irradiance",
          "Irradiance",
          "W/m^2",
          "Linear from 0.",
          imageOfReceivers(field, irradiance, colour),
          {barOf("", 0.0, most, colour)}};
}

MapPicture errorPicture(const RecordField& field, std::span<const double> irradiance, double most) {
  requireScale(0.0, most);
  const double mean = std::accumulate(field.reference.begin(), field.reference.end(), 0.0) /
                      static_cast<double>(field.reference.size());
  std::vector<double> errors(irradiance.begin(), irradiance.end());
  for (std::size_t i = 0; i < std::min(errors.size(), field.reference.size()); ++i) {
    errors[i] = (errors[i] - field.reference[i]) / mean;
  }
  const auto colour = [most](double value) { return divergingColour(value / most); };
  return {"error",
          "Error of the irradiance over its mean",
          "",
          "Linear, red where too bright.",
          imageOfReceivers(field, errors, colour),
          {barOf("", -most, most, colour)}};
}

MapPicture radiusPicture(const RecordField& field, const RecordMaker& records, double low, double high) {
  if (!(low > 0.0)) {
    throw std::invalid_argument("the scale of a picture of radii is from " + numberText(low) + " m, must be positive");
  }
  requireScale(low, high);
  std::vector<double> logs(field.receivers.size());
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const Eigen::Vector2d half_axes = records(i).half_axes;
    logs[i] = 0.5 * (std::log10(half_axes(0)) + std::log10(half_axes(1)));
  }
  // Short numbers at the bar.
  const double lowest = std::floor(100.0 * std::log10(low)) / 100.0;
  const double highest = std::ceil(100.0 * std::log10(high)) / 100.0;
  const auto colour = [lowest, highest](double value) {
    return sequentialColour((value - lowest) / (highest - lowest));
  };
  return {"radius",
          "Geometric mean of the half-axes",
          "log10 m",
          "Linear in the logarithm.",
          imageOfReceivers(field, logs, colour),
          {barOf("", lowest, highest, colour)}};
}

}  // namespace irradiff
