#pragma once

#include "derivatives/scene/bounded_number.h"
#include "derivatives/scene/exact_number.h"

#include <type_traits>

namespace irradiff {

/// The sign of what `formula` computes from exact input, -1, 0 or 1, without error: formula(std::type_identity<Number>)
/// runs at BoundedNumber first, and at ExactNumber where that cannot tell.
template <class Formula>
int certifiedSign(const Formula& formula) {
  const BoundedNumber bounded = formula(std::type_identity<BoundedNumber>{});
  return bounded.hasSign() ? bounded.sign() : formula(std::type_identity<ExactNumber>{}).sign();
}

}  // namespace irradiff
