#include "derivatives/estimators/discontinuity.h"

#include "derivatives/estimators/estimator.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "tests/estimators/convergence_order.h"
#include "tests/estimators/sampled_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {
namespace {

/// A bright square and two dark rectangles in front of it at different heights, as in data/scenes/figure5.json: edges
/// cross in view.
std::vector<Polygon> overlappingPenumbrae() {
  return {parallelogram("emitter", {0.0129, -0.0213, 3.0}, {0.5, 0.0, 0.0}, {0.0, 0.5, 0.0}, 10.0),
          parallelogram("upper", {-0.4546, 0.1589, 1.5}, {0.3027, 0.0, 0.0}, {0.0, 0.552, 0.0}, 0.0),
          parallelogram("lower", {0.1791, -0.1943, 0.9979}, {0.341, 0.1213, 0.0}, {-0.1213, 0.341, 0.0}, 0.0)};
}

std::vector<Polygon> blackSquareInRoom() {
  std::vector<Polygon> scene = room(1.0);
  scene.push_back(parallelogram("square", {0.0, 0.0, 0.5}, {0.35, 0.0, 0.0}, {0.0, 0.35, 0.0}, 0.0));
  return scene;
}

/// Three radiances meet where the occluder's edge passes in front of the border between two panels.
std::vector<Polygon> threeRadiances() {
  return {parallelogram("left panel", {-1.0, 0.1, 2.0}, {1.0, 0.0, 0.0}, {0.0, 1.1, 0.0}, 3.0),
          parallelogram("right panel", {1.0, 0.1, 2.0}, {1.0, 0.0, 0.0}, {0.0, 1.1, 0.0}, 7.0),
          parallelogram("occluder", {0.1, -0.2, 1.0}, {0.4, 0.1, 0.1}, {-0.1, 0.3, 0.05}, 1.0)};
}

RayQuery queryAt(const std::vector<Polygon>& scene, const Eigen::Vector3d& position) {
  return [&scene, position](const Eigen::Vector3d& direction) {
    const Sight sight = look(scene, position, direction);
    return RayHit{sight.inverse_distance, sight.radiance};
  };
}

struct MedianErrors {
  double irradiance, rotational, gradient, tangential_hessian;
};

/// What one value in ten is above. A median does not show what goes wrong at few receivers.
double ninthTenth(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() * 9 / 10];
}

/// Of `estimateAt` relative to `truthAt` over receivers where the truth is not 0.
template <class EstimateAt, class TruthAt>
MedianErrors medianErrors(std::size_t count, double extent, const EstimateAt& estimateAt, const TruthAt& truthAt) {
  std::array<std::vector<double>, 4> errors;
  for (const Eigen::Vector3d& position : receivers(count, extent)) {
    const SceneDerivatives truth = truthAt(position);
    if (truth.gradient.norm() == 0.0) continue;
    const IrradianceEstimate estimate = estimateAt(position);
    const auto relative = [](const auto& value, const auto& true_value) {
      return (value - true_value).norm() / true_value.norm();
    };
    errors[0].push_back(std::abs(estimate.irradiance - truth.irradiance) / truth.irradiance);
    errors[1].push_back(relative(*estimate.rotational_gradient, truth.rotational_gradient));
    errors[2].push_back(relative(*estimate.gradient, truth.gradient));
    errors[3].push_back(relative(*estimate.tangential_hessian, truth.tangentialHessian()));
  }
  EXPECT_GE(errors[0].size(), count / 2);
  std::cout << "at one receiver in ten above: gradient " << ninthTenth(errors[2]) << ", tangential Hessian "
            << ninthTenth(errors[3]) << '\n';
  return {median(errors[0]), median(errors[1]), median(errors[2]), median(errors[3])};
}

