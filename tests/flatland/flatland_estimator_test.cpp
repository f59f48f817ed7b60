// What holds for every flatland estimator.

#include "derivatives/flatland/flatland_estimator.h"

#include "tests/flatland/sampled_flatland.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

bool takesSquaresOnly(std::string_view name) { return name == "hemicube" || name == "hemicube-texel"; }

template <class Visit>
void forEachEstimator(Visit visit) {
  for (const std::string_view name : flatlandEstimatorNames()) {
    for (const FlatlandStratification stratification :
         {FlatlandStratification::kCosine, FlatlandStratification::kSquare}) {
      if (takesSquaresOnly(name) && stratification != FlatlandStratification::kSquare) continue;
      SCOPED_TRACE(std::string(name) + (stratification == FlatlandStratification::kCosine ? ", cosine" : ", square"));
      visit(name, stratification);
    }
  }
}

FlatlandSamples roomSamples(FlatlandStratification stratification, std::size_t count = 64) {
  const std::vector<Segment> scene = furnishedRoom();
  const FlatlandReceiver receiver{Vector2d(0.1, 0.0), Vector2d(0.28, 0.96)};
  return sampleJittered({stratification, count}, 9, rayCaster(scene, receiver));
}

void expectFinite(const FlatlandEstimate& estimate) {
  EXPECT_TRUE(std::isfinite(estimate.irradiance));
  EXPECT_TRUE(std::isfinite(estimate.rotational_gradient));
  EXPECT_TRUE(estimate.gradient.value_or(Vector2d::Zero()).allFinite());
  EXPECT_TRUE(estimate.hessian.value_or(Matrix2d::Zero()).allFinite());
  EXPECT_TRUE(std::isfinite(estimate.tangential_hessian.value_or(0.0)));
}

std::string refusalOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(FlatlandEstimators, HaveTheNamesOfTheirCounterparts) {
  const auto names = flatlandEstimatorNames();
  EXPECT_THAT(std::vector<std::string_view>(names.begin(), names.end()),
              ElementsAre("ward-heckbert", "hemicube-texel", "hemicube", "triangulated", "triangulated-closed",
                          "radiometric", "geometric", "discontinuity"));
}

TEST(FlatlandEstimators, RefuseWhatTheyDoNotTake) {
  const FlatlandSamples samples = roomSamples(FlatlandStratification::kCosine);
  EXPECT_THAT(refusalOf([&] { estimateFlatland("ward", samples); }),
              AllOf(HasSubstr("\"ward\""), HasSubstr("ward-heckbert, hemicube-texel"), HasSubstr("discontinuity")));
  for (const char* name : {"hemicube", "hemicube-texel"}) {
    EXPECT_THAT(refusalOf([&] { estimateFlatland(name, samples); }), AllOf(HasSubstr(name), HasSubstr("square")));
  }
  FlatlandSamples short_of_one = samples;
  short_of_one.hits.pop_back();
  EXPECT_THAT(refusalOf([&] { estimateFlatland("geometric", short_of_one); }),
              AllOf(HasSubstr("64 directions and 63 hits"), HasSubstr("64 strata")));
}

/// E and dE/dalpha under constant radiance: 2 L and 0. Elsewhere they converge.
TEST(FlatlandEstimators, AgreeOnIrradianceAndRotation) {
  forEachEstimator([](std::string_view name, FlatlandStratification stratification) {
    FlatlandSamples samples = roomSamples(stratification);
    const FlatlandEstimate first = estimateFlatland("ward-heckbert", samples);
    EXPECT_EQ(estimateFlatland(name, samples).irradiance, first.irradiance);
    EXPECT_EQ(estimateFlatland(name, samples).rotational_gradient, first.rotational_gradient);
    for (FlatlandHit& hit : samples.hits) hit.radiance = 3.25;
    EXPECT_NEAR(estimateFlatland(name, samples).irradiance, 6.5, 64.0 * 6.5 * 0x1p-53);
    EXPECT_NEAR(estimateFlatland(name, samples).rotational_gradient, 0.0, 64.0 * 6.5 * 0x1p-53);
  });
  for (const FlatlandStratification stratification :
       {FlatlandStratification::kCosine, FlatlandStratification::kSquare}) {
    const FlatlandCase setting{.stratification = stratification};
    const auto estimate = [](const FlatlandSamples& samples) { return estimateFlatland("ward-heckbert", samples); };
    const FlatlandConvergence irradiance =
        flatlandConvergence("strata, irradiance", setting, estimate, irradianceDifference);
    const FlatlandConvergence rotation =
        flatlandConvergence("strata, rotational gradient", setting, estimate, rotationalDifference);
    EXPECT_TRUE(irradiance.isReached()) << irradiance;
    EXPECT_TRUE(rotation.isReached()) << rotation;
    const auto reversed = [](const FlatlandSamples& samples) {
      FlatlandEstimate result = estimateFlatland("ward-heckbert", samples);
      result.rotational_gradient = -result.rotational_gradient;
      return result;
    };
    EXPECT_FALSE(flatlandConvergence("reversed", setting, reversed, rotationalDifference).isReached());
    std::cout << irradiance << rotation;
  }
}

