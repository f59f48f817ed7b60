// The flatland discontinuity estimator: its budget, and how near it comes to exact derivatives.

#include "derivatives/flatland/discontinuity.h"

#include "derivatives/flatland/flatland_scene.h"
#include "tests/flatland/sampled_flatland.h"
#include "verification/checks/random.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using testing::AllOf;
using testing::HasSubstr;

/// Blockers before a lamp so wide that no end of any of them hides another's, from wherever within |x| <= 1/2.
std::vector<Segment> separateBlockers() {
  return {{"lamp", {Vector2d(-6.0, 2.0), Vector2d(6.0, 2.5)}, 3.0},
          {"dark", {Vector2d(-0.7, 0.6), Vector2d(-0.4, 0.7)}, 0.0},
          {"dim", {Vector2d(0.5, 0.8), Vector2d(0.7, 0.6)}, 0.5}};
}

/// Counts the rays and passes them on.
struct Counter {
  const FlatlandRayQuery& query;
  std::size_t count = 0;

  FlatlandHit operator()(const Vector2d& direction) {
    EXPECT_GE(direction.y(), 0.0);
    EXPECT_NEAR(direction.norm(), 1.0, 4.0 * 0x1p-53);
    ++count;
    return query(direction);
  }
};

void expectBudgetKept(const FlatlandRayQuery& query, std::size_t budget) {
  Counter counter{query};
  const FlatlandDiscontinuityEstimate result =
      estimateFromFlatlandDiscontinuities([&counter](const Vector2d& w) { return counter(w); }, budget);
  EXPECT_EQ(result.rays, counter.count);
  EXPECT_LE(counter.count, budget);
}

TEST(FlatlandDiscontinuity, NeverTakesMoreRaysThanItsBudget) {
  const std::vector<Segment> scene = furnishedRoom();
  const FlatlandReceiver receiver{Vector2d(0.1, 0.0), Vector2d::UnitY()};
  KeyedRandom random(2, "noise", 0);
  for (const std::size_t budget : {4u, 5u, 7u, 16u, 33u, 256u, 1000u, 4096u}) {
    expectBudgetKept(rayCaster(scene, receiver), budget);
    // Radiance that jumps everywhere, on two levels or on many.
    expectBudgetKept([&random](const Vector2d&) { return FlatlandHit{1.0, random.unit()}; }, budget);
    expectBudgetKept([&random](const Vector2d&) { return FlatlandHit{1.0, random.unit() < 0.1 ? 1.0 : 0.0}; }, budget);
    expectBudgetKept([](const Vector2d&) { return FlatlandHit{}; }, budget);
  }
}

TEST(FlatlandDiscontinuity, RefusesABudgetThatIsTooSmall) {
  const FlatlandRayQuery nothing = [](const Vector2d&) { return FlatlandHit{}; };
  EXPECT_NO_THROW(estimateFromFlatlandDiscontinuities(nothing, kFewestFlatlandDiscontinuityRays));
  try {
    estimateFromFlatlandDiscontinuities(nothing, 3);
    ADD_FAILURE() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("budget of 3 rays"), HasSubstr("at least 4")));
  }
}

/// What the gaps that remain allow. A point of the boundary is off by up to half a gap, and the distance is read up to
/// a gap beside it, where it differs by cot(a) of it, a between the ray and the segment. With |dG/dphi| = u, |G| <= u
/// and in the Frobenius norm |dG'/dphi| <= 4 u^2, |G'| <= 1.5 u^2:
///   |error of grad E| <= sum |dL| gap u (1/2 + cot a),   |error of hess E| <= sum |dL| gap u^2 (2 + 3 cot a)
/// summed over all ends, hidden or not, and twice as much for what is of second order in the gap. `uncertainty` bounds
/// each |dL| gap.
struct AllowedError {
  double gradient = 0.0;
  double hessian = 0.0;
};

