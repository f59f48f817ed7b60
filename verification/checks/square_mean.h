#pragma once

#include <functional>

namespace irradiff {

struct SquareMean {
  double value = 0.0;
  double error = 0.0;  ///< estimate, of a rule that is poorer than the one used
};

/// Mean of `f` over the unit square by Gauss-Legendre on cells that are bisected where 8 and 12 points to a side differ
/// most, across the side that is longer when the square's sides are `side_s` and `side_t` long. Stops when the estimate
/// is at most `allowed`, or at 400 cells: the estimate then says what is left. Infinite where `f` is not finite.
SquareMean meanOverUnitSquare(const std::function<double(double, double)>& f, double side_s, double side_t,
                              double allowed);

}  // namespace irradiff
