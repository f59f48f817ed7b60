// The edge kernel for short arcs: its truncation against 100 digits of the kernel in angles, and the count of its
// roundings by machine. docs/derivations/sample_estimators.md, "Short arcs".

#include "derivatives/boundary/chord_arc.h"

#include "derivatives/boundary/edge_kernel.h"
#include "tests/boundary/tracked_scalar.h"
#include "verification/checks/random.h"

#include <boost/multiprecision/mpfr.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>

namespace irradiff {
namespace {

using Digits100 =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<100>, boost::multiprecision::et_off>;

constexpr std::uint64_t kSeed = 20120807;
constexpr double kUnitRoundoff = 0x1p-53;

template <class Scalar>
struct FrameArc {
  FrameEnd<Scalar> first, last;
};

/// A random arc above the horizon with sin^2(D/2) = half_chord_square, D in (0, pi), at 100 digits. Inverse distances
/// vary over six decades; every fourth end is on the horizon.
FrameArc<Digits100> drawArc(KeyedRandom& random, double half_chord_square) {
  using Vector = Vector3<Digits100>;
  const auto unit = [&random] {
    const Eigen::Vector3d v = random.direction();
    const Vector w(v(0), v(1), v(2));
    return Vector(scaled(w, Digits100(1 / norm(w))));
  };
  const Digits100 sine = sqrt(Digits100(half_chord_square) * (1 - Digits100(half_chord_square))) * 2;
  const Digits100 cosine = 1 - 2 * Digits100(half_chord_square);
  while (true) {
    Vector w0 = unit();
    if (random.below(4) == 0) {
      w0(2) = 0;
      w0 = scaled(w0, Digits100(1 / norm(w0)));
    }
    const Vector across = cross(w0, unit());
    const Vector side = scaled(across, Digits100(1 / norm(across)));
    const Vector w1 = scaled(w0, cosine) + scaled(side, sine);
    if (w0(2) < 0 || w1(2) < 0) continue;
    return {{w0(0), w0(1), w0(2), random.decade(-6.0, 0.0)}, {w1(0), w1(1), w1(2), random.decade(-6.0, 0.0)}};
  }
}

template <class Scalar, class Convert>
FrameArc<Scalar> converted(const FrameArc<Digits100>& arc, const Convert& convert) {
  const auto end = [&convert](const FrameEnd<Digits100>& e) {
    return FrameEnd<Scalar>{convert(e.t), convert(e.b), convert(e.n), convert(e.inverse_distance)};
  };
  return {end(arc.first), end(arc.last)};
}

struct Reference {
  Vector3<Digits100> gradient;
  Matrix3<Digits100> hessian;  ///< symmetric part
  Digits100 gradient_size, hessian_size, tangential_size;
};

Reference referenceOf(const FrameArc<Digits100>& arc) {
  const auto end = [](const FrameEnd<Digits100>& e) {
    return ArcEnd<Digits100>{Vector3<Digits100>(e.t, e.b, e.n), e.inverse_distance, e.n};
  };
  BoundaryArc<Digits100> plain{};
  plain.first = end(arc.first);
  plain.last = end(arc.last);
  const Vector3<Digits100> moment = cross(plain.first.direction, plain.last.direction);
  const Vector3<Digits100> normal(0, 0, 1);
  plain.plane_normal = scaled(moment, Digits100(1 / norm(moment)));
  plain.turned_plane_normal = cross(normal, plain.plane_normal);
  plain.angle = atan2(norm(moment), dot(plain.first.direction, plain.last.direction));
  plain.edge_direction = Vector3<Digits100>::Constant(0);  // antisymmetric part only
  const ArcTerms<Digits100> terms = arcTerms(plain, normal);
  Reference reference{terms.gradient, terms.hessian, terms.gradient_size, terms.hessian_size,
                      terms.tangential_size / terms.turned_size * plain.angle};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) reference.hessian(i, j) = (terms.hessian(i, j) + terms.hessian(j, i)) / 2;
  }
  return reference;
}

/// Largest of something over gradient, Hessian and tangential Hessian, each relative to its size.
struct LargestErrors {
  double gradient = 0.0;
  double hessian = 0.0;
  double tangential = 0.0;

  double largest() const { return std::max({gradient, hessian, tangential}); }
};

