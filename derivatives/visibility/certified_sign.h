#pragma once

#include "derivatives/boundary/vector.h"
#include "derivatives/scene/bounded_number.h"
#include "derivatives/scene/exact_number.h"

#include <Eigen/Core>

#include <type_traits>

namespace irradiff {

/// The position as exact numbers of type Number.
template <class Number>
Vector3<Number> lifted(const Eigen::Vector3d& position) {
  return {Number(position(0)), Number(position(1)), Number(position(2))};
}

/// a.(b x c).
template <class Number>
Number determinant(const Vector3<Number>& a, const Vector3<Number>& b, const Vector3<Number>& c) {
  return dot(a, cross(b, c));
}

/// The sign of what `formula` computes from exact input, -1, 0 or 1, without error: formula(std::type_identity<Number>)
/// runs at BoundedNumber first, and at ExactNumber where that cannot tell.
template <class Formula>
int certifiedSign(const Formula& formula) {
  const BoundedNumber bounded = formula(std::type_identity<BoundedNumber>{});
  return bounded.hasSign() ? bounded.sign() : formula(std::type_identity<ExactNumber>{}).sign();
}

}  // namespace irradiff
