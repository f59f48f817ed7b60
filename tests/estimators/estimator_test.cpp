// The catalogue, and what holds for every estimator in it: units, turned worlds, misses, near hits, small grids.

#include "derivatives/estimators/estimator.h"

#include "tests/estimators/sampled_scene.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

namespace irradiff {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

std::string refusalOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

bool takesHemicubesOnly(std::string_view name) { return name == "hemicube" || name == "hemicube-texel"; }

/// Every estimator with every stratification that it takes.
void forEachEstimator(const std::function<void(std::string_view, Stratification)>& check) {
  for (const EstimatorDescription& description : estimatorDescriptions()) {
    for (const Stratification stratification : kAllStratifications) {
      if (takesHemicubesOnly(description.name) && stratification != Stratification::kHemicube) continue;
      SCOPED_TRACE(std::string(description.name) + ", stratification " +
                   std::to_string(static_cast<int>(stratification)));
      check(description.name, stratification);
    }
  }
}

IrradianceEstimate estimateOf(std::string_view name, const HemisphereSamples& samples) {
  return makeEstimator(name, samples.stratification, samples.shape)->estimate(samples);
}

bool isFinite(const IrradianceEstimate& e) {
  return std::isfinite(e.irradiance) && (!e.rotational_gradient || e.rotational_gradient->allFinite()) &&
         (!e.gradient || e.gradient->allFinite()) && (!e.hessian || e.hessian->allFinite()) &&
         (!e.tangential_hessian || e.tangential_hessian->allFinite());
}

/// An occluder between a receiver in a room and one of its walls; the surfaces differ in radiance.
std::vector<Polygon> furnishedRoom() {
  std::vector<Polygon> scene = room(1.0);
  for (std::size_t i = 0; i < scene.size(); ++i) scene[i].radiance = 0.5 + static_cast<double>(i);
  scene.push_back(parallelogram("table", {0.2, 0.1, 0.7}, {0.35, 0.1, 0.0}, {-0.1, 0.3, 0.1}, 0.2));
  return scene;
}

HemisphereSamples roomSamples(Stratification stratification, std::size_t size = 16) {
  return sampleScene(furnishedRoom(), frameAt({0.2, -0.3, 0.0}), strataOfSize(stratification, size),
                     SamplePlaces::jittered(11));
}

testing::AssertionResult isClose(const IrradianceEstimate& e, const IrradianceEstimate& expected, double relative) {
  testing::AssertionResult failure = testing::AssertionFailure();
  bool agrees = true;
  const auto compare = [&](const char* what, const auto& value, const auto& reference) {
    if (value.has_value() != reference.has_value()) {
      agrees = false;
      failure << what << " exists only in one; ";
    } else if (value && !((*value - *reference).norm() <= relative * reference->norm())) {
      agrees = false;
      failure << what << "\n" << *value << "\nexpected\n" << *reference << '\n';
    }
  };
  using Number = Eigen::Matrix<double, 1, 1>;
  compare("irradiance", std::optional(Number(e.irradiance)), std::optional(Number(expected.irradiance)));
  compare("rotational gradient", e.rotational_gradient, expected.rotational_gradient);
  compare("gradient", e.gradient, expected.gradient);
  compare("Hessian", e.hessian, expected.hessian);
  compare("tangential Hessian", e.tangential_hessian, expected.tangential_hessian);
  return agrees ? testing::AssertionSuccess() : failure;
}

using EstimateOf = std::function<IrradianceEstimate(const HemisphereSamples&)>;

EstimateOf byName(std::string_view name) {
  return [name](const HemisphereSamples& samples) { return estimateOf(name, samples); };
}

/// The same scene in another unit of length gives the same in that unit.
testing::AssertionResult scalesWithLength(const EstimateOf& estimate, const HemisphereSamples& samples, double scale) {
  HemisphereSamples scaled = samples;
  for (double& inverse_distance : scaled.inverse_distance) inverse_distance /= scale;
  IrradianceEstimate expected = estimate(samples);
  if (expected.gradient) *expected.gradient /= scale;
  if (expected.hessian) *expected.hessian /= scale * scale;
  if (expected.tangential_hessian) *expected.tangential_hessian /= scale * scale;
  // Sums of products of rounded distances: 2000 terms that partly cancel.
  return isClose(estimate(scaled), expected, 1e-11);
}

/// The scene and the frame turned together give the same in the frame.
testing::AssertionResult turnsWithTheWorld(const EstimateOf& estimate, Stratification stratification) {
  const Matrix3d turn = Eigen::AngleAxisd(1.1, Vector3d(2.0, 3.0, 6.0) / 7.0).toRotationMatrix();
  std::vector<Polygon> turned_scene = furnishedRoom();
  for (Polygon& polygon : turned_scene) {
    for (Vector3d& corner : polygon.vertices) corner = turn * corner;
  }
  const SampleFrame frame = frameAt({0.2, -0.3, 0.0});
  const SampleFrame turned{turn * frame.position, turn * frame.tangent, turn * frame.bitangent, turn * frame.normal};
  const Strata strata = strataOfSize(stratification, 16);
  return isClose(estimate(sampleScene(turned_scene, turned, strata, SamplePlaces::jittered(11))),
                 estimate(sampleScene(furnishedRoom(), frame, strata, SamplePlaces::jittered(11))), 1e-10);
}

TEST(Catalogue, NamesAreDifferentAndHaveSources) {
  std::set<std::string_view> names;
  for (const EstimatorDescription& description : estimatorDescriptions()) {
    EXPECT_TRUE(names.insert(description.name).second) << description.name;
    EXPECT_THAT(std::string(description.source), testing::ContainsRegex("[0-9][0-9][0-9][0-9]|irradiff"));
  }
  for (const char* name : {"ward-heckbert", "hemicube-texel", "hemicube", "triangulated", "triangulated-closed",
                           "radiometric", "geometric", "discontinuity"}) {
    EXPECT_EQ(names.count(name), 1u) << name;
  }
}

TEST(Catalogue, RefusesWithTheNameTheValueAndTheRule) {
  EXPECT_THAT(refusalOf([] {
                makeEstimator("ward", Stratification::kPolar, {4, 4});
              }),
              AllOf(HasSubstr("\"ward\""), HasSubstr("must be one of ward-heckbert, "), HasSubstr("geometric")));
  EXPECT_THAT(refusalOf([] {
                makeEstimator("hemicube", Stratification::kConcentric, {4, 4});
              }),
              AllOf(HasSubstr("hemicube"), HasSubstr("concentric")));
  EXPECT_THAT(refusalOf([] {
                makeEstimator("hemicube-texel", Stratification::kPolar, {12, 4});
              }),
              AllOf(HasSubstr("hemicube-texel"), HasSubstr("polar")));
  forEachEstimator([](std::string_view name, Stratification stratification) {
    EXPECT_THAT(refusalOf([&] { makeEstimator(name, stratification, {0, 4}); }), HasSubstr("0 x 4"));
    if (stratification == Stratification::kHemicube) {
      EXPECT_THAT(refusalOf([&] { makeEstimator(name, stratification, {4, 4}); }), HasSubstr("4 x 4"));
    }
  });
}

TEST(Catalogue, RefusesSamplesOfAnotherGrid) {
  forEachEstimator([](std::string_view name, Stratification stratification) {
    const auto estimator = makeEstimator(name, stratification, strataOfSize(stratification, 8).shape());
    EXPECT_THAT(refusalOf([&] { estimator->estimate(roomSamples(stratification, 16)); }),
                AllOf(HasSubstr(std::string(name)), HasSubstr("made for"), HasSubstr("given")));
    HemisphereSamples other = roomSamples(stratification, 8);
    other.stratification =
        stratification == Stratification::kPolar ? Stratification::kConcentric : Stratification::kPolar;
    EXPECT_THAT(refusalOf([&] { estimator->estimate(other); }), HasSubstr("made for"));
  });
}

TEST(EveryEstimator, ScalesWithTheUnitOfLength) {
  forEachEstimator([](std::string_view name, Stratification stratification) {
    for (const double scale : {1000.0, 1e-3, 0x1p+100}) {
      EXPECT_TRUE(scalesWithLength(byName(name), roomSamples(stratification), scale));
    }
  });
}

/// So far away that Hessians vanish among the numbers of a double, gradients do not.
TEST(EveryEstimator, KnowsGradientsOfWhatIsVeryFar) {
  constexpr int kExponent = 600;
  forEachEstimator([](std::string_view name, Stratification stratification) {
    const HemisphereSamples samples = roomSamples(stratification);
    HemisphereSamples far = samples;
    for (double& inverse_distance : far.inverse_distance) inverse_distance = std::ldexp(inverse_distance, -kExponent);
    const IrradianceEstimate expected = estimateOf(name, samples);
    const IrradianceEstimate estimate = estimateOf(name, far);
    ASSERT_EQ(estimate.gradient.has_value(), expected.gradient.has_value());
    if (!estimate.gradient) return;
    const Vector3d gradient = estimate.gradient->unaryExpr([](double g) { return std::ldexp(g, kExponent); });
    EXPECT_LE((gradient - *expected.gradient).norm(), 1e-11 * expected.gradient->norm());
  });
}

/// Absolute thresholds, as renderers have them: hits nearer than a millimetre count as at a millimetre, and a distance
/// is never taken without a small number added.
TEST(EveryEstimator, AbsoluteThresholdsAreCaught) {
  const HemisphereSamples samples = roomSamples(Stratification::kConcentric);
  const auto clamped = [](HemisphereSamples s) {
    for (double& inverse_distance : s.inverse_distance) inverse_distance = std::min(inverse_distance, 1e3);
    return estimateOf("ward-heckbert", s);
  };
  EXPECT_FALSE(scalesWithLength(clamped, samples, 1e-3));
  const auto padded = [](HemisphereSamples s) {
    for (double& inverse_distance : s.inverse_distance) inverse_distance = 1.0 / (1.0 / inverse_distance + 1e-6);
    return estimateOf("ward-heckbert", s);
  };
  EXPECT_FALSE(scalesWithLength(padded, samples, 1e-3));
}

/// The unit of radiance likewise; what is linear in it is so exactly.
TEST(EveryEstimator, ScalesWithRadiance) {
  forEachEstimator([](std::string_view name, Stratification stratification) {
    const HemisphereSamples samples = roomSamples(stratification);
    HemisphereSamples scaled = samples;
    for (double& radiance : scaled.radiance) radiance *= 1e-30;
    IrradianceEstimate expected = estimateOf(name, samples);
    expected.irradiance *= 1e-30;
    if (expected.gradient) *expected.gradient *= 1e-30;
    if (expected.hessian) *expected.hessian *= 1e-30;
    if (expected.tangential_hessian) *expected.tangential_hessian *= 1e-30;
    if (expected.rotational_gradient) *expected.rotational_gradient *= 1e-30;
    EXPECT_TRUE(isClose(estimateOf(name, scaled), expected, 1e-11));
  });
}

TEST(EveryEstimator, DoesNotDependOnTheWorldsAxes) {
  forEachEstimator([](std::string_view name, Stratification stratification) {
    EXPECT_TRUE(turnsWithTheWorld(byName(name), stratification));
  });
  // A gradient in world components.
  const auto in_the_world = [](const HemisphereSamples& samples) {
    IrradianceEstimate estimate = estimateOf("ward-heckbert", samples);
    estimate.gradient = samples.frame.axes() * *estimate.gradient;
    return estimate;
  };
  EXPECT_FALSE(turnsWithTheWorld(in_the_world, Stratification::kConcentric));
}

/// The grids of the strata look the same after a quarter turn about the normal, so that centred samples in a turned
/// frame are the same rays in another order: the estimate turns with them. Meshes over samples are not as symmetric.
TEST(EveryEstimator, WithoutAMeshTurnsWithItsGrid) {
  const Matrix3d quarter = Eigen::AngleAxisd(kPi / 2.0, Vector3d::UnitZ()).toRotationMatrix();
  for (const char* name : {"ward-heckbert", "hemicube-texel", "hemicube", "radiometric", "geometric"}) {
    for (const Stratification stratification : kAllStratifications) {
      if (takesHemicubesOnly(name) && stratification != Stratification::kHemicube) continue;
      const SampleFrame frame = frameAt({0.2, -0.3, 0.0});
      const SampleFrame turned{frame.position, frame.bitangent, -frame.tangent, frame.normal};
      const Strata strata = strataOfSize(stratification, 16);
      IrradianceEstimate estimate =
          estimateOf(name, sampleScene(furnishedRoom(), turned, strata, SamplePlaces::centred()));
      // Components in the turned frame, back to those in the frame.
      if (estimate.gradient) estimate.gradient = quarter * *estimate.gradient;
      if (estimate.hessian) estimate.hessian = quarter * *estimate.hessian * quarter.transpose();
      if (estimate.tangential_hessian) {
        const Eigen::Matrix2d in_plane = quarter.topLeftCorner<2, 2>();
        estimate.tangential_hessian = in_plane * *estimate.tangential_hessian * in_plane.transpose();
      }
      if (estimate.rotational_gradient) estimate.rotational_gradient = quarter * *estimate.rotational_gradient;
      EXPECT_TRUE(isClose(
          estimate, estimateOf(name, sampleScene(furnishedRoom(), frame, strata, SamplePlaces::centred())), 1e-10))
          << name;
    }
  }
}

TEST(EveryEstimator, GivesZeroWhereNothingIsHit) {
  forEachEstimator([](std::string_view name, Stratification stratification) {
    HemisphereSamples samples = roomSamples(stratification);
    samples.inverse_distance.assign(samples.shape.size(), 0.0);
    samples.radiance.assign(samples.shape.size(), 0.0);
    const IrradianceEstimate estimate = estimateOf(name, samples);
    EXPECT_EQ(estimate.irradiance, 0.0);
    EXPECT_EQ(estimate.gradient.value_or(Vector3d::Zero()), Vector3d::Zero());
    EXPECT_EQ(estimate.hessian.value_or(Matrix3d::Zero()), Matrix3d::Zero());
    EXPECT_EQ(estimate.tangential_hessian.value_or(Eigen::Matrix2d::Zero()), Eigen::Matrix2d::Zero());
    EXPECT_EQ(*estimate.rotational_gradient, Vector3d::Zero());
  });
}

/// A sky: radiance from infinitely far does not change with the receiver's position.
TEST(EveryEstimator, GivesNoTranslationalDerivativesUnderASky) {
  forEachEstimator([](std::string_view name, Stratification stratification) {
    HemisphereSamples samples = roomSamples(stratification);
    samples.inverse_distance.assign(samples.shape.size(), 0.0);
    const IrradianceEstimate estimate = estimateOf(name, samples);
    EXPECT_GT(estimate.irradiance, 0.0);
    EXPECT_EQ(estimate.gradient.value_or(Vector3d::Zero()), Vector3d::Zero());
    EXPECT_EQ(estimate.tangential_hessian.value_or(Eigen::Matrix2d::Zero()), Eigen::Matrix2d::Zero());
    EXPECT_GT(estimate.rotational_gradient->norm(), 0.0);
  });
}

TEST(EveryEstimator, StaysFiniteWithMissesAndNearHits) {
  forEachEstimator([](std::string_view name, Stratification stratification) {
    HemisphereSamples samples = roomSamples(stratification);
    for (std::size_t i = 0; i < samples.shape.size(); i += 3) samples.inverse_distance[i] = 0.0;
    EXPECT_TRUE(isFinite(estimateOf(name, samples)));
    // Two hits that coincide with the receiver and with each other, as far as doubles go: one bad pair of samples used
    // to turn whole records into NaN.
    samples.inverse_distance[10] = 1e15;
    samples.inverse_distance[11] = 1e15;
    samples.radiance[11] = samples.radiance[10];
    EXPECT_TRUE(isFinite(estimateOf(name, samples)));
  });
}

TEST(EveryEstimator, StaysFiniteOnTheHorizonAndAtCorners) {
  forEachEstimator([](std::string_view name, Stratification stratification) {
    const Strata strata = strataOfSize(stratification, 8);
    // All samples in one corner of their strata: neighbours coincide at the pole, others lie on the horizon.
    for (const auto& [along_row, along_column] : {std::pair{0.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}, {1.0, 0.0}}) {
      HemisphereSamples samples = uniformSamples(strata, 1.0, 1.0);
      for (std::size_t i = 0; i < samples.shape.size(); ++i) {
        const Vector3d w =
            strata.direction({i / samples.shape.columns, i % samples.shape.columns, along_row, along_column});
        samples.direction_t[i] = w.x();
        samples.direction_b[i] = w.y();
        samples.direction_n[i] = w.z();
        samples.inverse_distance[i] = 0.5 + static_cast<double>(i % 3);
        samples.radiance[i] = static_cast<double>(i % 4);
      }
      EXPECT_TRUE(isFinite(estimateOf(name, samples)));
    }
  });
}

/// Beyond what a double holds there is an error that names the sample, not an infinity.
TEST(EveryEstimator, NamesTheSampleThatOverflows) {
  std::set<std::string_view> overflowed;
  forEachEstimator([&](std::string_view name, Stratification stratification) {
    HemisphereSamples samples = roomSamples(stratification);
    samples.inverse_distance[7] = 1e300;
    samples.radiance[7] = 1e300;
    const std::string refusal = refusalOf([&] { EXPECT_TRUE(isFinite(estimateOf(name, samples))); });
    // A mesh that takes the radiance of the farthest vertices may have no use for that of the nearest hit.
    if (refusal.empty()) return;
    EXPECT_THAT(refusal, AllOf(HasSubstr(std::string(name)), HasSubstr("sample 7"), HasSubstr("1e+300")));
    overflowed.insert(name);
  });
  for (const char* name : {"ward-heckbert", "hemicube-texel", "hemicube", "triangulated", "triangulated-closed",
                           "radiometric", "geometric", "discontinuity"}) {
    EXPECT_EQ(overflowed.count(name), 1u) << name;
  }
}

TEST(EveryEstimator, WorksOnTheSmallestGrids) {
  forEachEstimator([](std::string_view name, Stratification stratification) {
    const GridShape shape = stratification == Stratification::kHemicube ? GridShape{6, 2} : GridShape{1, 1};
    const HemisphereSamples samples =
        sampleScene(furnishedRoom(), frameAt({0.2, -0.3, 0.0}), {stratification, shape}, SamplePlaces::centred());
    const IrradianceEstimate estimate = estimateOf(name, samples);
    EXPECT_TRUE(isFinite(estimate));
    EXPECT_GT(estimate.irradiance, 0.0);
  });
}

/// What constant radiance in a closed room gives. The derivatives are 0; ward-heckbert has exactly that, radiometric
/// as far as the creases of the room allow, and the walls and patches of hemicubes do not.
TEST(EveryEstimator, UnderConstantRadiance) {
  const SampleFrame frame = frameAt({0.4, -0.2, 0.0});
  const auto sizeOfGradient = [&](std::string_view name, std::size_t size) {
    const HemisphereSamples samples =
        sampleScene(room(1.0), frame, strataOfSize(Stratification::kHemicube, size), SamplePlaces::jittered(2));
    return estimateOf(name, samples).gradient->head<2>().norm();
  };
  EXPECT_EQ(sizeOfGradient("ward-heckbert", 64), 0.0);
  EXPECT_LE(sizeOfGradient("radiometric", 128), 0.5 * sizeOfGradient("radiometric", 32));
  EXPECT_GT(sizeOfGradient("hemicube", 256), 0.2);
  EXPECT_GT(sizeOfGradient("hemicube-texel", 256), 0.2);
}

}  // namespace
}  // namespace irradiff
