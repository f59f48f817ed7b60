// The count of rounding errors of the boundary form by machine: the library's own templates at a scalar that carries
// every rounding, docs/derivations/error_bounds.md, sections 2.4 to 2.8.

#include "derivatives/boundary/boundary_sums.h"
#include "derivatives/boundary/edge_arcs.h"
#include "tests/boundary/edge_views.h"
#include "tests/boundary/tracked_scalar.h"
#include "verification/checks/input_families.h"

#include <gtest/gtest.h>

#include <iostream>
#include <string_view>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 20120806;
constexpr double kUnitRoundoff = 0x1p-53;
/// The coefficients of the moments' series, which are constants of the program, are rounded themselves.
constexpr double kSeriesCoefficients = 1.0;
/// The horizon's share of irradiance is added last, where there is any.
constexpr double kHorizonSum = 1.0;

/// Worst-case errors in units of u, relative to the sizes.
struct ErrorCount {
  double irradiance = 0.0;
  double gradient = 0.0;
  double hessian = 0.0;
  double tangential_hessian = 0.0;
  double rotational_gradient = 0.0;

  static ErrorCount larger(const ErrorCount& a, const ErrorCount& b) {
    return {std::max(a.irradiance, b.irradiance), std::max(a.gradient, b.gradient), std::max(a.hessian, b.hessian),
            std::max(a.tangential_hessian, b.tangential_hessian),
            std::max(a.rotational_gradient, b.rotational_gradient)};
  }
};

void print(std::string_view what, const ErrorCount& count) {
  std::cout << what << ", seed " << kSeed << ": irradiance " << count.irradiance << ", gradient " << count.gradient
            << ", Hessian " << count.hessian << ", tangential Hessian " << count.tangential_hessian
            << ", rotational gradient " << count.rotational_gradient << " u\n";
}

template <class Scalar, class WideScalar>
Vector3<WideScalar> exactInput(const Vector3<double>& v) {
  return {WideScalar::input(v(0)), WideScalar::input(v(1)), WideScalar::input(v(2))};
}

template <class Scalar>
ErrorCount countOf(const BoundarySums<Scalar>& sums) {
  ErrorCount count;
  count.irradiance = sums.derivatives.irradiance.value.worstError();
  for (int i = 0; i < 3; ++i) {
    count.gradient = std::max(count.gradient, sums.derivatives.gradient.value(i).worstError());
    count.rotational_gradient =
        std::max(count.rotational_gradient, sums.derivatives.rotational_gradient.value(i).worstError());
    for (int j = 0; j <= i; ++j) {
      count.hessian = std::max(count.hessian, sums.derivatives.hessian.value(i, j).worstError());
    }
  }
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b <= a; ++b) {
      count.tangential_hessian =
          std::max(count.tangential_hessian, sums.derivatives.tangential_hessian.value(a, b).worstError());
    }
  }
  count.irradiance /= static_cast<double>(sums.irradiance_size.value());
  count.gradient /= static_cast<double>(sums.gradient_size.value());
  count.hessian /= static_cast<double>(sums.hessian_size.value());
  count.tangential_hessian /= static_cast<double>(sums.tangential_size.value());
  count.rotational_gradient /= static_cast<double>(sums.rotational_size.value());
  return count;
}

/// The sums over the one or two arcs of an edge. With WideScalar = Scalar, what cancels is not computed in doubled
/// precision.
template <class Scalar, class WideScalar = Wide<Scalar>>
BoundarySums<Scalar> trackedSums(const EdgeView& view) {
  const auto normal = exactInput<Scalar, Scalar>(view.normal);
  const auto vertex = [&normal](const Vector3<double>& r, double height) {
    const Vector3<WideScalar> position = exactInput<Scalar, WideScalar>(r);
    if (height == 0.0) {
      return ClippedVertex<Scalar, WideScalar>{position, lift<Scalar>(0.0)};
    }
    Vector3<WideScalar> wide_normal;
    for (int i = 0; i < 3; ++i) {
      wide_normal(i) = WideScalar(normal(i));
    }
    return ClippedVertex<Scalar, WideScalar>{position, static_cast<Scalar>(dot(wide_normal, position))};
  };
  RadianceBoundary<Scalar> boundary;
  appendEdgeArcs(vertex(view.start, view.start_height), vertex(view.end, view.end_height), normal, lift<Scalar>(1.0),
                 boundary.arcs);
  return boundarySums(boundary, normal);
}

template <class Scalar, class WideScalar = Wide<Scalar>>
ErrorCount countOf(const EdgeView& view) {
  const ErrorTape tape;
  return countOf(trackedSums<Scalar, WideScalar>(view));
}