/// `errorOf` of an entry and its reference, absolute.
template <class Scalar, class ErrorOf>
void update(LargestErrors& errors, const FrameTerms<Scalar>& terms, const Reference& reference,
            const ErrorOf& errorOf) {
  const auto relative = [&errorOf](const Scalar& entry, const Digits100& exact, const Digits100& size) {
    return errorOf(entry, exact) / static_cast<double>(size);
  };
  const Vector3<Digits100>& g = reference.gradient;
  const Matrix3<Digits100>& h = reference.hessian;
  errors.gradient =
      std::max({errors.gradient, relative(terms.t, g(0), reference.gradient_size),
                relative(terms.b, g(1), reference.gradient_size), relative(terms.n, g(2), reference.gradient_size)});
  errors.tangential = std::max({errors.tangential, relative(terms.tt, h(0, 0), reference.tangential_size),
                                relative(terms.tb, 2 * h(0, 1), 2 * reference.tangential_size),
                                relative(terms.bb, h(1, 1), reference.tangential_size)});
  errors.hessian = std::max({errors.hessian, relative(terms.tn, 2 * h(0, 2), 2 * reference.hessian_size),
                             relative(terms.bn, 2 * h(1, 2), 2 * reference.hessian_size),
                             relative(terms.nn, h(2, 2), reference.hessian_size)});
}

/// Truncation: in long double, where roundings are a thousandth of double's.
template <class Terms>
double largestTruncation(double half_chord_square) {
  LargestErrors errors;
  for (std::size_t i = 0; i < 1000; ++i) {
    KeyedRandom random(kSeed, "truncation", i);
    const FrameArc<Digits100> arc = drawArc(random, half_chord_square);
    const auto narrow = converted<long double>(arc, [](const Digits100& x) { return static_cast<long double>(x); });
    const auto terms = chordArcTerms<Terms, long double>(narrow.first, narrow.last, half_chord_square, 1.0L);
    update(errors, terms, referenceOf(arc), [](long double entry, const Digits100& exact) {
      return std::abs(static_cast<double>(Digits100(entry) - exact));
    });
  }
  return errors.largest();
}

template <class Terms>
void expectTruncationWithin(double share_of_roundoff) {
  const double within = largestTruncation<Terms>(Terms::kHalfChordSquare);
  const double beyond = largestTruncation<Terms>(4.0 * Terms::kHalfChordSquare);
  std::cout << Terms::kTerms << " terms: largest error " << within / kUnitRoundoff << " u at the longest arc, "
            << beyond / kUnitRoundoff << " u at one of twice the length\n";
  EXPECT_LE(within, share_of_roundoff * kUnitRoundoff);
  EXPECT_GT(beyond, share_of_roundoff * kUnitRoundoff) << "the test must see a series that is too short";
}

TEST(ChordArc, SeriesLeavesLessThanAQuarterOfARounding) {
  // The coefficients and 1/12, rounded to double, are most of it.
  expectTruncationWithin<FewChordTerms>(0.25);
  expectTruncationWithin<ManyChordTerms>(0.25);
}

template <class Terms>
LargestErrors largestCounts(std::size_t draws) {
  LargestErrors counts;
  for (std::size_t i = 0; i < draws; ++i) {
    KeyedRandom random(kSeed, "counts", i);
    const double half_chord_square = Terms::kHalfChordSquare * random.decade(-8.0, 0.0);
    const FrameArc<Digits100> arc = drawArc(random, half_chord_square);
    const ErrorTape tape;
    const auto tracked =
        converted<Tracked>(arc, [](const Digits100& x) { return Tracked::input(static_cast<long double>(x)); });
    const auto terms = chordArcTerms<Terms, Tracked>(
        tracked.first, tracked.last, halfChordSquare<Tracked>(tracked.first, tracked.last), Tracked::input(1.0L));
    update(counts, terms, referenceOf(arc), [](const Tracked& entry, const Digits100&) { return entry.worstError(); });
  }
  return counts;
}

/// What the series' coefficients and its end add.
constexpr double kSeriesErrors = 1.0;

TEST(ChordArc, CountOfRoundingsIsBelowTheOneStated) {
  for (const LargestErrors& counts : {largestCounts<FewChordTerms>(400), largestCounts<ManyChordTerms>(400)}) {
    std::cout << "count: gradient " << counts.gradient << ", Hessian " << counts.hessian << ", tangential Hessian "
              << counts.tangential << " u\n";
    EXPECT_LE(counts.largest() + kSeriesErrors, kChordArcError);
    EXPECT_GT(counts.largest(), 0.5 * kChordArcError) << "the bound says nothing";
  }
}

}  // namespace
}  // namespace irradiff
