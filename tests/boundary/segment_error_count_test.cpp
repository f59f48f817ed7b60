// The count of rounding errors by machine of the two ends of a flatland segment: docs/derivations/error_bounds.md,
// section 4.

#include "derivatives/flatland/segment_evaluation.h"
#include "derivatives/flatland/segment_form.h"
#include "tests/boundary/tracked_scalar.h"
#include "verification/checks/input_families.h"
#include "verification/checks/random.h"

#include <gtest/gtest.h>

#include <array>
#include <iostream>
#include <numbers>
#include <optional>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 20120806;

/// The constants in the bounds of a segment too long for quadrature, in units of u: of most quantities, and of the
/// tangential Hessian and the rotational gradient. Irradiance is its own size, the two ends' shares of the tangential
/// Hessian add up, and nothing grazes here.
struct EndErrors {
  double most, along_tangent;
};

EndErrors endErrors() {
  const SegmentEvaluation evaluation =
      evaluateSegment({"long", {Eigen::Vector2d(1.0, 1.0), Eigen::Vector2d(-1.0, 1.0)}, 1.0}, 0,
                      {Eigen::Vector2d::Zero(), Eigen::Vector2d::UnitY()});
  const auto constant = [](double bound, double size) { return std::floor(bound / (size * 0x1p-53) + 1e-6); };
  return {
      constant(evaluation.bounds.irradiance, evaluation.derivatives.irradiance.value),
      constant(evaluation.bounds.tangential_hessian, std::abs(evaluation.derivatives.tangential_hessian.value(0, 0)))};
}

/// Direction of the first end; angle between the ends, through the logistic function; logarithms of their distances;
/// turn of the normal, through tanh, from the middle to where an end is on the horizon.
using SegmentParameters = std::array<double, 5>;
/// Irradiance, gradient, Hessian, tangential Hessian and rotational gradient, in units of u relative to the sizes.
using Counts = std::array<double, 5>;

std::optional<Counts> countOf(const SegmentParameters& parameters) {
  const double angle = std::numbers::pi / (1.0 + std::exp(-parameters[1]));
  if (angle < 1e-6 || angle > std::numbers::pi - 1e-6 || std::abs(parameters[2]) > 12.0 ||
      std::abs(parameters[3]) > 12.0) {
    return std::nullopt;
  }
  const auto direction = [](double turn) { return Eigen::Vector2d(std::cos(turn), std::sin(turn)); };
  const Eigen::Vector2d first = std::exp(parameters[2]) * direction(parameters[0]);
  const Eigen::Vector2d last = std::exp(parameters[3]) * direction(parameters[0] + angle);
  const Eigen::Vector2d normal =
      direction(parameters[0] + 0.5 * angle + 0.5 * (std::numbers::pi - angle) * std::tanh(parameters[4]));
  const ErrorTape tape;
  const auto input = []<class Scalar>(const Eigen::Vector2d& v, Scalar) {
    return Vector2<Scalar>(Scalar::input(v(0)), Scalar::input(v(1)));
  };
  const Vector2<Tracked> tracked_normal = input(normal, Tracked());
  const Vector2<WideTracked> wide_normal = widen<WideTracked, Tracked, 2>(tracked_normal);
  const auto height = [&](const Vector2<WideTracked>& r, double distance) {
    const WideTracked wide = dot(wide_normal, r);
    // What the rounding of the normal leaves of an end meant to be on the horizon.
    return wide.value() < 1e-12L * distance ? lift<Tracked>(0.0) : static_cast<Tracked>(wide);
  };
  ClippedSegment<Tracked> segment;
  segment.first = input(first, WideTracked());
  segment.last = input(last, WideTracked());
  segment.first_height = height(segment.first, first.norm());
  segment.last_height = height(segment.last, last.norm());
  const Tracked zero = lift<Tracked>(0.0);
  if (!(segment.first_height > zero) && !(segment.last_height > zero)) {
    return std::nullopt;
  }
  const SegmentSums<Tracked> sums = segmentBoundaryForm(segment, tracked_normal);
  Counts counts{sums.derivatives.irradiance.value.worstError(), 0.0, 0.0,
                sums.derivatives.tangential_hessian.value(0, 0).worstError(),
                sums.derivatives.rotational_gradient.value(0).worstError()};
  for (int i = 0; i < 2; ++i) {
    counts[1] = std::max(counts[1], sums.derivatives.gradient.value(i).worstError());
    for (int j = 0; j < 2; ++j) {
      counts[2] = std::max(counts[2], sums.derivatives.hessian.value(i, j).worstError());
    }
  }
  counts[0] /= static_cast<double>(sums.irradiance_size.value());
  counts[1] /= static_cast<double>(sums.gradient_size.value());
  counts[2] /= static_cast<double>(sums.hessian_size.value());
  counts[3] /= static_cast<double>(sums.tangential_size.value());
  counts[4] /= static_cast<double>(sums.rotational_size.value());
  return counts;
}

/// The largest count of one quantity that steps uphill from random starts lead to.
double climb(std::size_t quantity) {
  double highest = 0.0;
  for (std::size_t start = 0; start < lengthened(20); ++start) {
    KeyedRandom random(kSeed, "segment climbs", start);
    const auto bell = [&random] { return random.between(-1.0, 1.0) + random.between(-1.0, 1.0); };
    SegmentParameters best{};
    double largest = 0.0;
    while (largest == 0.0) {
      for (double& parameter : best) {
        parameter = 2.0 * bell();
      }
      if (const std::optional<Counts> counts = countOf(best)) {
        largest = (*counts)[quantity];
      }
    }
    double step = 0.5;
    for (int i = 0; i < 600; ++i) {
      SegmentParameters next = best;
      for (double& parameter : next) {
        parameter += random.below(2) == 0 ? step * bell() : 0.0;
      }
      const std::optional<Counts> counts = countOf(next);
      if (counts && (*counts)[quantity] > largest) {
        largest = (*counts)[quantity];
        best = next;
        step *= 1.2;
      } else {
        step = step < 1e-3 ? 0.3 : step * 0.985;
      }
    }
    highest = std::max(highest, largest);
  }
  return highest;
}

TEST(SegmentErrorCount, OfTheWorstSegmentsFoundIsBelowTheConstant) {
  const Counts counts{climb(0), climb(1), climb(2), climb(3), climb(4)};
  const auto [most, along_tangent] = endErrors();
  std::cout << "worst segments, seed " << kSeed << ": irradiance " << counts[0] << ", gradient " << counts[1]
            << ", Hessian " << counts[2] << ", tangential Hessian " << counts[3] << ", rotational gradient "
            << counts[4] << " of " << most << " u, of the last two " << along_tangent << " u\n";
  EXPECT_EQ(most, 24.0);
  EXPECT_EQ(along_tangent, 40.0);
  for (std::size_t quantity = 0; quantity < counts.size(); ++quantity) {
    const double count = counts[quantity];
    EXPECT_LE(count, quantity >= 3 ? along_tangent : most);
    // A search that does not climb shows nothing.
    EXPECT_GT(count, 15.0);
  }
}

}  // namespace
}  // namespace irradiff
