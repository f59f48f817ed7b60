#include "derivatives/error_metric/epipolar_slices.h"
#include "derivatives/error_metric/harmonic_mean_distance.h"
#include "derivatives/estimators/estimator.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "experiments/figures/analytic_figure.h"
#include "experiments/figures/point_estimator.h"
#include "experiments/ray_casting/ray_caster.h"
#include "verification/checks/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr GridShape kShape{64, 64};
constexpr std::uint64_t kSeed = 7;
constexpr std::size_t kReceivers = 60;
constexpr std::size_t kAzimuths = 8;  ///< of half a turn
constexpr std::array<double, 6> kSteps{0.05, 0.1, 0.2, 0.35, 0.7, 1.0};
constexpr double kFarStep = 0.35;

/// Sums of squares over receivers and directions at one step.
struct Squares {
  double remainder = 0.0;  ///< E(x + d) - E(x) - grad E.d, exact
  // What is predicted for it less the remainder.
  double reprojection = 0.0, exact_hessian = 0.0, sampled_hessian = 0.0;

  double share(double squares) const { return std::sqrt(squares / remainder); }
};

double square(double x) { return x * x; }

/// At random receivers of the scene's grid, in steps of 16 directions; shares of `length`, or of each receiver's
/// harmonic mean distance if that is 0. Steps beyond the grid are left out.
std::array<Squares, kSteps.size()> errorsIn(const std::string& name, double length) {
  const FigureScene figure = readFigureScene("data/scenes/" + name + ".json");
  const ReceiverGrid& grid = *figure.scene.grid;
  const SceneEvaluator exact(figure.scene.polygons);
  const RayCaster caster(figure.scene.polygons);
  const Strata strata(Stratification::kConcentric, kShape);
  const std::unique_ptr<Estimator> triangulated = makeEstimator("triangulated", Stratification::kConcentric, kShape);
  std::vector<EpipolarGrid> grids;
  for (std::size_t k = 0; k < kAzimuths; ++k) {
    grids.emplace_back(strata, std::numbers::pi * static_cast<double>(k) / kAzimuths);
  }
  std::array<Squares, kSteps.size()> result{};
  KeyedRandom random(kSeed, name, 0);
  for (std::size_t n = 0; n < kReceivers; ++n) {
    const Vector3d position = grid.origin + random.unit() * grid.u + random.unit() * grid.v;
    const Eigen::Matrix<double, 3, 2> tangents = tangentFrame<double>(grid.normal);
    const SampleFrame frame{position, tangents.col(0), tangents.col(1), grid.normal};
    const ReceiverRays rays = caster.from(frame);
    const HemisphereSamples samples =
        gatherSamples(rays, frame, {Stratification::kConcentric, kShape, SamplePattern::kJittered, kSeed}, n).samples;
    const double unit = length > 0.0 ? length : harmonicMeanDistance(samples, strata);
    const Eigen::Matrix2d sampled_hessian = *triangulated->estimate(samples).tangential_hessian;
    const SceneEvaluation<3> here = exact.evaluate({position, grid.normal});
    const Vector2d gradient = tangents.transpose() * here.derivatives.gradient.value;
    const Eigen::Matrix2d hessian = here.derivatives.tangential_hessian.value;
    for (const EpipolarGrid& cells : grids) {
      EpipolarSlices slices;
      slices.fill(cells, samples, unit);
      const auto azimuth = static_cast<double>(&cells - grids.data()) * std::numbers::pi / kAzimuths;
      for (const double sign : {1.0, -1.0}) {
        for (std::size_t m = 0; m < kSteps.size(); ++m) {
          const Vector2d step = sign * kSteps[m] * unit * Vector2d(std::cos(azimuth), std::sin(azimuth));
          const Vector3d there = position + tangents * step;
          const double along = (there - grid.origin).dot(grid.u) / grid.u.squaredNorm();
          const double across = (there - grid.origin).dot(grid.v) / grid.v.squaredNorm();
          if (!(along > 0.0 && along < 1.0 && across > 0.0 && across < 1.0)) continue;
          const double remainder = exact.evaluate({there, grid.normal}).derivatives.irradiance.value -
                                   here.derivatives.irradiance.value - gradient.dot(step);
          const double reprojected =
              slices.irradiance(sign * kSteps[m]) - slices.irradiance(0.0) - sign * kSteps[m] * slices.slope();
          Squares& sums = result[m];
          sums.remainder += square(remainder);
          sums.reprojection += square(reprojected - remainder);
          sums.exact_hessian += square(0.5 * step.dot(hessian * step) - remainder);
          sums.sampled_hessian += square(0.5 * step.dot(sampled_hessian * step) - remainder);
        }
      }
    }
  }
  return result;
}

/// The bad twins are the Hessians: what they predict far away is as wrong as it is large.
TEST(ReprojectionQuality, PredictsChangesFarAwayBetterThanAHessian) {
  std::printf("RMS error of what is predicted for E(x + d) - E(x) - grad E.d, over the RMS of that\n");
  for (const auto& [name, length] :
       {std::pair{"figure5", 1.0}, {"three_tilted_occluders", 1.0}, {"cornell_box", 0.0}}) {
    const std::array<Squares, kSteps.size()> steps = errorsIn(name, length);
    std::printf("%s, steps in %s\n%8s%14s%14s%14s\n", name, length > 0.0 ? "m" : "harmonic mean distances", "step",
                "reprojection", "exact H", "triangulated");
    for (std::size_t m = 0; m < kSteps.size(); ++m) {
      const Squares& s = steps[m];
      std::printf("%8.2f%14.3f%14.3f%14.3f\n", kSteps[m], s.share(s.reprojection), s.share(s.exact_hessian),
                  s.share(s.sampled_hessian));
      if (kSteps[m] < kFarStep) continue;
      EXPECT_LT(s.reprojection, s.exact_hessian) << name << ' ' << kSteps[m];
      EXPECT_LT(s.reprojection, s.sampled_hessian) << name << ' ' << kSteps[m];
      EXPECT_LT(s.share(s.reprojection), 1.0) << name << ' ' << kSteps[m];
    }
  }
}

}  // namespace
}  // namespace irradiff
