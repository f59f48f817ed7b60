#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace irradiff {

/// A derivative by differences, and an estimate of its own error.
template <class Scalar>
struct DifferenceResult {
  Scalar value;
  Scalar error;  ///< not a proof: the spread of the extrapolation, at least the rounding error of the difference
};

/// The first derivative of f at 0 by central differences with steps h, h/2, h/4, ... extrapolated to 0 (Ridders 1982,
/// "Accurate computation of F'(x) and F'(x)F''(x)", Advances in Engineering Software 4). Keeps the entry of Neville's
/// table whose neighbours differ least.
///
/// `evaluation_error` is the absolute error of one evaluation of f: it bounds from below what can be claimed. Requires
/// f analytic within about 2h.
template <class Scalar, class Function>
DifferenceResult<Scalar> riddersDerivative(const Function& f, const Scalar& h, const Scalar& evaluation_error) {
  using std::abs;
  constexpr std::size_t kLevels = 10;
  std::array<std::array<Scalar, kLevels>, kLevels> table;
  DifferenceResult<Scalar> best{Scalar(0), Scalar(0)};
  bool has_best = false;
  Scalar step = h;
  for (std::size_t i = 0; i < kLevels; ++i) {
    const Scalar rounding = evaluation_error / step;
    table[i][0] = (f(step) - f(-step)) / (Scalar(2) * step);
    Scalar factor(4);
    for (std::size_t j = 1; j <= i; ++j) {
      table[i][j] = (factor * table[i][j - 1] - table[i - 1][j - 1]) / (factor - Scalar(1));
      factor = factor * Scalar(4);
      const Scalar to_left = abs(table[i][j] - table[i][j - 1]);
      const Scalar to_above = abs(table[i][j] - table[i - 1][j - 1]);
      // The weights of one row sum to less than 2 in magnitude, so the table amplifies the rounding of its finest
      // difference at most twofold.
      const Scalar error = (to_left < to_above ? to_above : to_left) + Scalar(2) * rounding;
      if (!has_best || error < best.error) {
        best = {table[i][j], error};
        has_best = true;
      }
    }
    step = step / Scalar(2);
  }
  return best;
}

}  // namespace irradiff
