#include "experiments/curves/placement_pictures.h"

#include "experiments/cache/irradiance_cache.h"
#include "experiments/curves/region_ratios.h"
#include "experiments/figures/colour_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace irradiff {

namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kFootprintShare = 1.0 / 3.0;
constexpr double kLargestRatio = 10.0;
constexpr Rgb kRoundColour{46, 160, 67};
constexpr Rgb kLongestColour{12, 28, 120};

template <class ColourAt>
std::vector<Rgb> colouredPixels(const RecordField& field, const ColourAt& colour_at) {
  std::vector<Rgb> colours(field.width * field.height, kNoValueColour);
  for (std::size_t i = 0; i < field.pixels.size(); ++i) colours[field.pixels[i]] = colour_at(i);
  return colours;
}

template <class ColourAt>
ColourBar barFrom(double low, double high, const ColourAt& colour_at) {
  return barOf("", low, high, colour_at);
}

Rgb blended(const Rgb& from, const Rgb& to, double t) {
  const auto part = [t](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround(static_cast<double>(a) * (1.0 - t) + static_cast<double>(b) * t));
  };
  return {part(from.red, to.red), part(from.green, to.green), part(from.blue, to.blue)};
}

Rgb aspectColour(double aspect, double largest_aspect) {
  const double t = largest_aspect > 1.0 ? std::clamp((aspect - 1.0) / (largest_aspect - 1.0), 0.0, 1.0) : 0.0;
  return blended(kRoundColour, kLongestColour, t);
}

double aspectOf(const RecordField& field, const CacheRecord& record) {
  if (field.height == 1) return 1.0;
  const double low = record.half_axes.minCoeff();
  const double high = record.half_axes.maxCoeff();
  return std::isinf(low) ? 1.0 : high / low;
}

/// The record on the receiver's face in whose footprint it is deepest; nothing outside all of them.
std::optional<std::size_t> deepestFootprint(const RecordField& field, const Placement& placement,
                                            const IrradianceCache& cache, std::size_t receiver) {
  std::optional<std::size_t> deepest;
  double least = kFootprintShare;
  for (const std::size_t r : cache.recordsAround(field.receivers[receiver].position)) {
    if (field.faces[placement.record_receivers[r]] != field.faces[receiver]) continue;
    const double distance = translationalDistance(placement.records[r], field.receivers[receiver].position);
    if (distance < least) {
      least = distance;
      deepest = r;
    }
  }
  return deepest;
}

}  // namespace

RgbImage shownImage(const RecordField& field, const std::vector<Rgb>& colours) {
  const std::size_t rows = field.height == 1 ? kStripRows : field.height;
  RgbImage image(field.width, rows, kNoValueColour);
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < field.width; ++i) {
      image.at(i, j) = colours[field.height == 1 ? i : j * field.width + i];
    }
  }
  return image;
}

double amountLimit(const std::vector<double>& values, double share) {
  MapChannel channel;
  channel.values = values;
  for (double& value : channel.values) value = std::isfinite(value) ? value : kNoNumber;
  const std::array<const MapChannel*, 1> channels{&channel};
  return limitOf(channels, share).value;
}

MapPicture amountPicture(const RecordField& field, const std::vector<double>& values, const std::string& name,
                         const std::string& title, const std::string& unit, double limit) {
  const auto colour = [limit](double value) { return sequentialColour(value / limit); };
  return {name,
          title,
          unit,
          "Linear from 0; what is beyond has the colour of the limit.",
          shownImage(field, colouredPixels(field, [&](std::size_t i) { return colour(values[i]); })),
          {barFrom(0.0, limit, colour)}};
}

MapPicture radiusPicture(const RecordField& field, const std::vector<double>& radii, double low, double high) {
  const auto colour = [low, high](double logarithm) {
    return sequentialColour((logarithm - std::log10(low)) / (std::log10(high) - std::log10(low)));
  };
  return {"radii",
          "log10 of the geometric mean of the half-axes, of the record that each receiver would make",
          "log10 m",
          "Linear in the logarithm; what is beyond has the colour of the limit.",
          shownImage(field, colouredPixels(field, [&](std::size_t i) { return colour(std::log10(radii[i])); })),
          {barFrom(std::log10(low), std::log10(high), colour)}};
}

MapPicture ratioPicture(const RecordField& field, const std::vector<double>& ratios, const std::string& name,
                        const std::string& title) {
  const double limit = std::log10(kLargestRatio);
  const auto colour = [limit](double logarithm) { return divergingColour(logarithm / limit); };
  return {name,
          title,
          "log10",
          "Linear in the logarithm: white at 1, red above, blue below; what is beyond has the colour of the limit.",
          shownImage(field, colouredPixels(field,
                                           [&](std::size_t i) {
                                             return std::isnan(ratios[i]) ? kNoValueColour
                                                                          : colour(std::log10(ratios[i]));
                                           })),
          {barFrom(-limit, limit, colour)}};
}

MapPicture footprintPicture(const RecordField& field, const Placement& placement, double largest_aspect) {
  IrradianceCache cache;
  for (const CacheRecord& record : placement.records) cache.add(record);
  const double limit = amountLimit(field.reference);
  const auto grey = [&](std::size_t i) {
    const double value = std::clamp(field.reference[i] / limit, 0.0, 1.0);
    const auto level = static_cast<std::uint8_t>(std::lround(255.0 * std::pow(value, 1.0 / 2.2)));
    return Rgb{level, level, level};
  };
  std::vector<Rgb> colours = colouredPixels(field, [&](std::size_t i) {
    const std::optional<std::size_t> record = deepestFootprint(field, placement, cache, i);
    return record ? aspectColour(aspectOf(field, placement.records[*record]), largest_aspect) : grey(i);
  });
  for (std::size_t r = 0; r < placement.records.size(); ++r) {
    colours[field.pixels[placement.record_receivers[r]]] =
        aspectColour(aspectOf(field, placement.records[r]), largest_aspect);
  }
  const auto colour = [largest_aspect](double aspect) { return aspectColour(aspect, largest_aspect); };
  return {"footprints",
          "records, their regions drawn at a third of their size, over the irradiance",
          "longer half-axis over the shorter",
          "Green is round, dark blue as long as the limit allows.",
          shownImage(field, colours),
          {barFrom(1.0, std::max(largest_aspect, 1.0 + 1e-9), colour)}};
}

std::vector<double> relativeErrors(const RecordField& field, const std::vector<double>& irradiance) {
  double mean = 0.0;
  for (const double value : field.reference) mean += value / static_cast<double>(field.reference.size());
  std::vector<double> errors(irradiance.size());
  for (std::size_t i = 0; i < errors.size(); ++i) errors[i] = std::abs(irradiance[i] - field.reference[i]) / mean;
  return errors;
}

std::vector<double> allRadii(const RecordField& field, const RecordMaker& records) {
  std::vector<double> radii(field.receivers.size());
  for (std::size_t i = 0; i < radii.size(); ++i) radii[i] = radiusOf(field, records(i));
  return radii;
}

}  // namespace irradiff