MedianErrors medianErrors(const std::vector<Polygon>& scene, std::size_t count, double extent, std::size_t budget) {
  return medianErrors(
      count, extent,
      [&](const Eigen::Vector3d& position) {
        const DiscontinuityEstimate traced = estimateFromDiscontinuities(queryAt(scene, position), budget);
        EXPECT_LE(traced.rays, budget);
        return traced.estimate;
      },
      [&](const Eigen::Vector3d& position) { return trueDerivatives(scene, frameAt(position)); });
}

std::ostream& operator<<(std::ostream& out, const MedianErrors& errors) {
  return out << "median relative errors: irradiance " << errors.irradiance << ", rotational gradient "
             << errors.rotational << ", gradient " << errors.gradient << ", tangential Hessian "
             << errors.tangential_hessian << '\n';
}

/// What is asked for at 4096 rays: 0.002 of the gradient, 0.01 of the Hessian. Of the first derivative with respect to
/// the normal as much as of that with respect to the position, of the irradiance a tenth.
void expectAsAsked(const MedianErrors& errors) {
  std::cout << errors;
  EXPECT_LE(errors.irradiance, 0.0002);
  EXPECT_LE(errors.rotational, 0.002);
  EXPECT_LE(errors.gradient, 0.002);
  EXPECT_LE(errors.tangential_hessian, 0.01);
}

TEST(Discontinuity, FindsDerivativesOfOverlappingPenumbrae) {
  expectAsAsked(medianErrors(overlappingPenumbrae(), 100, 1.2, 4096));
}

TEST(Discontinuity, FindsDerivativesInARoom) { expectAsAsked(medianErrors(blackSquareInRoom(), 100, 0.9, 4096)); }

TEST(Discontinuity, FindsDerivativesWhereThreeRadiancesMeet) {
  expectAsAsked(medianErrors(threeRadiances(), 60, 1.0, 4096));
}

// A bad twin of the truth: the Hessian without the motion of apparent vertices is another by far.
TEST(Discontinuity, CountsTheMotionOfApparentVertices) {
  const std::vector<Polygon> scene = overlappingPenumbrae();
  const SceneEvaluator evaluator(scene);
  const auto gapFilled = [&](const Eigen::Vector3d& position) {
    const Receiver receiver{position, {0.0, 0.0, 1.0}};
    const IrradianceDerivatives<double> d =
        evaluator.evaluate(receiver, evaluator.view(receiver), ApparentVertices::kFixed).derivatives;
    return SceneDerivatives{d.irradiance.value, d.rotational_gradient.value, d.gradient.value, d.hessian.value};
  };
  const MedianErrors errors = medianErrors(
      100, 1.2,
      [&](const Eigen::Vector3d& position) {
        return estimateFromDiscontinuities(queryAt(scene, position), 4096).estimate;
      },
      gapFilled);
  EXPECT_LE(errors.gradient, 0.002);
  EXPECT_GE(errors.tangential_hessian, 0.1);
}

// An edge of 5 mrad between the edges of both occluders: without it the Hessian is (2.9, -0.76; -0.76, -2.9).
TEST(Discontinuity, FindsAShortEdgeThatCutsOffACorner) {
  const std::vector<Polygon> scene = overlappingPenumbrae();
  const Eigen::Vector3d position(0.0463, -1.0471, 0.0);
  const SceneDerivatives truth = trueDerivatives(scene, frameAt(position));
  EXPECT_GE((Eigen::Matrix2d{{2.906, -0.756}, {-0.756, -2.895}} - truth.tangentialHessian()).norm(), 2.0);
  for (const double rotation : {0.0, 0.5, 1.0}) {
    const IrradianceEstimate estimate = estimateFromDiscontinuities(queryAt(scene, position), 4096, rotation).estimate;
    EXPECT_LE((*estimate.gradient - truth.gradient).norm(), 0.002 * truth.gradient.norm()) << rotation;
    EXPECT_LE((*estimate.tangential_hessian - truth.tangentialHessian()).norm(),
              0.01 * truth.tangentialHessian().norm())
        << rotation;
  }
}

