#include "tests/benchmarks/derivative_share_section.h"

#include "derivatives/estimators/mesh_derivatives.h"
#include "derivatives/estimators/triangulated.h"
#include "derivatives/samples/sample_hemisphere.h"
#include "derivatives/samples/sample_mesh.h"
#include "derivatives/samples/strata.h"
#include "experiments/figures/analytic_figure.h"
#include "experiments/figures/estimate_map.h"
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

}  // namespace

void printDerivativeShareSection(std::ostream& out) {
  const FigureScene scene = readFigureScene(IRRADIFF_SCENE_FOLDER "/figure5.json");
  std::vector<HemisphereSamples> records = directionsOver(withResolution(*scene.scene.grid, kReceivers));
  const RayCaster caster(scene.scene.polygons);
  const SampleMesh mesh(Stratification::kConcentric, kShape, MeshRim::kOpen);
  const std::unique_ptr<Estimator> estimator = makeTriangulated(Stratification::kConcentric, kShape);
  std::vector<double> rays, derivatives, estimates, derivative_shares, estimate_shares;
  for (int round = 0; round < kRounds; ++round) {
    rays.push_back(microseconds(records, [&](HemisphereSamples& samples) {
      caster.from(samples.frame).cast(samples);
      benchmark::DoNotOptimize(samples.radiance.data());
    }));
    derivatives.push_back(microseconds(records, [&](const HemisphereSamples& s) {
      benchmark::DoNotOptimize(
          meshDerivatives(mesh, {s.direction_t, s.direction_b, s.direction_n, s.inverse_distance, s.radiance}));
    }));
    estimates.push_back(
        microseconds(records, [&](const HemisphereSamples& s) { benchmark::DoNotOptimize(estimator->estimate(s)); }));
    derivative_shares.push_back(100.0 * derivatives.back() / rays.back());
    estimate_shares.push_back(100.0 * estimates.back() / rays.back());
  }
  out << "\nFigure 5, " << records.size() << " receivers of " << kShape.size()
      << " rays, microseconds for a receiver, median (smallest .. largest) over " << kRounds << " rounds\n"
      << std::left << std::setw(44) << "what" << std::setw(30) << "microseconds"
      << "% of the rays' time (asked: at most 5)\n"
      << std::setw(44) << "rays" << spread(rays, 1) << '\n'
      << std::setw(44) << "gradient and Hessian of the mesh" << std::setw(30) << spread(derivatives, 1)
      << spread(derivative_shares, 2) << '\n'
      << std::setw(44) << "triangulated, irradiance and rotation too" << std::setw(30) << spread(estimates, 1)
      << spread(estimate_shares, 2) << '\n'
      << std::flush;
}

}  // namespace irradiff
