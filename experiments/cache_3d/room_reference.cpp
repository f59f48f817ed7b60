#include "experiments/cache_3d/room_reference.h"

#include "derivatives/scene/number_text.h"
#include "experiments/cache_3d/direct_light.h"
#include "verification/report/parallel_tasks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace irradiff {

namespace {

constexpr std::array<const char*, 4> kChannels{"E", "gradient.x", "gradient.y", "gradient.z"};

std::string madeFrom(const Room& room, std::size_t width) {
  const SliceSteps steps;
  std::ostringstream text;
  text << "one bounce of " << roomFingerprint(room) << "; " << width << " x " << width
       << " pixels; direct light at nodes every 1/" << kTableNodes << " of the extent; slices: " << steps.distances
       << " distances, " << steps.azimuth << " rad, tolerance " << steps.tolerance << ", gradient "
       << steps.gradient_length;
  return text.str();
}

const std::string* attribute(const ExrImage& image, std::string_view name) {
  const auto found = std::ranges::find(image.attributes, name, &ExrImage::Attribute::name);
  return found == image.attributes.end() ? nullptr : &found->text;
}

const std::vector<double>* channel(const ExrImage& image, std::string_view name) {
  const auto found = std::ranges::find(image.channels, name, &ExrImage::Channel::name);
  return found == image.channels.end() ? nullptr : &found->values;
}

}  // namespace

SliceSteps finerSteps(const SliceSteps& steps) {
  SliceSteps finer = steps;
  finer.distances *= 0.5;
  finer.azimuth *= 0.5;
  finer.tolerance *= 0.1;
  return finer;
}

double referenceError(const Room& room, const SurfaceRadiance& radiance, std::span<const SeenPoint> seen,
                      std::span<const SliceIrradiance> values, std::size_t count, unsigned threads) {
  if (seen.empty()) return 0.0;
  const SliceQuadrature finer(room.polygons, radiance, finerSteps({}));
  const std::size_t stride = std::max<std::size_t>(1, seen.size() / std::max<std::size_t>(1, count));
  std::vector<double> squares((seen.size() + stride - 1) / stride);
  std::vector<std::function<void()>> tasks;
  for (std::size_t k = 0; k < squares.size(); ++k) {
    tasks.emplace_back([&, k] {
      const double difference = values[k * stride].irradiance - finer.at(seen[k * stride].receiver).irradiance;
      squares[k] = difference * difference;
    });
  }
  runTasks(tasks, threads, {});
  return std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) / static_cast<double>(squares.size()));
}

std::filesystem::path referencePath(const std::filesystem::path& folder, const Room& room, std::size_t width) {
  return folder / (room.name + "_" + std::to_string(width) + ".exr");
}

ExrImage referenceImage(const Room& room, std::size_t width, std::span<const SeenPoint> seen,
                        const RoomReference& reference) {
  ExrImage image;
  image.width = width;
  image.height = width;
  for (const char* name : kChannels) {
    image.channels.push_back({name, std::vector<double>(width * width, std::numeric_limits<double>::quiet_NaN())});
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const SliceIrradiance& value = reference.values[i];
    image.channels[0].values[seen[i].pixel] = value.irradiance;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      image.channels[static_cast<std::size_t>(axis) + 1].values[seen[i].pixel] = value.gradient[axis];
    }
  }
  image.attributes = {
      {"made_by", "generate_room_references: irradiance by slices, docs/derivations/slice_quadrature.md"},
      {"made_from", madeFrom(room, width)},
      {"rms_error", numberText(reference.rms_error)}};
  return image;
}

std::optional<RoomReference> readReference(const std::filesystem::path& path, const Room& room, std::size_t width,
                                           std::span<const SeenPoint> seen) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  const ExrImage image = parseExr(std::string{std::istreambuf_iterator<char>(file), {}});
  const std::string* made_from = attribute(image, "made_from");
  const std::string* error = attribute(image, "rms_error");
  if (made_from == nullptr || error == nullptr || *made_from != madeFrom(room, width) || image.width != width ||
      image.height != width) {
    return std::nullopt;
  }
  std::array<const std::vector<double>*, 4> channels{};
  for (std::size_t c = 0; c < channels.size(); ++c) {
    channels[c] = channel(image, kChannels[c]);
    if (channels[c] == nullptr) throw std::runtime_error(path.string() + ": has no channel " + kChannels[c]);
  }
  RoomReference reference;
  reference.rms_error = std::stod(*error);
  for (const SeenPoint& point : seen) {
    const auto value = [&](std::size_t c) { return (*channels[c])[point.pixel]; };
    reference.values.push_back({value(0), {value(1), value(2), value(3)}});
    if (std::isnan(value(0))) throw std::runtime_error(path.string() + ": a pixel that sees a surface has no value");
  }
  return reference;
}

}  // namespace irradiff
