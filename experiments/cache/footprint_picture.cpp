#include "experiments/cache/footprint_picture.h"

#include "derivatives/scene/number_text.h"
#include "experiments/cache/irradiance_cache.h"
#include "experiments/figures/colour_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {
namespace {

constexpr Rgb kCircleColour{90, 190, 70};
constexpr Rgb kLongestColour{10, 25, 120};
constexpr Rgb kOutlineColour{0, 0, 0};
constexpr double kFillOpacity = 0.75;
constexpr std::size_t kMostEnlargement = 16;

Rgb mixed(Rgb from, Rgb to, double share) {
  const auto component = [share](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround((1.0 - share) * a + share * b));
  };
  return {component(from.red, to.red), component(from.green, to.green), component(from.blue, to.blue)};
}

Rgb aspectColour(double aspect, double largest_aspect) {
  return mixed(kCircleColour, kLongestColour, std::clamp((aspect - 1.0) / (largest_aspect - 1.0), 0.0, 1.0));
}

/// Receivers between those of the field, as its picture is enlarged.
class EnlargedField {
 public:
  EnlargedField(const RecordField& field, std::size_t enlargement)
      : field_(field), enlargement_(enlargement), receivers_(field.width * field.height, kNone) {
    for (std::size_t i = 0; i < field.pixels.size(); ++i) receivers_[field.pixels[i]] = i;
  }

  std::size_t width() const { return field_.width * enlargement_; }
  std::size_t height() const { return field_.height * enlargement_; }

  /// The receiver of the field whose pixel this is part of.
  std::optional<std::size_t> number(std::size_t column, std::size_t row) const {
    const std::size_t i = receivers_[row / enlargement_ * field_.width + column / enlargement_];
    return i == kNone ? std::nullopt : std::optional(i);
  }

  Receiver receiver(std::size_t column, std::size_t row) const {
    const std::size_t pixel_column = column / enlargement_;
    const std::size_t pixel_row = row / enlargement_;
    const std::size_t i = receivers_[pixel_row * field_.width + pixel_column];
    Receiver result = field_.receivers[i];
    result.position += offset(column) * stepBetween(i, pixel_column, pixel_row, 1, 0) +
                       offset(row) * stepBetween(i, pixel_column, pixel_row, 0, 1);
    return result;
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// From the middle of the pixel, in pixels.
  double offset(std::size_t coordinate) const {
    return (static_cast<double>(coordinate % enlargement_) + 0.5) / static_cast<double>(enlargement_) - 0.5;
  }

  /// From one pixel to the next along a direction, on the face of receiver `i`; 0 if it is alone.
  Eigen::Vector3d stepBetween(std::size_t i, std::size_t column, std::size_t row, std::size_t right,
                              std::size_t down) const {
    const auto neighbour = [&](bool is_before) -> std::size_t {
      const std::size_t before = is_before ? 2 : 0;
      // One more than the coordinates, which would be negative before the first pixel.
      const std::size_t c = column + 1 + right - before * right;
      const std::size_t r = row + 1 + down - before * down;
      if (c < 1 || c > field_.width || r < 1 || r > field_.height) return i;
      const std::size_t j = receivers_[(r - 1) * field_.width + c - 1];
      return j != kNone && field_.faces[j] == field_.faces[i] ? j : i;
    };
    const std::size_t before = neighbour(true);
    const std::size_t after = neighbour(false);
    const double pixels = (before != i ? 1.0 : 0.0) + (after != i ? 1.0 : 0.0);
    return (field_.receivers[after].position - field_.receivers[before].position) / std::max(1.0, pixels);
  }

  const RecordField& field_;
  std::size_t enlargement_;
  std::vector<std::size_t> receivers_;
};

/// Records whose footprints a place is in, ascending, at each pixel of the picture.
std::vector<std::vector<std::size_t>> footprintsOf(const EnlargedField& places, const IrradianceCache& footprints) {
  std::vector<std::vector<std::size_t>> result(places.width() * places.height());
  for (std::size_t row = 0; row < places.height(); ++row) {
    for (std::size_t column = 0; column < places.width(); ++column) {
      if (!places.number(column, row)) continue;
      const Receiver place = places.receiver(column, row);
      for (const std::size_t i : footprints.recordsAround(place.position)) {
        if (weight(footprints.records()[i], place, kDefaultNormalDeviation) > 0.0) {
          result[row * places.width() + column].push_back(i);
        }
      }
    }
  }
  return result;
}

/// Inside a footprint that one of the four neighbours is not in.
bool isOutline(const std::vector<std::vector<std::size_t>>& footprints, std::size_t width, std::size_t pixel) {
  const std::size_t column = pixel % width;
  const auto leaves = [&](bool exists, std::size_t neighbour) {
    return exists && !std::ranges::includes(footprints[neighbour], footprints[pixel]);
  };
  return leaves(column > 0, pixel - 1) || leaves(column + 1 < width, pixel + 1) ||
         leaves(pixel >= width, pixel - width) || leaves(pixel + width < footprints.size(), pixel + width);
}

void requireOptions(const FootprintOptions& options) {
  if (!(options.largest_aspect > 1.0) || std::isinf(options.largest_aspect)) {
    throw std::invalid_argument("the largest aspect of footprints is " + numberText(options.largest_aspect) +
                                ", must be finite and above 1");
  }
  if (options.enlargement < 1 || options.enlargement > kMostEnlargement) {
    throw std::invalid_argument("the enlargement of footprints is " + std::to_string(options.enlargement) +
                                ", must be 1 to " + std::to_string(kMostEnlargement));
  }
}

}  // namespace

MapPicture footprintPicture(const RecordField& field, std::span<const CacheRecord> records,
                            const FootprintOptions& options) {
  requireOptions(options);
  IrradianceCache footprints;
  for (CacheRecord record : records) {
    record.half_axes *= kFootprintShare;
    footprints.add(record);
  }
  const EnlargedField places(field, options.enlargement);
  const std::vector<std::vector<std::size_t>> sets = footprintsOf(places, footprints);

  const auto colourOf = [&](std::size_t i) {
    const Eigen::Vector2d& half_axes = footprints.records()[i].half_axes;
    return aspectColour(half_axes.maxCoeff() / half_axes.minCoeff(), options.largest_aspect);
  };
  const double brightest = std::max(0.0, *std::ranges::max_element(field.reference));
  MapPicture picture{
      "footprints",
      "Records at " + numberText(100.0 * kFootprintShare) + " % of the size of their regions",
      "",
      "Grey: irradiance, linear in the display's brightness. Colours: the longer half-axis over the shorter.",
      RgbImage(places.width(), places.height(), kNoValueColour),
      {barOf("aspect", 1.0, options.largest_aspect,
             [&](double aspect) { return aspectColour(aspect, options.largest_aspect); })}};
  for (std::size_t pixel = 0; pixel < sets.size(); ++pixel) {
    const std::optional<std::size_t> receiver = places.number(pixel % places.width(), pixel / places.width());
    if (!receiver) continue;
    Rgb& colour = picture.image.pixels[pixel];
    const double light = brightest > 0.0 ? std::max(0.0, field.reference[*receiver]) / brightest : 0.0;
    const auto grey = static_cast<std::uint8_t>(std::lround(255.0 * std::pow(light, 1.0 / 2.2)));
    colour = {grey, grey, grey};
    if (sets[pixel].empty()) continue;
    // The newest on top.
    colour = isOutline(sets, places.width(), pixel) ? kOutlineColour
                                                    : mixed(colour, colourOf(sets[pixel].back()), kFillOpacity);
  }
  return picture;
}

}  // namespace irradiff