/// Left and right exchanged.
FlatlandSamples mirrored(const FlatlandSamples& samples) {
  FlatlandSamples result = samples;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::size_t k = samples.size() - 1 - i;
    result.directions[i] = Vector2d(-samples.directions[k].x(), samples.directions[k].y());
    result.hits[i] = samples.hits[k];
  }
  return result;
}

TEST(FlatlandEstimators, KnowNoHandedness) {
  forEachEstimator([](std::string_view name, FlatlandStratification stratification) {
    const FlatlandSamples samples = roomSamples(stratification);
    const FlatlandEstimate estimate = estimateFlatland(name, samples);
    const FlatlandEstimate other = estimateFlatland(name, mirrored(samples));
    const auto expectNear = [](double value, double expected) {
      EXPECT_NEAR(value, expected, 1e-11 * (1.0 + std::abs(expected)));
    };
    expectNear(other.irradiance, estimate.irradiance);
    expectNear(other.rotational_gradient, -estimate.rotational_gradient);
    ASSERT_EQ(other.gradient.has_value(), estimate.gradient.has_value());
    if (estimate.gradient) {
      EXPECT_GT(std::abs(estimate.gradient->x()), 1e-3);
      expectNear(other.gradient->x(), -estimate.gradient->x());
      expectNear(other.gradient->y(), estimate.gradient->y());
    }
    if (estimate.hessian) {
      expectNear((*other.hessian)(0, 0), (*estimate.hessian)(0, 0));
      expectNear((*other.hessian)(1, 1), (*estimate.hessian)(1, 1));
      expectNear((*other.hessian)(0, 1), -(*estimate.hessian)(0, 1));
      EXPECT_EQ((*other.hessian)(0, 1), (*other.hessian)(1, 0));
      EXPECT_EQ((*estimate.hessian)(0, 0), estimate.tangential_hessian);
    }
  });
}

/// Twice as far: half the gradient, a quarter of the Hessian.
TEST(FlatlandEstimators, HaveTheUnitsOfDerivatives) {
  forEachEstimator([](std::string_view name, FlatlandStratification stratification) {
    const FlatlandSamples samples = roomSamples(stratification);
    FlatlandSamples far = samples;
    for (FlatlandHit& hit : far.hits) hit.inverse_distance /= 2.0;
    const FlatlandEstimate near_estimate = estimateFlatland(name, samples);
    const FlatlandEstimate far_estimate = estimateFlatland(name, far);
    if (near_estimate.gradient) {
      EXPECT_EQ(2.0 * *far_estimate.gradient, *near_estimate.gradient);
    }
    if (near_estimate.hessian) {
      EXPECT_EQ(4.0 * *far_estimate.hessian, *near_estimate.hessian);
    }
    if (near_estimate.tangential_hessian) {
      EXPECT_EQ(4.0 * *far_estimate.tangential_hessian, *near_estimate.tangential_hessian);
    }
  });
}

TEST(FlatlandEstimators, GiveNoTranslationalDerivativesWhereNothingIsHit) {
  forEachEstimator([](std::string_view name, FlatlandStratification stratification) {
    // A sky of many colours: radiance from infinitely far.
    FlatlandSamples samples = roomSamples(stratification);
    for (std::size_t i = 0; i < samples.size(); ++i) samples.hits[i] = {0.0, static_cast<double>(i % 7)};
    const FlatlandEstimate estimate = estimateFlatland(name, samples);
    EXPECT_GT(estimate.irradiance, 0.0);
    EXPECT_EQ(estimate.gradient.value_or(Vector2d::Zero()), Vector2d::Zero());
    EXPECT_EQ(estimate.hessian.value_or(Matrix2d::Zero()), Matrix2d::Zero());
    EXPECT_EQ(estimate.tangential_hessian.value_or(0.0), 0.0);
  });
}

TEST(FlatlandEstimators, StayFiniteWithMissesAndCoincidentHits) {
  forEachEstimator([](std::string_view name, FlatlandStratification stratification) {
    FlatlandSamples samples = roomSamples(stratification);
    for (std::size_t i = 0; i < samples.size(); i += 3) samples.hits[i].inverse_distance = 0.0;
    expectFinite(estimateFlatland(name, samples));
    // Two hits that coincide with the receiver and with each other.
    samples.hits[10] = {1e15, 2.0};
    samples.hits[11] = {1e15, 2.0};
    expectFinite(estimateFlatland(name, samples));
    // In one direction.
    samples.directions[11] = samples.directions[10];
    expectFinite(estimateFlatland(name, samples));
    samples.hits[11] = {3.0, 0.5};
    expectFinite(estimateFlatland(name, samples));
    for (FlatlandHit& hit : samples.hits) hit.inverse_distance = 1.0;
    expectFinite(estimateFlatland(name, samples));
  });
}

