#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>

namespace irradiff {

/// A sum of up to `Capacity` terms (a product is two), held without error as an expansion: components of increasing
/// magnitude that do not overlap (Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust
/// geometric predicates", GROW-EXPANSION). Requires that no sum overflows and no product overflows or underflows.
template <std::floating_point T, std::size_t Capacity>
class ExactSum {
 public:
  void add(T term) {
    for (std::size_t i = 0; i < size_; ++i) {
      const T sum = components_[i] + term;
      const T from_term = sum - components_[i];
      components_[i] = (components_[i] - (sum - from_term)) + (term - from_term);
      term = sum;
    }
    components_[size_++] = term;
  }

  void addProduct(T a, T b) {
    const T product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }

  /// The sign is that of the largest component that is not zero.
  int sign() const {
    for (std::size_t i = size_; i-- > 0;) {
      if (components_[i] != 0) return (components_[i] > 0) - (components_[i] < 0);
    }
    return 0;
  }

  /// The sum as head + tail, |tail| <= ulp(head), with a relative error of a few u^2.
  struct Rounded {
    T head;
    T tail;
  };
  Rounded rounded() const {
    // Shewchuk's COMPRESS from the largest component down: what the head cannot take goes into the tail.
    T head = 0;
    T tail = 0;
    for (std::size_t i = size_; i-- > 0;) {
      const T sum = head + components_[i];
      tail += components_[i] - (sum - head);
      head = sum;
    }
    const T sum = head + tail;
    return {sum, tail - (sum - head)};
  }

 private:
  std::array<T, Capacity> components_{};
  std::size_t size_ = 0;
};

}  // namespace irradiff
