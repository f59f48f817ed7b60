// Scenes of 10,000 polygons, each built so that what is seen of it is known from one or two large ones.

#include "derivatives/form_factor/polygon_evaluation.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "verification/exact_boundary/exact_evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector3d;
using testing::IsEmpty;

using Scene = std::vector<Polygon>;

constexpr std::size_t kTilesAlongSide = 100;
const Vector3d kUp(0.0, 0.0, 1.0);

/// A parallelogram whose tiles' corners are doubles: the sides are 100 times exact steps.
struct Board {
  Vector3d corner;
  Vector3d u_step;
  Vector3d v_step;
  double radiance;

  Vector3d at(double u, double v) const { return corner + u * u_step + v * v_step; }
  Polygon piece(const std::string& name, double u, double v, double size) const {
    return {name, {at(u, v), at(u + size, v), at(u + size, v + size), at(u, v + size)}, radiance};
  }
  Polygon whole() const { return piece("whole", 0.0, 0.0, kTilesAlongSide); }

  /// Tiles of `size` steps, 1 where they leave no gap.
  Scene tiles(double size) const {
    Scene scene;
    for (std::size_t i = 0; i < kTilesAlongSide; ++i) {
      for (std::size_t j = 0; j < kTilesAlongSide; ++j) {
        scene.push_back(piece("tile", static_cast<double>(i), static_cast<double>(j), size));
      }
    }
    return scene;
  }
};

/// All that is claimed of a receiver.
struct Claim {
  IrradianceDerivatives<double> values;
  DerivativeBounds bounds;
};

Claim claimOf(const SceneEvaluation<3>& sum) {
  EXPECT_THAT(sum.no_gradient, IsEmpty());
  EXPECT_THAT(sum.no_hessian, IsEmpty());
  return {sum.derivatives, sum.bounds};
}

/// What polygons that do not hide each other give, each by itself, all of one radiance.
SceneEvaluation<3> sumOf(const Scene& polygons, double radiance, const Receiver& receiver) {
  SceneEvaluation<3> sum = darkScene<3>();
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const PolygonEvaluation polygon = evaluatePolygon(polygons[i], i, receiver);
    addSource(sum, polygon.derivatives, polygon.bounds, radiance);
  }
  return sum;
}

/// The larger of the differences of irradiance, gradient and Hessian, each in units of the sum of both bounds.
double disagreement(const Claim& a, const Claim& b) {
  const auto norm = [](const auto& difference) { return difference.cwiseAbs().maxCoeff(); };
  return std::max(
      {std::abs(a.values.irradiance.value - b.values.irradiance.value) / (a.bounds.irradiance + b.bounds.irradiance),
       norm(a.values.gradient.value - b.values.gradient.value) / (a.bounds.gradient + b.bounds.gradient),
       norm(a.values.hessian.value - b.values.hessian.value) / (a.bounds.hessian + b.bounds.hessian)});
}

/// The time of what it does, on standard output.
template <class Work>
auto timed(const std::string& what, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  auto result = work();
  std::cout << what << ": " << std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()
            << " s\n";
  return result;
}

/// Evaluates a scene at each receiver, and at the first again without the tile in its middle. What `expected` says of a
/// receiver must agree with the one and not with the other.
template <class Expected>
void expectOfScene(const std::string& name, const Scene& scene, const std::vector<Receiver>& receivers,
                   const Expected& expected) {
  const std::string count = name + ", " + std::to_string(scene.size()) + " polygons";
  const SceneEvaluator evaluator = timed(count + ", mesh", [&] { return SceneEvaluator(scene); });
  for (const Receiver& receiver : receivers) {
    const SceneEvaluation<3> sum = timed(count + ", a receiver", [&] { return evaluator.evaluate(receiver); });
    EXPECT_LE(disagreement(claimOf(sum), expected(receiver)), 1.0) << receiver.position.transpose();
  }
  Scene twin = scene;
  twin.erase(twin.begin() + kTilesAlongSide * (kTilesAlongSide + 1) / 2);
  const Receiver& first = receivers.front();
  EXPECT_GT(disagreement(claimOf(SceneEvaluator(twin).evaluate(first)), expected(first)), 1.0);
}

// A lamp in tiles that share their edges is the lamp.
TEST(ManyPolygons, TilesOfALampAreTheLamp) {
  const Board lamp{{-1.5, -1.25, 2.0}, {0.03125, 0.0, 0.00390625}, {0.0, 0.03125, -0.001953125}, 3.0};
  expectOfScene("a lamp in tiles", lamp.tiles(1.0), {{{0.1, 0.2, 0.0}, kUp}, {{-0.7, 0.3, 0.5}, {0.6, 0.0, 0.8}}},
                [&](const Receiver& receiver) { return claimOf(sumOf({lamp.whole()}, lamp.radiance, receiver)); });
}

// A screen in tiles hides what the whole screen hides: its outline crosses the lamp's in view, its inner edges do not
// count. The two polygons are evaluated by exact visibility.
TEST(ManyPolygons, TilesOfAScreenAreTheScreen) {
  const Board screen{{-0.5, -0.75, 1.0}, {0.015625, 0.0, 0.001953125}, {0.00390625, 0.015625, 0.0}, 0.0};
  const Polygon lamp{"lamp", {{-1, -1, 2}, {1.5, -1, 2}, {1.5, 1, 2.25}, {-1, 1, 2.25}}, 3.0};
  Scene scene = screen.tiles(1.0);
  scene.push_back(lamp);
  expectOfScene("a screen in tiles", scene, {{{0.1, 0.2, 0.0}, kUp}, {{-0.3, 0.3, 0.25}, {0.6, 0.0, 0.8}}},
                [&](const Receiver& receiver) {
                  const SceneEvaluation<3> exact = evaluateExactly({lamp, screen.whole()}, receiver);
                  EXPECT_GE(exact.apparent_vertices, 2U);
                  return claimOf(exact);
                });
}

// Screens apart from each other, all in front of the lamp: each takes away its own form factor, whatever is behind it.
TEST(ManyPolygons, ScreensInFrontOfALampTakeAwayTheirFormFactors) {
  const Board board{{-0.75, -0.75, 1.0}, {0.015625, 0.0, 0.001953125}, {0.0, 0.015625, 0.0}, 0.0};
  const Polygon lamp{"lamp", {{-8, -8, 2}, {8, -8, 2}, {8, 8, 2}, {-8, 8, 2}}, 3.0};
  const Scene screens = board.tiles(0.75);
  Scene scene = screens;
  scene.push_back(lamp);
  expectOfScene("screens", scene, {{{0.1, 0.2, 0.0}, kUp}, {{-0.3, 0.1, 0.25}, {0.0, 0.28, 0.96}}},
                [&](const Receiver& receiver) {
                  Claim claim = claimOf(sumOf({lamp}, lamp.radiance, receiver));
                  const Claim hidden = claimOf(sumOf(screens, lamp.radiance, receiver));
                  claim.values.irradiance.value -= hidden.values.irradiance.value;
                  claim.values.gradient.value -= hidden.values.gradient.value;
                  claim.values.hessian.value -= hidden.values.hessian.value;
                  claim.bounds.irradiance += hidden.bounds.irradiance;
                  claim.bounds.gradient += hidden.bounds.gradient;
                  claim.bounds.hessian += hidden.bounds.hessian;
                  return claim;
                });
}

}  // namespace
}  // namespace irradiff
