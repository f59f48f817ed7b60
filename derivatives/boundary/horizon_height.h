#pragma once

#include "derivatives/boundary/vector.h"
#include "derivatives/scene/exact_sum.h"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <type_traits>

namespace irradiff {

namespace detail {

template <std::floating_point Scalar, int Dimension>
DoubleWord<Scalar> exactHorizonHeight(const Eigen::Matrix<Scalar, Dimension, 1>& vertex,
                                      const Eigen::Matrix<Scalar, Dimension, 1>& position,
                                      const Eigen::Matrix<Scalar, Dimension, 1>& normal) {
  ExactSum<Scalar, std::size_t{4} * Dimension> sum;
  for (int i = 0; i < Dimension; ++i) {
    sum.addProduct(normal(i), vertex(i));
    sum.addProduct(-normal(i), position(i));
  }
  const auto [head, tail] = sum.rounded();
  return {head, tail};
}

}  // namespace detail

/// The height n.(vertex - position) of a vertex over the receiver's horizon, in metres times |n|. For machine numbers
/// its relative error is below u/512 and its sign exact however close the vertex is to the horizon: what lies above
/// must not depend on rounding. Requires that products of coordinates and components of the normal neither overflow nor
/// underflow.
template <class WideScalar, class Scalar, int Dimension>
WideScalar horizonHeight(const Eigen::Matrix<Scalar, Dimension, 1>& vertex,
                         const Eigen::Matrix<Scalar, Dimension, 1>& position,
                         const Eigen::Matrix<Scalar, Dimension, 1>& normal) {
  const Eigen::Matrix<WideScalar, Dimension, 1> r = wideDifference<WideScalar>(vertex, position);
  WideScalar height = dot(widen<WideScalar>(normal), r);
  if constexpr (std::is_floating_point_v<Scalar> && !std::is_floating_point_v<WideScalar>) {
    // The sum of doubled products is right to 16 u^2 of the terms' sizes.
    constexpr Scalar kGrazing = static_cast<Scalar>(0x1p-40);
    Scalar size = 0;
    for (int i = 0; i < Dimension; ++i) {
      size += std::abs(normal(i) * r(i).hi);
    }
    if (std::abs(height.hi) < kGrazing * size) {
      return detail::exactHorizonHeight<Scalar, Dimension>(vertex, position, normal);
    }
  }
  return height;
}

}  // namespace irradiff