AllowedError allowedError(const std::vector<Segment>& scene, const FlatlandReceiver& receiver, double uncertainty) {
  AllowedError allowed;
  for (const Segment& segment : scene) {
    const Vector2d edge = segment.vertices[1] - segment.vertices[0];
    for (const Vector2d& end : segment.vertices) {
      const Vector2d r = end - receiver.position;
      const double cotangent = std::abs(r.dot(edge) / (r.x() * edge.y() - r.y() * edge.x()));
      const double u = 1.0 / r.norm();
      allowed.gradient += 2.0 * uncertainty * u * (0.5 + cotangent);
      allowed.hessian += 2.0 * uncertainty * u * u * (2.0 + 3.0 * cotangent);
    }
  }
  return allowed;
}

/// The largest |dL| gap: at first up to the brightest radiance times the angle between the first rays, halved for all
/// ends in turn by the other rays.
double largestUncertainty(const std::vector<Segment>& scene, std::size_t budget) {
  double brightest = 0.0;
  for (const Segment& segment : scene) brightest = std::max(brightest, segment.radiance);
  const auto halvings = static_cast<int>((budget - budget / 2) / (2 * scene.size()));
  const std::size_t first_rays = budget / 2;
  const double first = std::numbers::pi / static_cast<double>(first_rays);
  // A gap is no narrower than neighbouring numbers, and rays that meet an end have their own rounding.
  return brightest * (std::ldexp(first, -halvings) + 0x1p-48);
}

TEST(FlatlandDiscontinuity, IsExactToTheWidthOfItsGaps) {
  const std::vector<Segment> scene = separateBlockers();
  const std::size_t ends = 2 * scene.size();
  for (const std::size_t budget : {64u, 128u, 256u, 1024u}) {
    const double uncertainty = largestUncertainty(scene, budget);
    double largest_share = 0.0;
    double worst_gradient = 0.0;
    double worst_hessian = 0.0;
    for (const FlatlandReceiver& receiver : flatlandReceivers(200, 0.05)) {
      const FlatlandEstimate truth = trueEstimate(scene, receiver);
      const FlatlandEstimate estimate =
          estimateFromFlatlandDiscontinuities(rayCaster(scene, receiver), budget).estimate;
      const AllowedError allowed = allowedError(scene, receiver, uncertainty);
      const double gradient_error = (*estimate.gradient - *truth.gradient).norm();
      const double hessian_error = (*estimate.hessian - *truth.hessian).norm();
      EXPECT_LE(gradient_error, allowed.gradient);
      EXPECT_LE(hessian_error, allowed.hessian);
      EXPECT_LE(std::abs(*estimate.tangential_hessian - *truth.tangential_hessian), allowed.hessian);
      // |d(w.t)/dphi| and |d(w.n)/dphi| are at most 1.
      EXPECT_NEAR(estimate.irradiance, truth.irradiance, static_cast<double>(ends) * uncertainty);
      EXPECT_NEAR(estimate.rotational_gradient, truth.rotational_gradient, static_cast<double>(ends) * uncertainty);
      largest_share = std::max({largest_share, gradient_error / allowed.gradient, hessian_error / allowed.hessian});
      worst_gradient = std::max(worst_gradient, gradient_error / truth.gradient->norm());
      worst_hessian = std::max(worst_hessian, hessian_error / truth.hessian->norm());
    }
    std::cout << "discontinuity, " << budget << " rays, |dL| gap up to " << uncertainty
              << ": worst relative error of the gradient " << worst_gradient << ", of the Hessian " << worst_hessian
              << "; largest share of the bound " << largest_share << '\n';
  }
}

