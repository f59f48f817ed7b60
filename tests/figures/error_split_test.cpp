#include "experiments/figures/error_split.h"

#include "derivatives/samples/sample_hemisphere.h"
#include "experiments/figures/convergence_plots.h"
#include "tests/cli/program_run.h"
#include "tests/figures/small_maps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace irradiff {
namespace {

std::vector<Polygon> lampAndScreen() {
  return {{"lamp", {{0.1, 0.2, 1}, {0.9, 0.3, 1}, {0.8, 0.7, 1}, {0.2, 0.9, 1}}, 2.5},
          {"screen", {{0.3, 0.3, 0.5}, {0.6, 0.3, 0.5}, {0.6, 0.7, 0.6}}, 0.0}};
}

const ConvergencePlan kPlan{{{64, 30, 6}, {1024, 70, 6}}, 3};

const ErrorSplitCurve& curveOf(const std::vector<ErrorSplitCurve>& curves, const std::string& name, Compared compared) {
  return *std::ranges::find_if(
      curves, [&](const ErrorSplitCurve& curve) { return curve.estimator == name && curve.compared == compared; });
}

TEST(ErrorSplit, HalfATurnTakesSamplesToTheirStrata) {
  const std::vector<Polygon> polygons = lampAndScreen();
  const SampleFrame frame{{0.4, 0.6, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const SampleFrame turned_frame{{0.4, 0.6, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  const RayCaster caster(polygons);
  const ReceiverRays rays = caster.from(frame);
  const ReceiverRays turned_rays = caster.from(turned_frame);
  for (const std::size_t side : {5U, 8U}) {
    const Strata strata(Stratification::kConcentric, {side, side});
    const HemisphereSamples turned =
        halfTurned(sampleHemisphere(strata, SamplePattern::kJittered, 1, 2, frame, rays.query()));
    for (std::size_t i = 0; i < side * side; ++i) {
      const StratumPosition position = strata.position(turned.direction(i));
      EXPECT_EQ(position.row * side + position.column, i);
      // And they see what is there in the turned frame.
      const RayHit hit = turned_rays.cast(turned.direction(i));
      EXPECT_EQ(turned.radiance[i], hit.radiance);
      EXPECT_NEAR(turned.inverse_distance[i], hit.inverse_distance, 1e-14);
    }
  }
}

TEST(ErrorSplit, RoundingIsSmallAndTheRestMakesTheWhole) {
  const std::vector<ErrorSplitCurve> curves = errorSplits(lampAndScreen(), unitGrid(4, 4), kPlan, 2, nullptr, 0);
  for (const ErrorSplitCurve& curve : curves) {
    ASSERT_EQ(curve.points.size(), 2U);
    for (const ErrorSplitPoint& point : curve.points) {
      const SplitError& m = point.medians;
      SCOPED_TRACE(curve.estimator + ' ' + quantityOf(curve.compared).name + ' ' + std::to_string(point.rays));
      if (castsItsOwn(curve.estimator)) {
        EXPECT_TRUE(std::isnan(m.rounding));
        continue;
      }
      // A sum of n terms in reverse: 2^-53 each, and the sum of magnitudes is not much more than the sum itself.
      EXPECT_LT(m.rounding, 1e-12);
      // Without noise the seeds agree, and the error is that of their mean; so neither part is much more than the
      // whole.
      EXPECT_GT(m.total, 0.3 * m.noise);
      EXPECT_LT(m.total, 3.0 * (m.noise + m.discretisation));
    }
  }
  // The noise of jittered samples falls with their number.
  const ErrorSplitCurve& gradient = curveOf(curves, "ward-heckbert", Compared::kGradient);
  EXPECT_LT(gradient.points[1].medians.noise, gradient.points[0].medians.noise);
  // What ignores occlusion stays wrong however many rays there are, and not for noise.
  const SplitError& radiometric = curveOf(curves, "radiometric", Compared::kHessian).points[1].medians;
  EXPECT_GT(radiometric.discretisation, 3.0 * radiometric.noise);
}

TEST(ErrorSplit, DoesNotDependOnThreadsAndGoesOn) {
  const ScratchFolder scratch;
  const TileStore store(scratch.file("work"), "this");
  const auto totals = [&](unsigned threads, const TileStore* finished) {
    std::vector<double> all;
    for (const ErrorSplitCurve& curve : errorSplits(lampAndScreen(), unitGrid(4, 4), kPlan, threads, finished, 5)) {
      for (const ErrorSplitPoint& point : curve.points) {
        all.insert(all.end(), {point.medians.total, point.medians.noise, point.medians.discretisation});
      }
    }
    return all;
  };
  const std::vector<double> expected = totals(1, nullptr);
  EXPECT_EQ(totals(3, &store), expected);
  std::size_t tiles = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scratch.file("work"))) {
    tiles += entry.path().filename().string().starts_with("tile-") ? 1 : 0;
  }
  EXPECT_EQ(tiles, errorSplitTiles(kPlan));
  EXPECT_EQ(totals(2, &store), expected);
}

TEST(ErrorSplit, IsPlottedWithAPanelForEachEstimator) {
  const std::vector<ErrorSplitCurve> curves = errorSplits(lampAndScreen(), unitGrid(4, 4), kPlan, 2, nullptr, 0);
  const std::string plot = errorSplitPlot(curves, Compared::kHessian);
  for (const char* text : {"<svg", "triangulated-closed", "geometric", "discretisation", "rounding"}) {
    EXPECT_THAT(plot, testing::HasSubstr(text));
  }
  EXPECT_THAT(plot, testing::Not(testing::HasSubstr("ward-heckbert")));
}

}  // namespace
}  // namespace irradiff
