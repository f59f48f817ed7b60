#pragma once

#include "derivatives/boundary/double_word.h"

#include <concepts>
#include <limits>
#include <type_traits>

namespace irradiff {

/// The constant `value` as a Scalar: a float, a multiprecision number, a ball, or a (nested) automatic-differentiation
/// number whose `Scalar` member type it is a constant of.
template <class Scalar>
Scalar lift(double value) {
  if constexpr (std::is_constructible_v<Scalar, double>) {
    return Scalar(value);
  } else {
    return Scalar(lift<typename Scalar::Scalar>(value));
  }
}

namespace detail {
template <class Scalar>
struct WideOf {
  using Type = Scalar;
};
template <>
struct WideOf<float> {
  using Type = double;
};
template <std::floating_point T>
struct WideOf<T> {
  using Type = DoubleWord<T>;
};
}  // namespace detail

/// The scalar in which geometry that cancels is computed before it is rounded to Scalar: twice the digits for machine
/// numbers, the scalar itself where its precision is the caller's choice.
template <class Scalar>
using Wide = typename detail::WideOf<Scalar>::Type;

/// The difference a - b, exact where WideScalar has the room for it.
template <class WideScalar, class Scalar>
WideScalar wideDifference(const Scalar& a, const Scalar& b) {
  if constexpr (std::is_floating_point_v<Scalar> && !std::is_floating_point_v<WideScalar>) {
    return twoDifference(a, b);
  } else {
    return WideScalar(a) - WideScalar(b);
  }
}

/// Whether x > 0. Scalars that stand for a range of numbers have an overload of their own, which throws where the range
/// does not tell.
template <class Scalar>
bool isPositive(const Scalar& x) {
  return x > lift<Scalar>(0.0);
}

/// `magnitude` with the sign of `sign`. Overloaded as isPositive is: either sign where the range does not tell.
template <class Scalar>
Scalar withSignOf(const Scalar& magnitude, const Scalar& sign) {
  return sign < lift<Scalar>(0.0) ? Scalar(-magnitude) : magnitude;
}

/// Whether Scalar carries at most the 64 bits for which the power series tabulated in long double are exact enough.
template <class Scalar>
inline constexpr bool kIsMachinePrecision =
    std::numeric_limits<Scalar>::is_specialized&& std::numeric_limits<Scalar>::digits <= 64;

}  // namespace irradiff
