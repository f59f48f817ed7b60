#include "tests/benchmarks/benchmark_inputs.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

namespace irradiff {

namespace {

/// Enough that no branch predictor learns them by heart, few enough to stay in the cache.
constexpr std::size_t kPolygons = 256;
constexpr std::uint64_t kSeed = 2012;

/// A uniform number in [low, high). Not std::uniform_real_distribution, which differs between standard libraries.
double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

}  // namespace

BenchmarkInputs benchmarkInputs(std::size_t edges, SourceSize size) {
  std::mt19937_64 random(kSeed);
  const double radius = size == SourceSize::kLarge ? 1.0 : 0.001;
  BenchmarkInputs inputs{{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()}, {}};
  for (std::size_t i = 0; i < kPolygons; ++i) {
    // Tilted by less than the angle at which the polygon would be seen edge-on or reach the horizon.
    const Eigen::Vector3d centre(uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5), uniform(random, 1.5, 2.5));
    const Eigen::Vector3d tilt(uniform(random, -0.3, 0.3), uniform(random, -0.3, 0.3), 1.0);
    const Eigen::Vector3d u = tilt.cross(Eigen::Vector3d::UnitX()).normalized();
    const Eigen::Vector3d v = tilt.cross(u).normalized();
    const double phase = uniform(random, 0.0, 2.0 * std::numbers::pi);
    Polygon polygon{std::to_string(i), {}, 1.0};
    for (std::size_t k = 0; k < edges; ++k) {
      const double angle = phase + 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(edges);
      polygon.vertices.push_back(centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
    inputs.polygons.push_back(polygon);
  }
  return inputs;
}

}  // namespace irradiff