/// The same rays with the farther distance at each jump, or with the edges where the first rays leave them.
TEST(FlatlandDiscontinuity, MistakesExceedWhatTheGapsAllow) {
  const std::vector<Segment> scene = separateBlockers();
  const FlatlandReceiver receiver{Vector2d(0.1, 0.0), Vector2d::UnitY()};
  const FlatlandEstimate truth = trueEstimate(scene, receiver);
  const FlatlandRayQuery cast = rayCaster(scene, receiver);
  const AllowedError allowed = allowedError(scene, receiver, largestUncertainty(scene, 1024));
  // The blockers' hits at the lamp's distance.
  const FlatlandRayQuery farther = [&](const Vector2d& w) {
    const std::vector<Segment> lamp(scene.begin(), scene.begin() + 1);
    return FlatlandHit{rayCaster(lamp, receiver)(w).inverse_distance, cast(w).radiance};
  };
  const FlatlandEstimate wrong_distance = estimateFromFlatlandDiscontinuities(farther, 1024).estimate;
  EXPECT_GT((*wrong_distance.gradient - *truth.gradient).norm(), 1e6 * allowed.gradient);
  EXPECT_GT((*wrong_distance.hessian - *truth.hessian).norm(), 1e6 * allowed.hessian);
  const FlatlandEstimate not_narrowed =
      estimateDiscontinuity(sampleCentred({FlatlandStratification::kCosine, 512}, cast));
  EXPECT_GT((*not_narrowed.gradient - *truth.gradient).norm(), 1e6 * allowed.gradient);
  EXPECT_GT((-*truth.gradient - *truth.gradient).norm(), 1e6 * allowed.gradient);
}

/// Two ends between two of the first rays: the third region is found while the gap is narrowed.
TEST(FlatlandDiscontinuity, FindsARegionInsideAGap) {
  const std::vector<Segment> scene{{"left", {Vector2d(-3.0, 1.0), Vector2d(0.0, 1.0)}, 1.0},
                                   {"sliver", {Vector2d(0.0, 1.0), Vector2d(0.004, 1.0)}, 5.0},
                                   {"right", {Vector2d(0.004, 1.0), Vector2d(3.0, 1.0)}, 2.0}};
  const FlatlandReceiver receiver{Vector2d(0.0015, 0.0), Vector2d::UnitY()};
  const FlatlandEstimate truth = trueEstimate(scene, receiver);
  const FlatlandEstimate estimate = estimateFromFlatlandDiscontinuities(rayCaster(scene, receiver), 600).estimate;
  // Until it is found, less than the largest difference of radiance steers the rays: by a factor of 4 to 1.
  const AllowedError allowed = allowedError(scene, receiver, 4.0 * largestUncertainty(scene, 600));
  EXPECT_LE((*estimate.hessian - *truth.hessian).norm(), allowed.hessian);
  std::vector<Segment> without = scene;
  without[1].radiance = 2.0;
  EXPECT_GT((*trueEstimate(without, receiver).hessian - *truth.hessian).norm(), 1e6 * allowed.hessian);
}

/// Steps of radiance that follow each other at about the angle between the first rays are no radiance that varies.
TEST(FlatlandDiscontinuity, StepsBehindAnEdgeDoNotSlide) {
  const std::vector<Segment> scene{{"blocker", {Vector2d(-5.0, 1.0), Vector2d(0.0, 1.0)}, 0.0},
                                   {"first", {Vector2d(-9.0, 2.0), Vector2d(0.06, 2.0)}, 1.0},
                                   {"second", {Vector2d(-9.0, 3.0), Vector2d(0.21, 3.0)}, 2.0},
                                   {"third", {Vector2d(-9.0, 4.0), Vector2d(9.0, 4.0)}, 3.0}};
  constexpr std::size_t kBudget = 128;
  for (int i = 0; i < 20; ++i) {
    const FlatlandReceiver receiver{Vector2d(0.0004 * i, 0.0), Vector2d::UnitY()};
    const FlatlandEstimate truth = trueEstimate(scene, receiver);
    const FlatlandEstimate estimate = estimateFromFlatlandDiscontinuities(rayCaster(scene, receiver), kBudget).estimate;
    const AllowedError allowed = allowedError(scene, receiver, largestUncertainty(scene, kBudget));
    EXPECT_LE((*estimate.hessian - *truth.hessian).norm(), allowed.hessian);
  }
}