std::optional<EdgeView> drawEdge(std::string_view stream, std::size_t index) {
  KeyedRandom random(kSeed, stream, index);
  return edgeView(drawEdgeParameters(random));
}

struct ArcCounts {
  ErrorCount whole, cut;
};

template <class Scalar>
ArcCounts countRandomArcs(std::size_t draws) {
  ArcCounts worst;
  for (std::size_t i = 0; i < draws; ++i) {
    if (const std::optional<EdgeView> view = drawEdge("arcs", i)) {
      ErrorCount& count = view->angle > kLongestArc ? worst.cut : worst.whole;
      count = ErrorCount::larger(count, countOf<Scalar>(*view));
    }
  }
  return worst;
}

/// The largest count that steps from random starts lead to, each uphill in the quantity that `objective` names.
double climb(double ErrorCount::*objective, bool cut, std::size_t start) {
  KeyedRandom random(kSeed, cut ? "climbs of cut arcs" : "climbs", start);
  const auto value = [&](const EdgeParameters& parameters) {
    const std::optional<EdgeView> view = edgeView(parameters);
    return view && (view->angle > kLongestArc) == cut ? countOf<Tracked>(*view).*objective : 0.0;
  };
  EdgeParameters best{};
  double largest = 0.0;
  while (largest == 0.0) {
    best = drawEdgeParameters(random);
    largest = value(best);
  }
  double step = 0.5;
  for (int i = 0; i < 600; ++i) {
    EdgeParameters next = best;
    for (double& parameter : next) {
      parameter += random.below(5) < 2 ? step * (1.0 + std::abs(parameter)) * bellShaped(random) : 0.0;
    }
    if (random.below(10) == 0) {
      next[7 + random.below(2)] = 0.0;
    }
    const double reached = value(next);
    if (reached > largest) {
      largest = reached;
      best = next;
      step *= 1.2;
    } else {
      step = step < 1e-3 ? 0.3 : step * 0.985;
    }
  }
  return largest;
}

ErrorCount climbEverything(bool cut) {
  ErrorCount worst;
  for (double ErrorCount::*objective : {&ErrorCount::irradiance, &ErrorCount::gradient, &ErrorCount::hessian,
                                        &ErrorCount::tangential_hessian, &ErrorCount::rotational_gradient}) {
    for (std::size_t start = 0; start < lengthened(8); ++start) {
      worst.*objective = std::max(worst.*objective, climb(objective, cut, start));
    }
  }
  return worst;
}

/// One arc's irradiance has no moments in it, so no series either.
void expectWithinConstants(const ErrorCount& count) {
  EXPECT_LE(count.irradiance + kHorizonSum, kAngleError);
  EXPECT_LE(count.gradient + kSeriesCoefficients, kArcError);
  EXPECT_LE(count.hessian + kSeriesCoefficients, kArcError);
  EXPECT_LE(count.tangential_hessian + kSeriesCoefficients, kTangentialError);
  EXPECT_LE(count.rotational_gradient, kAngleError);
}

TEST(ErrorCount, OfRandomArcsIsBelowTheConstants) {
  const ArcCounts worst = countRandomArcs<Tracked>(lengthened(20000));
  print("random arcs up to 2 rad", worst.whole);
  print("random arcs cut at the foot", worst.cut);
  expectWithinConstants(worst.whole);
  expectWithinConstants(worst.cut);
}

TEST(ErrorCount, OfTheWorstArcsFoundIsBelowTheConstants) {
  const ErrorCount whole = climbEverything(false);
  const ErrorCount cut = climbEverything(true);
  print("worst arcs up to 2 rad", whole);
  print("worst arcs cut at the foot", cut);
  expectWithinConstants(whole);
  expectWithinConstants(cut);
}

/// The smallest fraction that r x e or a height over the horizon cancels to, as a sine.
double leastSine(const EdgeView& view) {
  const Vector3<double>& nearer = view.start.norm() <= view.end.norm() ? view.start : view.end;
  const Vector3<double> edge = view.end - view.start;
  double sine = nearer.cross(edge).norm() / (nearer.norm() * edge.norm());
  for (const auto& [height, distance] :
       {std::pair{view.start_height, view.start.norm()}, std::pair{view.end_height, view.end.norm()}}) {
    sine = height > 0.0 ? std::min(sine, height / distance) : sine;
  }
  return sine;
}