// The error falls at least as the square of 1/N, N x N the number of rays.
TEST(Discontinuity, ConvergesInSecondOrder) {
  const std::vector<std::size_t> sides{12, 16, 24, 32};
  std::vector<double> gradient, hessian;
  for (const std::size_t side : sides) {
    const MedianErrors errors = medianErrors(blackSquareInRoom(), 60, 0.9, side * side);
    gradient.push_back(errors.gradient);
    hessian.push_back(errors.tangential_hessian);
  }
  std::cout << "orders: gradient " << convergenceOrder(sides, gradient) << ", Hessian "
            << convergenceOrder(sides, hessian) << '\n';
  EXPECT_GE(convergenceOrder(sides, gradient), 2.0);
  EXPECT_GE(convergenceOrder(sides, hessian), 2.0);
}

TEST(Discontinuity, DoesNotDependOnTheLatticesRotation) {
  const std::vector<Polygon> scene = blackSquareInRoom();
  const Eigen::Vector3d position(0.21, -0.13, 0.0);
  const SceneDerivatives truth = trueDerivatives(scene, frameAt(position));
  for (const double rotation : {0.0, 0.4, 1.3, 5.0}) {
    const IrradianceEstimate estimate = estimateFromDiscontinuities(queryAt(scene, position), 4096, rotation).estimate;
    EXPECT_LE((*estimate.gradient - truth.gradient).norm(), 0.002 * truth.gradient.norm()) << rotation;
    EXPECT_LE((*estimate.tangential_hessian - truth.tangentialHessian()).norm(),
              0.01 * truth.tangentialHessian().norm())
        << rotation;
  }
}

TEST(Discontinuity, GivesNothingForConstantRadiance) {
  const std::vector<Polygon> scene = room(3.0);
  for (const std::size_t budget : {16, 100, 1000}) {
    const DiscontinuityEstimate traced = estimateFromDiscontinuities(queryAt(scene, {0.3, 0.1, 0.0}), budget);
    EXPECT_DOUBLE_EQ(traced.estimate.irradiance, 3.0 * std::numbers::pi);
    EXPECT_EQ(traced.estimate.gradient->norm(), 0.0);
    EXPECT_EQ(traced.estimate.hessian->norm(), 0.0);
    EXPECT_EQ(traced.estimate.rotational_gradient->norm(), 0.0);
    EXPECT_LE(traced.rays, budget);
  }
}

TEST(Discontinuity, NamesABudgetThatIsTooSmall) {
  const std::vector<Polygon> scene = room(1.0);
  try {
    estimateFromDiscontinuities(queryAt(scene, {0.0, 0.0, 0.0}), 15);
    FAIL() << "15 rays were accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("15 rays, must be at least 16"), std::string::npos) << error.what();
  }
}

/// A plane at height 1, dark at y < 0, else brightest around (0.7, 0.5): smooth but for one straight jump.
double smoothRadiance(double x, double y) { return 1.0 + 2.0 / (1.0 + (x - 0.7) * (x - 0.7) + (y - 0.5) * (y - 0.5)); }

RayHit halfPlane(const Eigen::Vector3d& position, const Eigen::Vector3d& direction, bool has_jump) {
  if (direction(2) <= 0.0) return {};
  const Eigen::Vector3d hit = position + direction / direction(2);
  const bool is_dark = has_jump && hit(1) < 0.0;
  return {direction(2), is_dark ? 0.0 : smoothRadiance(hit(0), hit(1))};
}

