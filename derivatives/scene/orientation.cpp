#include "derivatives/scene/orientation.h"

#include "derivatives/scene/exact_sum.h"

#include <cmath>
#include <limits>

namespace irradiff {

namespace {

// u, the relative error of one rounding, and Shewchuk's ccwerrboundA.
constexpr double kUnitRoundoff = std::numeric_limits<double>::epsilon() / 2;
constexpr double kFilterError = (3 + 16 * kUnitRoundoff) * kUnitRoundoff;

int sign(double value) { return (value > 0) - (value < 0); }

}  // namespace

int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const double left = (a.x() - c.x()) * (b.y() - c.y());
  const double right = (a.y() - c.y()) * (b.x() - c.x());
  const double determinant = left - right;
  if (std::abs(determinant) > kFilterError * (std::abs(left) + std::abs(right))) return sign(determinant);

  ExactSum<double, 12> exact;
  exact.addProduct(a.x(), b.y());
  exact.addProduct(-a.x(), c.y());
  exact.addProduct(-c.x(), b.y());
  exact.addProduct(-a.y(), b.x());
  exact.addProduct(a.y(), c.x());
  exact.addProduct(c.y(), b.x());
  return exact.sign();
}

}  // namespace irradiff
