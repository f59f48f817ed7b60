#pragma once

#include "derivatives/boundary/scalar.h"

#include <cmath>
#include <numbers>

namespace irradiff {

/// pi in any scalar.
template <class Scalar>
Scalar pi() {
  using std::atan2;
  if constexpr (std::is_floating_point_v<Scalar>) {
    return std::numbers::pi_v<Scalar>;
  } else {
    return atan2(lift<Scalar>(0.0), lift<Scalar>(-1.0));
  }
}

}  // namespace irradiff