/// Irradiance from the plane by the midpoint rule in polar strata of the projected hemisphere, cut at the jump.
double halfPlaneIrradiance(const Eigen::Vector3d& position, bool has_jump) {
  constexpr int kAzimuths = 400;
  constexpr int kRings = 2000;
  double sum = 0.0;
  for (int k = 0; k < kAzimuths; ++k) {
    const double azimuth = 2.0 * std::numbers::pi * (k + 0.5) / kAzimuths;
    const double cosine = std::cos(azimuth);
    const double sine = std::sin(azimuth);
    // The plane's distance rho from below the receiver: s = rho^2/(1 + rho^2) is the projected area within.
    const auto along = [&](double from, double to) {
      double part = 0.0;
      for (int j = 0; j < kRings; ++j) {
        const double s = from + (to - from) * (j + 0.5) / kRings;
        const double rho = std::sqrt(s / (1.0 - s));
        part += smoothRadiance(position(0) + rho * cosine, position(1) + rho * sine);
      }
      return part * (to - from) / kRings;
    };
    double from = 0.0;
    double to = 1.0;
    if (has_jump) {
      const double rho = -position(1) / sine;
      const double s = rho * rho / (1.0 + rho * rho);
      const bool is_bright_here = position(1) > 0.0;
      if (rho > 0.0) {
        (is_bright_here ? to : from) = s;
      } else if (!is_bright_here) {
        continue;
      }
    }
    sum += along(from, to);
  }
  return sum * std::numbers::pi / kAzimuths;
}

// Smooth radiance goes over the mesh of the lattice: right to a few percent, where the jump alone would be wrong.
TEST(Discontinuity, AddsWhatRadianceVariesBesideItsJumps) {
  for (const bool has_jump : {false, true}) {
    const Eigen::Vector3d position(0.4, 0.35, 0.0);
    const auto irradianceAt = [&](double x, double y) { return halfPlaneIrradiance({x, y, 0.0}, has_jump); };
    constexpr double kStep = 1e-3;
    const double irradiance = irradianceAt(0.4, 0.35);
    const Eigen::Vector2d gradient((irradianceAt(0.4 + kStep, 0.35) - irradianceAt(0.4 - kStep, 0.35)) / (2.0 * kStep),
                                   (irradianceAt(0.4, 0.35 + kStep) - irradianceAt(0.4, 0.35 - kStep)) / (2.0 * kStep));
    const RayQuery query = [&](const Eigen::Vector3d& direction) { return halfPlane(position, direction, has_jump); };
    const DiscontinuityEstimate traced = estimateFromDiscontinuities(query, 4096);
    EXPECT_LE(traced.rays, 4096U);
    EXPECT_NEAR(traced.estimate.irradiance, irradiance, 0.01 * irradiance) << has_jump;
    EXPECT_LE((traced.estimate.gradient->head<2>() - gradient).norm(), 0.05 * gradient.norm())
        << has_jump << ": " << traced.estimate.gradient->transpose() << " and " << gradient.transpose();
  }
}

/// A square at height 3, brighter towards one corner, in front of nothing: most rays see nothing.
RayHit glowingSquare(const Eigen::Vector3d& position, const Eigen::Vector3d& direction) {
  if (direction(2) <= 0.0) return {};
  const Eigen::Vector3d hit = position + direction * (3.0 / direction(2));
  if (std::abs(hit(0)) > 0.5 || std::abs(hit(1)) > 0.5) return {};
  return {direction(2) / 3.0, 1.0 + hit(0) + 0.3 * hit(1)};
}

/// Irradiance from the square by the midpoint rule over its area.
double glowingSquareIrradiance(const Eigen::Vector3d& position) {
  constexpr int kCells = 400;
  double sum = 0.0;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const Eigen::Vector3d point((i + 0.5) / kCells - 0.5, (j + 0.5) / kCells - 0.5, 3.0);
      const double square = (point - position).squaredNorm();
      sum += (1.0 + point(0) + 0.3 * point(1)) * 9.0 / (square * square);
    }
  }
  return sum / (kCells * kCells);
}

