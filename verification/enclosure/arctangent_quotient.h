#pragma once

#include "verification/enclosure/ball.h"
#include "verification/enclosure/complex_ball.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace irradiff::enclosure {

/// All numbers of Scalar with magnitude up to `radius`.
template <class Scalar>
Scalar discAroundZero(const Ball& radius) {
  Ball reach = Ball::aroundZero(radius);
  if constexpr (std::is_same_v<Scalar, ComplexBall>) {
    return ComplexBall(reach, reach);
  } else {
    return reach;
  }
}

/// T(z) = atan(sqrt z) / sqrt z and its first three derivatives. T is holomorphic except on (-inf, -1], at z = 0 too.
/// Real z must be >= 0 or have |z| <= 1/2; otherwise, and for a complex ball that meets the cut, the result is not
/// finite.
///
/// Near zero by T = sum (-z)^k / (2k + 1); elsewhere from 2 z T' + T = 1/(1 + z) and its derivatives.
template <class Scalar>
std::array<Scalar, 4> arctangentQuotient(const Scalar& z) {
  const Ball magnitude = z.magnitude();
  if (magnitude <= Ball(0.5)) {
    const double decay = magnitude > Ball::powerOfTwo(-900) ? -std::log2(magnitude.toDouble()) : 900.0;
    const auto count = static_cast<std::size_t>(static_cast<double>(WorkingPrecision::bits()) / decay) + 8;
    // Coefficients of T''' are below (k+2)(k+3)/2, those of T, T', T'' smaller still; with |z| <= 1/2 and count >= 8
    // each remaining term is at most 3/4 of the one before, so that the remainder is at most 4 times its first term.
    Ball power(1);
    for (std::size_t k = 0; k < count; ++k) power *= magnitude;
    const auto first = static_cast<double>(count);
    const Scalar remainder = discAroundZero<Scalar>(Ball(2) * Ball((first + 2) * (first + 3)) * power);

    std::array<Scalar, 4> sums;
    for (std::size_t k = count; k-- > 0;) {
      for (std::size_t order = 0; order < 4; ++order) {
        const std::size_t source = k + order;  // the term of T that differentiates to z^k
        double factor = source % 2 == 0 ? 1.0 : -1.0;
        for (std::size_t j = 0; j < order; ++j) factor *= static_cast<double>(source - j);
        const Ball coefficient = Ball(factor) / Ball(2.0 * static_cast<double>(source) + 1.0);
        sums[order] = sums[order] * z + Scalar(coefficient);
      }
    }
    for (Scalar& sum : sums) sum += remainder;
    return sums;
  }
  const Scalar root = sqrt(z);
  const Scalar t = atan(root) / root;
  const Scalar u = Scalar(1.0) / (Scalar(1.0) + z);
  const Scalar half_inverse = Scalar(0.5) / z;
  const Scalar t1 = (u - t) * half_inverse;
  const Scalar t2 = -(Scalar(3.0) * t1 + u * u) * half_inverse;
  const Scalar t3 = (Scalar(2.0) * u * u * u - Scalar(5.0) * t2) * half_inverse;
  return {t, t1, t2, t3};
}

}  // namespace irradiff::enclosure
