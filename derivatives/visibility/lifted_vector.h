#pragma once

#include "derivatives/boundary/vector.h"

#include <Eigen/Core>

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

}  // namespace irradiff