// Constant where most rays are is not constant by parts: rays inside the square once were regions of their own, whose
// boundaries were all lost, and nine tenths of the irradiance with them. As above, right to a few percent.
TEST(Discontinuity, SeesRadianceThatVariesInASmallPartOfTheView) {
  const Eigen::Vector3d position(0.7, 0.2, 0.0);
  constexpr double kStep = 1e-3;
  const auto slope = [&](const Eigen::Vector3d& step) {
    return (glowingSquareIrradiance(position + step) - glowingSquareIrradiance(position - step)) / (2.0 * kStep);
  };
  const double irradiance = glowingSquareIrradiance(position);
  const Eigen::Vector2d gradient(slope({kStep, 0.0, 0.0}), slope({0.0, kStep, 0.0}));
  const auto errorOf = [&](const IrradianceEstimate& estimate) {
    return (estimate.gradient->head<2>() - gradient).norm() / gradient.norm();
  };
  const RayQuery query = [&](const Eigen::Vector3d& direction) { return glowingSquare(position, direction); };
  for (const double rotation : {0.0, 0.3, 0.7}) {
    const IrradianceEstimate estimate = estimateFromDiscontinuities(query, 16384, rotation).estimate;
    std::cout << "rotation " << rotation << ": errors of irradiance "
              << std::abs(estimate.irradiance - irradiance) / irradiance << ", gradient " << errorOf(estimate) << '\n';
    EXPECT_NEAR(estimate.irradiance, irradiance, 0.05 * irradiance);
    EXPECT_LE(errorOf(estimate), 0.05);
  }
}

// A pattern finer than the lattice, whose boundaries cannot be joined rightly, once gave an irradiance of -5 W/m^2.
TEST(Discontinuity, GivesNoIrradianceThatRadianceForbids) {
  for (const int frequency : {1, 2, 5, 7, 30}) {
    const RayQuery query = [&](const Eigen::Vector3d& w) {
      const int column = static_cast<int>(std::floor(frequency * w(0) + 0.3));
      const int row = static_cast<int>(std::floor(frequency * w(1) + 0.1));
      return RayHit{0.5 * w(2), static_cast<double>((3 * column + 5 * row) & 7)};
    };
    for (const std::size_t budget : {16, 64, 155, 400, 1000}) {
      const IrradianceEstimate estimate = estimateFromDiscontinuities(query, budget).estimate;
      EXPECT_GE(estimate.irradiance, 0.0) << frequency << ", " << budget;
      EXPECT_LE(estimate.irradiance, 7.0 * std::numbers::pi) << frequency << ", " << budget;
    }
  }
}

// The unit of length may be any whose derivatives a double holds: squares of distances once were out of range.
TEST(Discontinuity, ScalesWithTheUnitOfLength) {
  const std::vector<Polygon> scene = threeRadiances();
  const RayQuery query = queryAt(scene, {0.1, 0.05, 0.0});
  const IrradianceEstimate expected = estimateFromDiscontinuities(query, 4096).estimate;
  for (const double scale : {0x1p-300, 0x1p-20, 0x1p+20, 0x1p+500}) {
    const RayQuery scaled = [&](const Eigen::Vector3d& direction) {
      RayHit hit = query(direction);
      hit.inverse_distance /= scale;
      return hit;
    };
    const IrradianceEstimate estimate = estimateFromDiscontinuities(scaled, 4096).estimate;
    EXPECT_NEAR(estimate.irradiance, expected.irradiance, 1e-12 * expected.irradiance) << scale;
    EXPECT_LE((*estimate.gradient * scale - *expected.gradient).norm(), 1e-11 * expected.gradient->norm()) << scale;
    EXPECT_LE((*estimate.hessian * scale * scale - *expected.hessian).norm(), 1e-11 * expected.hessian->norm())
        << scale;
  }
}