TEST(FlatlandDiscontinuity, ConvergesUnderOccludersWithTheRaysThatItTakes) {
  const std::vector<Segment> scene = furnishedRoom();
  const std::vector<FlatlandReceiver> receivers = flatlandReceivers(201, 0.3);
  for (const std::size_t budget : {16u, 32u, 64u, 128u, 256u, 1024u}) {
    std::vector<double> gradient_errors;
    std::vector<double> hessian_errors;
    for (const FlatlandReceiver& receiver : receivers) {
      const FlatlandEstimate truth = trueEstimate(scene, receiver);
      const FlatlandEstimate estimate =
          estimateFromFlatlandDiscontinuities(rayCaster(scene, receiver), budget).estimate;
      gradient_errors.push_back(gradientDifference(estimate, truth));
      hessian_errors.push_back(hessianDifference(estimate, truth));
    }
    std::sort(gradient_errors.begin(), gradient_errors.end());
    std::sort(hessian_errors.begin(), hessian_errors.end());
    std::cout << "discontinuity, occluded, " << budget << " rays: median relative error of the gradient "
              << gradient_errors[100] << ", of the Hessian " << hessian_errors[100] << "; at 95 % "
              << gradient_errors[190] << ", " << hessian_errors[190] << '\n';
    if (budget < 1024) continue;
    // At least 512/12 = 42 halvings of gaps of pi/512: 1.4e-15. At the median the factors above make 1000 of it at
    // most.
    EXPECT_LE(gradient_errors[100], 1e-12);
    EXPECT_LE(hessian_errors[100], 1e-12);
  }
}

TEST(FlatlandDiscontinuity, FromSamplesConverges) {
  for (const FlatlandStratification stratification :
       {FlatlandStratification::kCosine, FlatlandStratification::kSquare}) {
    const FlatlandCase setting{.stratification = stratification};
    const FlatlandConvergence gradient =
        flatlandConvergence("discontinuity from samples, gradient", setting, estimateDiscontinuity, gradientDifference);
    const FlatlandConvergence hessian =
        flatlandConvergence("discontinuity from samples, Hessian", setting, estimateDiscontinuity, hessianDifference);
    EXPECT_TRUE(gradient.isReached()) << gradient;
    EXPECT_TRUE(hessian.isReached()) << hessian;
    std::cout << gradient << hessian;
  }
}

TEST(FlatlandDiscontinuity, ConstantRadianceGivesExactlyZero) {
  const std::vector<Segment> room = flatRoom(1.0);
  const FlatlandReceiver receiver{Vector2d(0.4, 0.1), Vector2d::UnitY()};
  const FlatlandDiscontinuityEstimate result = estimateFromFlatlandDiscontinuities(rayCaster(room, receiver), 64);
  EXPECT_EQ(*result.estimate.gradient, Vector2d::Zero());
  EXPECT_EQ(*result.estimate.hessian, Matrix2d::Zero());
  EXPECT_EQ(result.rays, 32u);
  EXPECT_NEAR(result.estimate.irradiance, 2.0, 64.0 * 0x1p-53);
}

TEST(FlatlandDiscontinuity, NamesTheHitThatOverflows) {
  const auto refusal = [](double inverse_distance) -> std::string {
    try {
      estimateFromFlatlandDiscontinuities(
          [inverse_distance](const Vector2d& w) {
            return w.x() > 0.3 ? FlatlandHit{inverse_distance, 2.0} : FlatlandHit{};
          },
          64);
    } catch (const std::overflow_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal(1e200), AllOf(HasSubstr("discontinuity"), HasSubstr("inverse distance 1e+200")));
  EXPECT_EQ(refusal(1e100), "");
}

}  // namespace
}  // namespace irradiff
