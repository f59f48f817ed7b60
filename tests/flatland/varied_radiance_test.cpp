// The flatland discontinuity estimator where radiance varies on a surface, a part of which is hidden.

#include "derivatives/flatland/discontinuity.h"
#include "tests/flatland/sampled_flatland.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kLampHeight = 2.0;
constexpr double kLampHalfWidth = 4.0;
constexpr double kBlockerHeight = 1.0;
constexpr double kBlockerEnds[] = {-0.3, 0.5};

/// Of a level lamp, with a dark blocker in front of it.
double lampRadiance(double place) { return 1.0 + 0.3 * std::sin(place); }
double lampSlope(double place) { return 0.3 * std::cos(place); }

/// The lamp's radiance is higher by `height` from the place `at` on.
struct RadianceStep {
  double at = 0.0;
  double height = 0.0;
};

FlatlandRayQuery variedLamp(double x, const RadianceStep& step = {}) {
  return [x, step](const Vector2d& w) {
    const double blocker = x + kBlockerHeight * w.x() / w.y();
    if (blocker >= kBlockerEnds[0] && blocker <= kBlockerEnds[1]) return FlatlandHit{w.y() / kBlockerHeight, 0.0};
    const double place = x + kLampHeight * w.x() / w.y();
    if (std::abs(place) > kLampHalfWidth) return FlatlandHit{};
    return FlatlandHit{w.y() / kLampHeight, lampRadiance(place) + (place >= step.at ? step.height : 0.0)};
  };
}

/// E that a part of a lamp gives a receiver with upright normal, by Simpson's rule.
double irradianceOfPart(const Vector2d& position, double start, double stop, double (*radiance)(double)) {
  constexpr int kIntervals = 2000;
  const double height = kLampHeight - position.y();
  const double step = (stop - start) / kIntervals;
  double sum = 0.0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double place = start + i * step;
    const double weight = i == 0 || i == kIntervals ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    sum += weight * radiance(place) * height * height / std::pow(std::hypot(place - position.x(), height), 3.0);
  }
  return sum * step / 3.0;
}

double irradianceOfVariedLamp(const Vector2d& position) {
  const auto shadow = [&position](double end) {
    return position.x() + (end - position.x()) * (kLampHeight - position.y()) / (kBlockerHeight - position.y());
  };
  return irradianceOfPart(position, -kLampHalfWidth, shadow(kBlockerEnds[0]), lampRadiance) +
         irradianceOfPart(position, shadow(kBlockerEnds[1]), kLampHalfWidth, lampRadiance);
}

/// By differences along t, n and the diagonals with Richardson's extrapolation: an error of the order of step^4.
FlatlandEstimate trueDerivatives(double x, const std::function<double(const Vector2d&)>& irradiance) {
  const Vector2d position(x, 0.0);
  const double here = irradiance(position);
  const auto along = [&](const Vector2d& direction) {
    const auto by_differences = [&](double step) {
      const double before = irradiance(position - step * direction);
      const double after = irradiance(position + step * direction);
      return Vector2d((after - before) / (2.0 * step), (after - 2.0 * here + before) / (step * step));
    };
    return Vector2d((4.0 * by_differences(4e-3) - by_differences(8e-3)) / 3.0);
  };
  const Vector2d t = along({1.0, 0.0});
  const Vector2d n = along({0.0, 1.0});
  const double mixed = (along({1.0, 1.0}).y() - along({1.0, -1.0}).y()) / 4.0;
  FlatlandEstimate truth;
  truth.irradiance = here;
  truth.gradient = Vector2d(t.x(), n.x());
  truth.hessian = (Matrix2d() << t.y(), mixed, mixed, n.y()).finished();
  truth.tangential_hessian = t.y();
  return truth;
}

/// What the tangential second derivative owes to the radiance beside the blocker's shadow: the place on the lamp behind
/// an end of the blocker moves by 1 - (lamp height)/(blocker height), and the jump there with it. With g = (n.w)^2/r, a
/// unit jump at the blocker changes E by g_near, and what the lamp has lost beside it counts as g_far.
double slidingCurvature(double x) {
  double sum = 0.0;
  for (const int end : {0, 1}) {
    const double along = kBlockerEnds[end] - x;
    const double distance = std::hypot(along, kBlockerHeight);
    const double nu = kBlockerHeight / distance;
    const double g_near = nu * nu / distance;
    const double g_far = g_near * kBlockerHeight / kLampHeight;
    const double moved = 1.0 - kLampHeight / kBlockerHeight;
    const double place = x + along * kLampHeight / kBlockerHeight;
    sum += (end == 0 ? -1.0 : 1.0) * lampSlope(place) * moved * (g_near - g_far);
  }
  return sum;
}

