#include "experiments/figures/scene_picture.h"

#include "experiments/figures/colour_maps.h"
#include "experiments/ray_casting/ray_caster.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace irradiff {
namespace {

constexpr double kElevation = 22.0 * std::numbers::pi / 180.0;
constexpr double kAzimuth = -60.0 * std::numbers::pi / 180.0;
/// In radii of the scene.
constexpr double kDistance = 3.2;
constexpr std::size_t kSamplesAlongPixel = 2;
constexpr Rgb kBackground{232, 236, 241};
constexpr Rgb kDark{52, 62, 80};

struct Camera {
  SampleFrame frame;   ///< t to the left, b upwards, n forwards
  double half_extent;  ///< of the picture, at distance 1

  Eigen::Vector3d direction(double x, double y) const {
    return Eigen::Vector3d(-x * half_extent, y * half_extent, 1.0).normalized();
  }
};

Camera cameraFor(const Scene& scene, const ReceiverGrid& grid) {
  Eigen::AlignedBox3d box;
  for (const double u : {0.0, 1.0}) {
    for (const double v : {0.0, 1.0}) box.extend(Eigen::Vector3d(grid.origin + u * grid.u + v * grid.v));
  }
  for (const Polygon& polygon : scene.polygons) {
    for (const Eigen::Vector3d& vertex : polygon.vertices) box.extend(vertex);
  }
  const double radius = 0.5 * box.diagonal().norm();
  const Eigen::Vector3d aside = std::cos(kAzimuth) * grid.u.normalized() + std::sin(kAzimuth) * grid.v.normalized();
  const Eigen::Vector3d towards = std::cos(kElevation) * aside + std::sin(kElevation) * grid.normal;
  const Eigen::Vector3d forwards = -towards;
  const Eigen::Vector3d up = (grid.normal - grid.normal.dot(forwards) * forwards).normalized();
  return {{box.center() + kDistance * radius * towards, up.cross(forwards), up, forwards},
          1.0 / std::sqrt(kDistance * kDistance - 1.0)};
}

/// The polygons that do not hide the middle of the grid, each known by its radiance: its number from 1.
std::vector<Polygon> visibleOnes(const Scene& scene, const ReceiverGrid& grid, const Camera& camera) {
  const Eigen::Vector3d middle = grid.origin + 0.5 * (grid.u + grid.v) - camera.frame.position;
  const Eigen::Vector3d direction = (camera.frame.axes().transpose() * middle).normalized();
  std::vector<Polygon> kept;
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
    Polygon polygon = scene.polygons[i];
    polygon.radiance = static_cast<double>(i + 1);
    const RayCaster alone(std::array{polygon});
    // By more than what rounding does to one on the grid itself.
    const bool hides = alone.from(camera.frame).cast(direction).inverse_distance * middle.norm() > 1.0 + 1e-9;
    if (!hides) kept.push_back(std::move(polygon));
  }
  return kept;
}

class ScenePainter {
 public:
  ScenePainter(const Scene& scene, const DerivativeMap& map, const Camera& camera)
      : scene_(scene),
        grid_(map.grid),
        irradiance_(map.channel("E").values),
        camera_(camera),
        caster_(visibleOnes(scene, map.grid, camera)),
        rays_(caster_.from(camera.frame)) {
    for (const double value : irradiance_) {
      if (!std::isnan(value)) brightest_ = std::max(brightest_, value);
    }
  }

  Rgb colourAlong(const Eigen::Vector3d& direction) const {
    const RayHit hit = rays_.cast(direction);
    const Eigen::Vector3d ray = camera_.frame.axes() * direction;
    const double depth = grid_.normal.dot(grid_.origin - camera_.frame.position) / grid_.normal.dot(ray);
    if (depth > 0.0 && depth * hit.inverse_distance <= 1.0 + 1e-9) {
      const Eigen::Vector3d offset = camera_.frame.position + depth * ray - grid_.origin;
      const double u = offset.dot(grid_.u) / grid_.u.squaredNorm();
      const double v = offset.dot(grid_.v) / grid_.v.squaredNorm();
      if (u >= 0.0 && u < 1.0 && v >= 0.0 && v < 1.0) return gridColour(u, v);
    }
    if (hit.inverse_distance == 0.0) return kBackground;
    const double radiance = scene_.polygons[static_cast<std::size_t>(hit.radiance) - 1].radiance;
    return radiance > 0.0 ? sequentialColour(0.95) : kDark;
  }

 private:
  Rgb gridColour(double u, double v) const {
    const auto i = static_cast<std::size_t>(u * static_cast<double>(grid_.width));
    const auto j = static_cast<std::size_t>(v * static_cast<double>(grid_.height));
    return sequentialColour(brightest_ > 0.0 ? irradiance_[j * grid_.width + i] / brightest_ : 0.0);
  }

  const Scene& scene_;
  const ReceiverGrid& grid_;
  const std::vector<double>& irradiance_;
  Camera camera_;
  RayCaster caster_;
  ReceiverRays rays_;
  double brightest_ = 0.0;
};

}  // namespace

RgbImage scenePicture(const Scene& scene, const DerivativeMap& map, std::size_t size) {
  const Camera camera = cameraFor(scene, map.grid);
  const ScenePainter painter(scene, map, camera);
  RgbImage image(size, size, kBackground);
  const auto samples = static_cast<double>(kSamplesAlongPixel);
  const auto place = [&](std::size_t pixel, std::size_t sample) {
    return 2.0 * (static_cast<double>(pixel) + (static_cast<double>(sample) + 0.5) / samples) /
               static_cast<double>(size) -
           1.0;
  };
  for (std::size_t row = 0; row < size; ++row) {
    for (std::size_t column = 0; column < size; ++column) {
      std::array<unsigned, 3> sum{};
      for (std::size_t a = 0; a < kSamplesAlongPixel; ++a) {
        for (std::size_t b = 0; b < kSamplesAlongPixel; ++b) {
          const Rgb colour = painter.colourAlong(camera.direction(place(column, a), -place(row, b)));
          sum[0] += colour.red;
          sum[1] += colour.green;
          sum[2] += colour.blue;
        }
      }
      constexpr unsigned kCount = kSamplesAlongPixel * kSamplesAlongPixel;
      const auto mean = [](unsigned total) { return static_cast<std::uint8_t>((total + kCount / 2) / kCount); };
      image.at(column, row) = {mean(sum[0]), mean(sum[1]), mean(sum[2])};
    }
  }
  return image;
}

}  // namespace irradiff
