#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

namespace irradiff {

/// Least magnitude other than 0 of a coordinate, relative to the largest, and of a component of a unit normal, as
/// powers of 2. The sign of a height over the horizon depends on the last bits of their products, which must not
/// underflow.
inline constexpr int kLeastCoordinate = -500;
inline constexpr int kLeastNormalComponent = -450;

/// The magnitudes of numbers that enter one evaluation.
class CoordinateRange {
 public:
  template <class Derived>
  void include(const Eigen::MatrixBase<Derived>& numbers) {
    for (Eigen::Index i = 0; i < numbers.size(); ++i) {
      const double size = std::abs(numbers(i));
      largest_ = std::max(largest_, size);
      if (size > 0.0) smallest_ = std::min(smallest_, size);
    }
  }

  double largest() const { return largest_; }

  /// What is wrong with the numbers, called `what`, if one other than 0 is below 2^least of the largest; empty if none
  /// is.
  std::string violation(const std::string& what, int least) const {
    if (largest_ == 0.0 || std::ldexp(smallest_, -least) >= largest_) return "";
    std::ostringstream text;
    text.precision(17);
    text << "has a " << what << " of magnitude " << smallest_ << " beside one of " << largest_
         << ": must be 0 or at least 2^" << least << " of the largest";
    return text.str();
  }

 private:
  double largest_ = 0.0;
  double smallest_ = std::numeric_limits<double>::infinity();
};

/// What is wrong with the coordinates of a receiver and a source, whose points are called `point` ("a vertex"), and
/// with the receiver's normal; empty if nothing is.
template <class Derived>
std::string rangeViolation(const CoordinateRange& coordinates, const std::string& point,
                           const Eigen::MatrixBase<Derived>& normal) {
  std::string violation = coordinates.violation("coordinate, or " + point + " has one,", kLeastCoordinate);
  if (!violation.empty()) return violation;
  CoordinateRange components;
  components.include(normal);
  return components.violation("component of its normal", kLeastNormalComponent);
}

}  // namespace irradiff