TEST(FlatlandEstimators, StayFiniteOnTheHorizonAndAtBorders) {
  forEachEstimator([](std::string_view name, FlatlandStratification stratification) {
    for (const std::size_t count : {4u, 8u}) {
      const FlatlandStrata strata(stratification, count);
      for (const double offset : {0.0, 1.0}) {
        std::vector<double> offsets(count, offset);
        std::size_t ray = 0;
        const FlatlandRayQuery query = [&ray](const Vector2d&) {
          ++ray;
          return FlatlandHit{0.5 + static_cast<double>(ray % 3), static_cast<double>(ray % 4)};
        };
        expectFinite(estimateFlatland(name, sampleHalfCircle(strata, offsets, query)));
        // Both samples of the two outermost strata on the horizon.
        offsets.front() = 0.0;
        offsets.back() = 1.0;
        expectFinite(estimateFlatland(name, sampleHalfCircle(strata, offsets, query)));
      }
    }
  });
}

TEST(FlatlandEstimators, WorkWithOneSampleAndWithTwo) {
  forEachEstimator([](std::string_view name, FlatlandStratification stratification) {
    for (const std::size_t count : {1u, 2u}) {
      if (stratification == FlatlandStratification::kSquare) continue;
      for (const double offset : {0.0, 0.4, 1.0}) {
        const FlatlandSamples samples =
            sampleHalfCircle({stratification, count}, std::vector<double>(count, offset), [](const Vector2d& w) {
              return FlatlandHit{1.0 + w.x() * w.x(), 2.0 + w.x()};
            });
        const FlatlandEstimate estimate = estimateFlatland(name, samples);
        expectFinite(estimate);
        EXPECT_GT(estimate.irradiance, 0.0);
      }
    }
  });
  // The two ends of the horizon are opposite: no direction is between them but the normal.
  const std::vector<double> ends{0.0, 1.0};
  const FlatlandSamples opposite = sampleHalfCircle({FlatlandStratification::kCosine, 2}, ends, [](const Vector2d& w) {
    return FlatlandHit{1.0, 2.0 + w.x()};
  });
  for (const std::string_view name : flatlandEstimatorNames()) {
    if (!takesSquaresOnly(name)) expectFinite(estimateFlatland(name, opposite));
  }
}

/// Beyond what a double holds there is an error that names the sample, not an infinity.
TEST(FlatlandEstimators, NameTheSampleThatOverflows) {
  std::set<std::string_view> overflowed;
  forEachEstimator([&](std::string_view name, FlatlandStratification stratification) {
    FlatlandSamples samples = roomSamples(stratification);
    samples.hits[7] = {1e300, 1e300};
    const std::string refusal = refusalOf([&] { expectFinite(estimateFlatland(name, samples)); });
    if (refusal.empty()) return;
    EXPECT_THAT(refusal, AllOf(HasSubstr(std::string(name)), HasSubstr("number 7"), HasSubstr("1e+300")));
    overflowed.insert(name);
  });
  // A polyline that takes the radiance of farther ends may have no use for that of the nearest hit.
  for (const char* name :
       {"ward-heckbert", "hemicube-texel", "hemicube", "radiometric", "geometric", "discontinuity"}) {
    EXPECT_EQ(overflowed.count(name), 1u) << name;
  }
}

/// What constant radiance in a room gives, where all derivatives are 0. Walls, the closed polyline and jumps have
/// exactly that; patches as far as the corners of the room allow; the others do not.
TEST(FlatlandEstimators, UnderConstantRadiance) {
  const std::vector<Segment> room = flatRoom(1.0);
  const FlatlandReceiver receiver{Vector2d(0.4, 0.1), Vector2d::UnitY()};
  const auto estimateOf = [&](std::string_view name, std::size_t count) {
    return estimateFlatland(name,
                            sampleJittered({FlatlandStratification::kSquare, count}, 2, rayCaster(room, receiver)));
  };
  for (const char* name : {"ward-heckbert", "triangulated-closed", "discontinuity"}) {
    const FlatlandEstimate estimate = estimateOf(name, 64);
    EXPECT_EQ(*estimate.gradient, Vector2d::Zero()) << name;
    EXPECT_EQ(estimate.hessian.value_or(Matrix2d::Zero()), Matrix2d::Zero()) << name;
  }
  const auto tangential = [&](std::string_view name, std::size_t count) {
    return std::abs(estimateOf(name, count).gradient->x());
  };
  EXPECT_LE(tangential("radiometric", 4096), 0.1 * tangential("radiometric", 64));
  EXPECT_GT(tangential("hemicube", 4096), 0.1);
  EXPECT_GT(tangential("hemicube-texel", 4096), 0.1);
  for (const std::string_view name : flatlandEstimatorNames()) {
    const FlatlandEstimate estimate = estimateOf(name, 4096);
    std::cout << "constant radiance, N=4096, " << name << ": |dE/dt| "
              << std::abs(estimate.gradient.value_or(Vector2d::Zero()).x()) << " |d2E/dt2| "
              << std::abs(estimate.tangential_hessian.value_or(0.0)) << '\n';
  }
}

}  // namespace
}  // namespace irradiff
