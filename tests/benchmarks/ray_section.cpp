#include "tests/benchmarks/ray_section.h"

#include "experiments/io/scene_file.h"
#include "experiments/ray_casting/ray_caster.h"
#include "tests/benchmarks/ratio_reporter.h"
#include "verification/checks/random.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <numbers>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {

namespace {

constexpr std::uint64_t kSeed = 2012;
constexpr int kRounds = 5;
constexpr std::size_t kRays = 4096;

HemisphereSamples samplesAt(const Receiver& receiver) {
  const Eigen::Vector3d tangent = receiver.normal.unitOrthogonal();
  HemisphereSamples samples;
  samples.frame = {receiver.position, tangent, receiver.normal.cross(tangent), receiver.normal};
  KeyedRandom random(kSeed, "rays", 0);
  for (std::size_t i = 0; i < kRays; ++i) {
    const double squared_sine = random.unit();
    const double azimuth = random.between(0.0, 2.0 * std::numbers::pi);
    samples.direction_t.push_back(std::sqrt(squared_sine) * std::cos(azimuth));
    samples.direction_b.push_back(std::sqrt(squared_sine) * std::sin(azimuth));
    samples.direction_n.push_back(std::sqrt(1.0 - squared_sine));
  }
  return samples;
}

/// Squares beside each other in view, at random distances, as many as the hemisphere holds.
std::vector<Polygon> squaresAround(std::size_t count) {
  KeyedRandom random(kSeed, "squares", count);
  std::vector<Polygon> polygons;
  while (polygons.size() < count) {
    Eigen::Vector3d towards = random.direction();
    towards.z() = std::abs(towards.z());
    const double distance = random.between(0.5, 2.0);
    const Eigen::Vector3d u = distance / std::sqrt(static_cast<double>(count)) * towards.unitOrthogonal();
    const Eigen::Vector3d v = towards.cross(u);
    const Eigen::Vector3d centre = distance * towards;
    polygons.push_back({"square", {centre - u - v, centre + u - v, centre + u + v, centre - u + v}, 1.0});
  }
  return polygons;
}

/// Millions of rays in a second.
double raysPerMicrosecond(const RayCaster& caster, HemisphereSamples& samples) {
  constexpr double kLeastSeconds = 0.02;
  const auto start = std::chrono::steady_clock::now();
  double elapsed = 0.0;
  std::size_t rays = 0;
  while (elapsed < kLeastSeconds) {
    caster.from(samples.frame).cast(samples);
    benchmark::DoNotOptimize(samples.radiance.data());
    rays += kRays;
    elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return 1e-6 * static_cast<double>(rays) / elapsed;
}

std::vector<double> rates(const std::vector<Polygon>& polygons, RaySearch search, HemisphereSamples samples) {
  const RayCaster caster(polygons, search);
  std::vector<double> all;
  all.reserve(kRounds);
  for (int round = 0; round < kRounds; ++round) all.push_back(raysPerMicrosecond(caster, samples));
  return all;
}

Scene figureScene() {
  const std::string path = std::string(IRRADIFF_SCENE_FOLDER) + "/figure5.json";
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  return parseScene(std::string(std::istreambuf_iterator<char>(file), {}));
}

}  // namespace

void printRaySection(std::ostream& out) {
  const Scene scene = figureScene();
  const HemisphereSamples at_middle = samplesAt(scene.grid->receiver(scene.grid->width / 2, scene.grid->height / 2));
  out << "\nRays, millions a second on one thread, " << kRays << " from each receiver\n"
      << "figure 5: " << spread(rates(scene.polygons, RaySearch::kAuto, at_middle), 0) << "; asked: 13\n"
      << "polygons  every face                    tree\n";
  const HemisphereSamples at_origin = samplesAt({{0, 0, 0}, {0, 0, 1}});
  for (const std::size_t count : {4U, 16U, 64U, 128U, 256U, 1024U, 4096U}) {
    const std::vector<Polygon> polygons = squaresAround(count);
    out << std::left << std::setw(10) << count << std::setw(30)
        << spread(rates(polygons, RaySearch::kEveryFace, at_origin), 1)
        << spread(rates(polygons, RaySearch::kTree, at_origin), 1) << '\n';
  }
  out << "RayCaster takes the tree above " << kMostPolygonsWithoutTree << " polygons.\n";
}

}  // namespace irradiff