TEST(Discontinuity, NamesARayThatIsNoNumberOfAView) {
  const auto refusalOf = [](const RayHit& hit) -> std::string {
    try {
      estimateFromDiscontinuities([&](const Eigen::Vector3d&) { return hit; }, 64);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double value : {kNan, kInfinity, -1.0}) {
    EXPECT_NE(refusalOf({value, 1.0}).find("inverse distance"), std::string::npos) << value;
    EXPECT_NE(refusalOf({1.0, value}).find("radiance"), std::string::npos) << value;
  }
  EXPECT_NE(refusalOf({-1.0, 1.0}).find("-1, must be finite and at least 0"), std::string::npos);
  EXPECT_EQ(refusalOf({0.0, 0.0}), "");
}

TEST(Discontinuity, NamesARotationThatIsNotFinite) {
  const std::vector<Polygon> scene = room(1.0);
  try {
    estimateFromDiscontinuities(queryAt(scene, {0.0, 0.0, 0.0}), 64, std::numeric_limits<double>::infinity());
    FAIL() << "was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("rotation of inf rad, must be finite"), std::string::npos) << error.what();
  }
}

TEST(Discontinuity, ThrowsWhatIsBeyondTheRangeOfDouble) {
  const RayQuery query = [](const Eigen::Vector3d& w) { return RayHit{1e300, w(0) > 0.1 ? 1e300 : 0.0}; };
  try {
    estimateFromDiscontinuities(query, 256);
    FAIL() << "was accepted";
  } catch (const std::overflow_error& error) {
    EXPECT_NE(std::string(error.what()).find("inverse distance 1e+300"), std::string::npos) << error.what();
  }
}

TEST(Discontinuity, UsesGivenSamplesBetterThanTheMeshOverThem) {
  const std::vector<Polygon> scene = blackSquareInRoom();
  for (const Stratification stratification : kAllStratifications) {
    const Strata strata = strataOfSize(stratification, 64);
    const auto errorsOf = [&](const char* name) {
      const auto estimator = makeEstimator(name, stratification, strata.shape());
      return medianErrors(
          40, 0.9,
          [&](const Eigen::Vector3d& position) {
            return estimator->estimate(sampleScene(scene, frameAt(position), strata, SamplePlaces::jittered(3)));
          },
          [&](const Eigen::Vector3d& position) { return trueDerivatives(scene, frameAt(position)); });
    };
    const MedianErrors ours = errorsOf("discontinuity");
    const MedianErrors mesh = errorsOf("triangulated-closed");
    std::cout << ours << mesh;
    EXPECT_LE(ours.gradient, 0.5 * mesh.gradient);
    EXPECT_LE(ours.tangential_hessian, 0.5 * mesh.tangential_hessian);
  }
}

TEST(Discontinuity, TakesAnySamples) {
  for (const Stratification stratification : kAllStratifications) {
    const Strata strata = strataOfSize(stratification, 8);
    const auto estimator = makeDiscontinuity(stratification, strata.shape());
    // Every radiance another, hits that coincide, misses.
    HemisphereSamples samples = uniformSamples(strata, 1.0, 1.0);
    for (std::size_t i = 0; i < samples.radiance.size(); ++i) {
      samples.radiance[i] = static_cast<double>((i * 7919) % 101);
      samples.inverse_distance[i] = static_cast<double>((i * 104729) % 5);
    }
    samples.direction_t[1] = samples.direction_t[0];
    samples.direction_b[1] = samples.direction_b[0];
    samples.direction_n[1] = samples.direction_n[0];
    const IrradianceEstimate estimate = estimator->estimate(samples);
    EXPECT_TRUE(std::isfinite(estimate.irradiance));
    EXPECT_TRUE(estimate.gradient->allFinite());
    EXPECT_TRUE(estimate.hessian->allFinite());
    const IrradianceEstimate constant = estimator->estimate(uniformSamples(strata, 2.0, 5.0));
    EXPECT_EQ(constant.gradient->norm(), 0.0);
    EXPECT_EQ(constant.hessian->norm(), 0.0);
  }
}

}  // namespace
}  // namespace irradiff
