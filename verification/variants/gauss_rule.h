#pragma once

#include "derivatives/boundary/gauss_legendre.h"

#include <array>
#include <cstddef>

namespace irradiff {

/// Gauss-Legendre nodes in (0, 1) and weights, which sum to 1, to the precision of Scalar.
template <class Scalar, std::size_t kCount>
struct GaussRule {
  std::array<Scalar, kCount> nodes;
  std::array<Scalar, kCount> weights;
};

/// The rule of gaussLegendre(kCount), its nodes sharpened by a step of Newton's method in long double.
template <class Scalar, std::size_t kCount>
const GaussRule<Scalar, kCount>& gaussRule() {
  static const GaussRule<Scalar, kCount> rule = [] {
    GaussRule<Scalar, kCount> result;
    for (std::size_t i = 0; i < kCount; ++i) {
      long double x = 1.0L - 2.0L * static_cast<long double>(gaussLegendre(kCount).nodes[i]);
      long double slope = 0.0L;
      for (int step = 0; step < 2; ++step) {
        long double previous = 1.0L;
        long double value = x;
        for (std::size_t k = 2; k <= kCount; ++k) {
          const auto degree = static_cast<long double>(k);
          const long double next = ((2.0L * degree - 1.0L) * x * value - (degree - 1.0L) * previous) / degree;
          previous = value;
          value = next;
        }
        slope = static_cast<long double>(kCount) * (x * value - previous) / (x * x - 1.0L);
        x -= value / slope;
      }
      result.nodes[i] = static_cast<Scalar>(0.5L * (1.0L - x));
      result.weights[i] = static_cast<Scalar>(1.0L / ((1.0L - x * x) * slope * slope));
    }
    return result;
  }();
  return rule;
}

}  // namespace irradiff