TEST(FlatlandDiscontinuity, ConvergesWhereRadianceVariesBesideItsJumps) {
  const std::vector<std::size_t> budgets{64, 256, 1024, 4096};
  struct Quantity {
    FlatlandConvergence convergence;
    FlatlandErrorOf error;
  };
  std::array<Quantity, 3> quantities{
      Quantity{{"discontinuity, varied lamp, irradiance", budgets, {}}, irradianceDifference},
      Quantity{{"discontinuity, varied lamp, gradient", budgets, {}}, gradientDifference},
      Quantity{{"discontinuity, varied lamp, Hessian", budgets, {}}, hessianDifference}};
  constexpr std::size_t kPlaces = 31;
  std::vector<double> places;
  std::vector<FlatlandEstimate> truths;
  for (std::size_t i = 0; i < kPlaces; ++i) {
    places.push_back(-0.4 + 0.8 * static_cast<double>(i) / (kPlaces - 1));
    truths.push_back(trueDerivatives(places.back(), irradianceOfVariedLamp));
  }
  for (const std::size_t budget : budgets) {
    for (Quantity& quantity : quantities) {
      std::vector<double> errors;
      for (std::size_t i = 0; i < kPlaces; ++i) {
        errors.push_back(
            quantity.error(estimateFromFlatlandDiscontinuities(variedLamp(places[i]), budget).estimate, truths[i]));
      }
      std::nth_element(errors.begin(), errors.begin() + kPlaces / 2, errors.end());
      quantity.convergence.errors.push_back(errors[kPlaces / 2]);
    }
  }
  for (const Quantity& quantity : quantities) std::cout << quantity.convergence;
  // The midpoint rule between rays is of second order. Three quarters of that.
  EXPECT_GE(quantities[0].convergence.order(), 1.5);
  EXPECT_GE(quantities[1].convergence.order(), 1.5);
  // How fast radiance varies behind a blocker is known to first order.
  EXPECT_TRUE(quantities[2].convergence.isReached());
}

/// A step beside the shadow of the blocker is not taken for radiance that varies: what slides is found too small at
/// worst.
TEST(FlatlandDiscontinuity, AStepBesideAShadowLeavesWhatSlidesInBounds) {
  constexpr std::size_t kBudget = 256;
  const double x = 0.0;
  const double shadow = x + (kBlockerEnds[1] - x) * kLampHeight / kBlockerHeight;
  for (const double beyond : {0.02, 0.05, 0.08, 0.11, 0.14}) {
    const RadianceStep step{shadow + beyond, 1.0};
    const auto irradiance = [&step](const Vector2d& position) {
      return irradianceOfVariedLamp(position) +
             irradianceOfPart(position, step.at, kLampHalfWidth, [](double) { return 1.0; });
    };
    const double truth = *trueDerivatives(x, irradiance).tangential_hessian;
    const double estimate =
        *estimateFromFlatlandDiscontinuities(variedLamp(x, step), kBudget).estimate.tangential_hessian;
    // Either end of the blocker may lose its share of the term, at most 0.3 (g_near - g_far) with g_near <= 1 and g_far
    // = g_near/2. A step for a slope is ten times as steep.
    EXPECT_LE(std::abs(estimate - truth), 0.3) << beyond;
  }
}

double fadingRadiance(double place) {
  return (1.0 + std::cos(std::numbers::pi * place / kLampHalfWidth)) * (0.5 + 0.3 * std::sin(place));
}

/// Without jumps: 1/r between two hits of one surface is the mean of theirs, and nothing slides.
TEST(FlatlandDiscontinuity, IsOfSecondOrderWhereRadianceIsSmooth) {
  const double x = 0.7;
  const FlatlandEstimate truth = trueDerivatives(x, [](const Vector2d& position) {
    return irradianceOfPart(position, -kLampHalfWidth, kLampHalfWidth, fadingRadiance);
  });
  const FlatlandRayQuery fading_lamp = [x](const Vector2d& w) {
    const double place = x + kLampHeight * w.x() / w.y();
    return std::abs(place) < kLampHalfWidth ? FlatlandHit{w.y() / kLampHeight, fadingRadiance(place)} : FlatlandHit{};
  };
  const std::vector<std::size_t> sizes{64, 256, 1024};
  for (const bool casts_rays : {false, true}) {
    const std::string what = casts_rays ? "discontinuity, fading lamp" : "discontinuity from samples, fading lamp";
    FlatlandConvergence gradient{what + ", gradient", sizes, {}};
    FlatlandConvergence hessian{what + ", Hessian", sizes, {}};
    for (const std::size_t size : sizes) {
      const FlatlandEstimate estimate =
          casts_rays ? estimateFromFlatlandDiscontinuities(fading_lamp, size).estimate
                     : estimateDiscontinuity(sampleCentred({FlatlandStratification::kSquare, size}, fading_lamp));
      gradient.errors.push_back(gradientDifference(estimate, truth));
      hessian.errors.push_back(hessianDifference(estimate, truth));
    }
    // 7/8 of it.
    EXPECT_GE(gradient.order(), 1.75) << gradient;
    EXPECT_GE(hessian.order(), 1.75) << hessian;
    std::cout << gradient << hessian;
  }
}

/// Estimates from samples do not know how fast radiance varies: their Hessians tend to another limit.
TEST(FlatlandDiscontinuity, SamplesLackWhatSlidesBehindABlocker) {
  constexpr std::size_t kCount = 1 << 14;
  for (const double x : {-0.4, -0.1, 0.3}) {
    const FlatlandSamples samples = sampleCentred({FlatlandStratification::kCosine, kCount}, variedLamp(x));
    const double estimate = *estimateDiscontinuity(samples).tangential_hessian;
    const double truth = *trueDerivatives(x, irradianceOfVariedLamp).tangential_hessian;
    // Jumps of about 1 at four ends are known to within 1/N, at distances of 1 and more: |dG'/dphi| <= 4.
    const double bound = 4.0 * 4.0 / kCount;
    EXPECT_NEAR(estimate, truth - slidingCurvature(x), bound);
    EXPECT_GT(std::abs(estimate - truth), 5.0 * bound);
    std::cout << "varied lamp, x=" << x << ": tangential Hessian " << truth << ", from samples " << estimate
              << ", what slides " << slidingCurvature(x) << '\n';
  }
}

}  // namespace
}  // namespace irradiff
