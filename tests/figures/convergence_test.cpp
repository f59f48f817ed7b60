#include "experiments/figures/convergence.h"

#include "experiments/figures/convergence_plots.h"
#include "experiments/figures/view_evaluation.h"
#include "tests/cli/program_run.h"
#include "tests/figures/small_maps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace irradiff {
namespace {

std::vector<Polygon> lampAndScreen() {
  return {{"lamp", {{0.1, 0.2, 1}, {0.9, 0.3, 1}, {0.8, 0.7, 1}, {0.2, 0.9, 1}}, 2.5},
          {"screen", {{0.3, 0.3, 0.5}, {0.6, 0.3, 0.5}, {0.6, 0.7, 0.6}}, 0.0}};
}

constexpr std::size_t kReceivers = 70;
const ConvergencePlan kPlan{{{16, 40, 4}, {256, kReceivers, 3}, {1024, kReceivers, 3}}, 5};

const ConvergenceCurve* curveOf(const std::vector<ConvergenceCurve>& curves, const std::string& label,
                                Compared compared) {
  for (const ConvergenceCurve& curve : curves) {
    if (curve.estimator.label() == label && curve.compared == compared) return &curve;
  }
  return nullptr;
}

bool areEqual(const std::vector<ConvergenceCurve>& a, const std::vector<ConvergenceCurve>& b) {
  return std::ranges::equal(a, b, [](const ConvergenceCurve& x, const ConvergenceCurve& y) {
    return x.estimator.label() == y.estimator.label() &&
           std::ranges::equal(x.points, y.points, [](const ConvergencePoint& p, const ConvergencePoint& q) {
             return p.rays == q.rays && p.compared == q.compared && p.medians == q.medians;
           });
  });
}

// Of a box with a corner at the origin, its share of the receivers less its area, at most, over boxes of a lattice.
TEST(SpreadReceivers, AreSpreadEvenly) {
  const ReceiverGrid grid = unitGrid(2, 2);
  constexpr std::size_t kCount = 1100;
  const std::vector<Receiver> receivers = spreadReceivers(grid, kCount);
  double discrepancy = 0.0;
  for (int i = 1; i <= 20; ++i) {
    for (int j = 1; j <= 20; ++j) {
      const double x = i / 20.0;
      const double y = j / 20.0;
      const auto inside =
          std::ranges::count_if(receivers, [&](const Receiver& r) { return r.position.x() < x && r.position.y() < y; });
      discrepancy = std::max(discrepancy, std::abs(static_cast<double>(inside) / kCount - x * y));
    }
  }
  // Random ones would be off by about 1/sqrt(1100) = 0.03.
  EXPECT_LT(discrepancy, 0.005);
  for (const Receiver& receiver : receivers) {
    EXPECT_EQ(receiver.normal, grid.normal);
    EXPECT_EQ(receiver.position.z(), 0.0);
  }
}

TEST(ShapeForRays, IsTheLargestWithSoManyStrata) {
  using enum Stratification;
  EXPECT_EQ(shapeForRays(kConcentric, 4096), (GridShape{64, 64}));
  EXPECT_EQ(shapeForRays(kConcentric, 4095), (GridShape{63, 63}));
  EXPECT_EQ(shapeForRays(kConcentric, 1), (GridShape{1, 1}));
  EXPECT_EQ(shapeForRays(kPolar, 4096), (GridShape{36, 113}));
  EXPECT_EQ(shapeForRays(kPolar, 2), (GridShape{1, 2}));
  EXPECT_EQ(shapeForRays(kHemicube, 4096), (GridShape{108, 36}));
  EXPECT_EQ(shapeForRays(kHemicube, 12), (GridShape{6, 2}));
  EXPECT_EQ(shapeForRays(kHemicube, 47), (GridShape{6, 2}));
  EXPECT_EQ(shapeForRays(kHemicube, 48), (GridShape{12, 4}));
  for (const std::size_t rays : {16U, 100U, 1156U, 4356U, 65536U}) {
    for (const Stratification stratification : {kConcentric, kPolar, kHemicube}) {
      EXPECT_LE(shapeForRays(stratification, rays).size(), rays);
    }
    // One more would be too many.
    const std::size_t side = shapeForRays(kConcentric, rays).rows + 1;
    EXPECT_GT(side * side, rays);
    const GridShape polar = shapeForRays(kPolar, rays);
    EXPECT_GT(polar.rows * (polar.columns + 1), rays);
    const std::size_t resolution = shapeForRays(kHemicube, rays).columns + 2;
    EXPECT_GT(3 * resolution * resolution, rays);
  }
}

TEST(Convergence, PointsAreMediansOfTheErrorsAtTheReceivers) {
  const std::vector<Polygon> polygons = lampAndScreen();
  const ReceiverGrid grid = unitGrid(4, 4);
  const std::vector<ConvergenceCurve> curves = convergenceCurves(polygons, grid, kPlan, 2, nullptr, 0);
  const ConvergenceCurve* curve = curveOf(curves, "ward-heckbert (polar)", Compared::kGradient);
  ASSERT_NE(curve, nullptr);
  ASSERT_EQ(curve->points.size(), 3U);
  // One of them again, from its parts.
  const std::vector<Receiver> receivers = spreadReceivers(grid, kReceivers);
  const ViewEvaluator evaluate = viewEvaluator(polygons);
  const SamplingPlan sampling{Stratification::kPolar, {9, 28}, SamplePattern::kJittered, 6};
  ASSERT_EQ(curve->points[1].rays, sampling.shape.size());
  const PointEstimator estimator = pointEstimator("ward-heckbert", sampling.stratification, sampling.shape);
  const RayCaster caster(polygons);
  std::vector<double> errors;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const SampleFrame frame{receivers[i].position, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const ReceiverRays rays = caster.from(frame);
    const Eigen::Vector3d found = *estimator(gatherSamples(rays, frame, sampling, i)).gradient;
    const Eigen::Vector3d exact = evaluate(receivers[i]).evaluation.derivatives.gradient.value;
    errors.push_back((found - exact).head<2>().lpNorm<Eigen::Infinity>() / exact.head<2>().lpNorm<Eigen::Infinity>());
  }
  std::ranges::sort(errors);
  EXPECT_EQ(curve->points[0].receivers, 40U);
  EXPECT_EQ(curve->points[0].medians.size(), 4U);
  EXPECT_EQ(curve->points[1].compared, errors.size());
  ASSERT_EQ(curve->points[1].medians.size(), 3U);
  const auto nearest = std::ranges::min(curve->points[1].medians, {},
                                        [&](double median) { return std::abs(median - percentile(errors, 0.5)); });
  EXPECT_NEAR(nearest, percentile(errors, 0.5), 1e-12 * nearest);
  EXPECT_TRUE(std::ranges::is_sorted(curve->points[1].medians));
}

TEST(Convergence, ErrorsFallAndTheirOrderIsTheSlope) {
  const std::vector<ConvergenceCurve> curves = convergenceCurves(lampAndScreen(), unitGrid(4, 4), kPlan, 2, nullptr, 0);
  EXPECT_NE(curveOf(curves, "hemicube", Compared::kGradient), nullptr);
  EXPECT_NE(curveOf(curves, "triangulated", Compared::kHessian), nullptr);
  EXPECT_EQ(curveOf(curves, "ward-heckbert", Compared::kHessian), nullptr) << "it has no Hessian";
  const ConvergenceCurve* curve = curveOf(curves, "ward-heckbert", Compared::kGradient);
  ASSERT_NE(curve, nullptr);
  EXPECT_GT(curve->points[0].low(), curve->points[2].high());
  EXPECT_LE(curve->order.low, curve->order.median);
  EXPECT_LE(curve->order.median, curve->order.high);
  // Two points have enough rays, N = 16 and 32: their slope, within what seeds vary by.
  const double least = std::log2(curve->points[1].low() / curve->points[2].high());
  const double most = std::log2(curve->points[1].high() / curve->points[2].low());
  EXPECT_GE(curve->order.low, least - 1e-12);
  EXPECT_LE(curve->order.high, most + 1e-12);
  EXPECT_GT(curve->order.median, 0.0);
}

TEST(Convergence, DoesNotDependOnThreadsAndGoesOn) {
  const ScratchFolder scratch;
  const std::vector<Polygon> polygons = lampAndScreen();
  const ReceiverGrid grid = unitGrid(4, 4);
  const std::vector<ConvergenceCurve> curves = convergenceCurves(polygons, grid, kPlan, 1, nullptr, 0);
  const TileStore store(scratch.file("work"), "this");
  std::size_t batches = 0;
  EXPECT_TRUE(areEqual(curves, convergenceCurves(polygons, grid, kPlan, 3, &store, 100,
                                                 [&](std::size_t, std::size_t all) { batches = all; })));
  EXPECT_EQ(batches, convergenceTiles(kPlan));
  EXPECT_TRUE(std::filesystem::exists(scratch.file("work") / "tile-100"));
  EXPECT_TRUE(std::filesystem::exists(scratch.file("work") / ("tile-" + std::to_string(99 + batches))));
  std::filesystem::remove(scratch.file("work") / "tile-101");
  EXPECT_TRUE(areEqual(curves, convergenceCurves(polygons, grid, kPlan, 2, &store, 100)));
  EXPECT_FALSE(areEqual(curves, convergenceCurves(polygons, grid, {kPlan.steps, 6}, 2, nullptr, 0)));
}

TEST(Convergence, IsPlotted) {
  const std::vector<ConvergenceCurve> curves = convergenceCurves(lampAndScreen(), unitGrid(4, 4), kPlan, 2, nullptr, 0);
  const std::string plot = convergencePlot(curves, Compared::kHessian);
  EXPECT_THAT(plot, testing::HasSubstr("<svg"));
  EXPECT_THAT(plot, testing::HasSubstr("triangulated-closed"));
  EXPECT_THAT(plot, testing::Not(testing::HasSubstr("ward-heckbert")));
}

}  // namespace
}  // namespace irradiff
