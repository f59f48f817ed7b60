#include "tests/benchmarks/derivative_share_section.h"

#include "derivatives/estimators/mesh_derivatives.h"
#include "derivatives/estimators/triangulated.h"
#include "derivatives/samples/sample_hemisphere.h"
#include "derivatives/samples/sample_mesh.h"
#include "derivatives/samples/strata.h"
#include "experiments/figures/analytic_figure.h"
#include "experiments/figures/estimate_map.h"
#include "experiments/figures/point_estimator.h"
#include "experiments/ray_casting/ray_caster.h"
#include "tests/benchmarks/ratio_reporter.h"

#include <Eigen/Core>
#include <benchmark/benchmark.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <memory>
#include <ostream>
#include <vector>

namespace irradiff {

namespace {

constexpr std::uint64_t kSeed = 2012;
constexpr int kRounds = 11;
constexpr GridShape kShape{64, 64};
/// Along a side of the grid.
constexpr std::size_t kReceivers = 8;

/// Directions at receivers all over the grid, not cast yet.
std::vector<HemisphereSamples> directionsOver(const ReceiverGrid& grid) {
  const Strata strata(Stratification::kConcentric, kShape);
  const auto cast_none = [](const Eigen::Vector3d&) { return RayHit{}; };
  std::vector<HemisphereSamples> records;
  for (std::size_t j = 0; j < grid.height; ++j) {
    for (std::size_t i = 0; i < grid.width; ++i) {
      records.push_back(sampleHemisphere(strata, SamplePattern::kJittered, kSeed, j * grid.width + i,
                                         sampleFrame(grid, i, j), cast_none));
    }
  }
  return records;
}

/// Of one record, all of them being worked on as often as it takes to fill a twentieth of a second.
template <class Work>
double microseconds(std::vector<HemisphereSamples>& records, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  double elapsed = 0.0;
  std::size_t count = 0;
  while (elapsed < 0.05) {
    for (HemisphereSamples& samples : records) work(samples);
    count += records.size();
    elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return 1e6 * elapsed / static_cast<double>(count);
}

/// Of something in each round: its time, and that as a percentage.
struct Cost {
  std::vector<double> times, of_rays, of_gathering;
};

void print(std::ostream& out, const char* what, const Cost& cost) {
  out << std::setw(44) << what << std::setw(30) << spread(cost.times, 1) << std::setw(30) << spread(cost.of_rays, 1)
      << spread(cost.of_gathering, 1) << '\n';
}

}  // namespace

void printDerivativeShareSection(std::ostream& out) {
  const FigureScene scene = readFigureScene(IRRADIFF_SCENE_FOLDER "/figure5.json");
  std::vector<HemisphereSamples> records = directionsOver(withResolution(*scene.scene.grid, kReceivers));
  const RayCaster caster(scene.scene.polygons);
  const SampleMesh mesh(Stratification::kConcentric, kShape, MeshRim::kOpen);
  const std::unique_ptr<Estimator> estimator = makeTriangulated(Stratification::kConcentric, kShape);
  const SamplingPlan plan{Stratification::kConcentric, kShape, SamplePattern::kJittered, kSeed};
  Cost rays, gathering, derivatives, estimates;
  for (int round = 0; round < kRounds; ++round) {
    rays.times.push_back(microseconds(records, [&](HemisphereSamples& samples) {
      caster.from(samples.frame).cast(samples);
      benchmark::DoNotOptimize(samples.radiance.data());
    }));
    gathering.times.push_back(microseconds(records, [&](const HemisphereSamples& samples) {
      const ReceiverRays from_here = caster.from(samples.frame);
      benchmark::DoNotOptimize(gatherSamples(from_here, samples.frame, plan, 0).samples.radiance.data());
    }));
    derivatives.times.push_back(microseconds(records, [&](const HemisphereSamples& s) {
      benchmark::DoNotOptimize(
          meshDerivatives(mesh, {s.direction_t, s.direction_b, s.direction_n, s.inverse_distance, s.radiance}));
    }));
    estimates.times.push_back(
        microseconds(records, [&](const HemisphereSamples& s) { benchmark::DoNotOptimize(estimator->estimate(s)); }));
    for (Cost* cost : {&derivatives, &estimates}) {
      cost->of_rays.push_back(100.0 * cost->times.back() / rays.times.back());
      cost->of_gathering.push_back(100.0 * cost->times.back() / gathering.times.back());
    }
  }
  out << "\nFigure 5, " << records.size() << " receivers of " << kShape.size()
      << " rays, microseconds for a receiver, median (smallest .. largest) over " << kRounds << " rounds\n"
      << std::left << std::setw(44) << "what" << std::setw(30) << "microseconds" << std::setw(30)
      << "% of rays (asked: at most 5)"
      << "% of directions and rays\n";
  print(out, "rays", rays);
  print(out, "directions and rays", gathering);
  print(out, "gradient and Hessian of the mesh", derivatives);
  print(out, "triangulated, irradiance and rotation too", estimates);
  out << std::flush;
}

}  // namespace irradiff