/// The count is what it claims to be: no entry of a result in double is off by more.
TEST(ErrorCount, BoundsTheErrorsOfDoublePrecision) {
  // The values without rounding errors are in long double: they have the same errors times 2^-11, and what cancels to a
  // sixteenth at most has 3 * 16 * 2^-11 u more, which the angle of a long arc enlarges up to five times.
  constexpr double kLeastSine = 1.0 / 16.0;
  constexpr double kReferenceCount = 1.0 + 0x1p-11;
  constexpr double kReferenceCancellation = 0.125;
  double closest = 0.0;
  std::size_t compared = 0;
  const std::size_t draws = lengthened(4000);
  for (std::size_t index = 0; index < draws; ++index) {
    const std::optional<EdgeView> view = drawEdge("arcs", index);
    if (!view || leastSine(*view) < kLeastSine) {
      continue;
    }
    using Word = DoubleWord<double>;
    RadianceBoundary<double> boundary;
    appendEdgeArcs(ClippedVertex<double>{widen<Word, double, 3>(view->start), view->start_height},
                   ClippedVertex<double>{widen<Word, double, 3>(view->end), view->end_height}, view->normal, 1.0,
                   boundary.arcs);
    const BoundarySums<double> actual = boundarySums(boundary, view->normal);
    const ErrorTape tape;
    const BoundarySums<Tracked> expected = trackedSums<Tracked>(*view);
    const auto compare = [&](double value, const Tracked& tracked, double size, double series) {
      const double bound =
          (tracked.worstError() * kReferenceCount + (series + kReferenceCancellation) * size) * kUnitRoundoff;
      const auto error = static_cast<double>(std::abs(value - tracked.value()));
      EXPECT_LE(error, bound) << "arc " << index;
      closest = std::max(closest, error / bound);
    };
    compare(actual.derivatives.irradiance.value, expected.derivatives.irradiance.value, actual.irradiance_size, 0.0);
    for (int i = 0; i < 3; ++i) {
      compare(actual.derivatives.rotational_gradient.value(i), expected.derivatives.rotational_gradient.value(i),
              actual.rotational_size, 0.0);
      compare(actual.derivatives.gradient.value(i), expected.derivatives.gradient.value(i), actual.gradient_size,
              kSeriesCoefficients);
      for (int j = 0; j < 3; ++j) {
        compare(actual.derivatives.hessian.value(i, j), expected.derivatives.hessian.value(i, j), actual.hessian_size,
                kSeriesCoefficients);
      }
    }
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2; ++b) {
        compare(actual.derivatives.tangential_hessian.value(a, b), expected.derivatives.tangential_hessian.value(a, b),
                actual.tangential_size, kSeriesCoefficients);
      }
    }
    ++compared;
  }
  std::cout << "largest error in double over its count in " << compared << " arcs, seed " << kSeed << ": " << closest
            << '\n';
  // Were the count that of another formula or in another unit, no error would come near it.
  EXPECT_GT(closest, 0.2);
}

/// Closed forms of the moments subtract: the shorter the arc, the more is lost.
TEST(ErrorCount, RejectsClosedFormsOfTheMoments) {
  for (const double angle : {0.1, 0.05, 0.01}) {
    const std::optional<EdgeView> view =
        edgeView({0.0, std::atanh(2.0 * angle / std::numbers::pi), 1.0, 0.5, 0.3, 0.1, 0.0, 1.0, 0.7, 0.4});
    ASSERT_TRUE(view.has_value());
    expectWithinConstants(countOf<Tracked>(*view));
    const ErrorCount careless = countOf<TrackedClosedForms>(*view);
    std::cout << "closed forms at " << view->angle << " rad: gradient " << careless.gradient << ", Hessian "
              << careless.hessian << " u\n";
    EXPECT_GT(careless.gradient, kArcError);
    EXPECT_GT(careless.hessian, kArcError);
  }
}

/// r x e of an edge that points almost at the receiver cancels; in plain double its error does not stay with the size.
TEST(ErrorCount, RejectsCancellationInPlainDouble) {
  ErrorCount worst;
  for (std::size_t i = 0; i < 200; ++i) {
    KeyedRandom random(kSeed, "almost radial", i);
    EdgeParameters parameters = drawEdgeParameters(random);
    parameters[0] = random.between(3.2, 3.6);
    parameters[1] = parameters[0] + random.between(0.3, 1.0);
    if (const std::optional<EdgeView> view = edgeView(parameters)) {
      expectWithinConstants(countOf<Tracked>(*view));
      const ErrorCount careless = countOf<Tracked, Tracked>(*view);
      EXPECT_GT(careless.gradient, kArcError) << i;
      worst = ErrorCount::larger(worst, careless);
    }
  }
  print("r x e of almost radial edges in plain double", worst);
  EXPECT_GT(worst.hessian, kArcError);
}

}  // namespace
}  // namespace irradiff
