#include "derivatives/scene/orientation.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace irradiff {

namespace {

// u, the relative error of one rounding, and Shewchuk's ccwerrboundA.
constexpr double kUnitRoundoff = std::numeric_limits<double>::epsilon() / 2;
constexpr double kFilterError = (3 + 16 * kUnitRoundoff) * kUnitRoundoff;

int sign(double value) { return (value > 0) - (value < 0); }

// A sum held without error as an expansion: components of increasing magnitude that do not overlap
// (Shewchuk 1997, GROW-EXPANSION). Its sign is that of the largest component that is not zero.
class ExactSum {
 public:
  void add(double term) {
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = components_[i] + term;
      const double from_term = sum - components_[i];
      components_[i] = (components_[i] - (sum - from_term)) + (term - from_term);
      term = sum;
    }
    components_[size_++] = term;
  }

  void addProduct(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }

  int sign() const {
    for (std::size_t i = size_; i-- > 0;) {
      if (components_[i] != 0) return irradiff::sign(components_[i]);
    }
    return 0;
  }

 private:
  std::array<double, 12> components_{};
  std::size_t size_ = 0;
};

}  // namespace

int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const double left = (a.x() - c.x()) * (b.y() - c.y());
  const double right = (a.y() - c.y()) * (b.x() - c.x());
  const double determinant = left - right;
  if (std::abs(determinant) > kFilterError * (std::abs(left) + std::abs(right))) return sign(determinant);

  ExactSum exact;
  exact.addProduct(a.x(), b.y());
  exact.addProduct(-a.x(), c.y());
  exact.addProduct(-c.x(), b.y());
  exact.addProduct(-a.y(), b.x());
  exact.addProduct(a.y(), c.x());
  exact.addProduct(c.y(), b.x());
  return exact.sign();
}

}  // namespace irradiff
