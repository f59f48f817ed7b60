#pragma once

#include "derivatives/boundary/scalar.h"

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace irradiff {

/// How a TrackedScalar rounds, and which branches of the formulas it takes.
enum class Arithmetic {
  kMachine,      ///< every operation rounds to 53 digits
  kClosedForms,  ///< rounds likewise, but takes the branches meant for numbers of chosen precision
  kWide          ///< does not round: stands for doubled precision, whose errors are of second order
};

/// The operations of one evaluation at TrackedScalar, from the inputs to the results. There is one tape at a time, made
/// before the first operation and destroyed after the last count.
class ErrorTape {
 public:
  static constexpr std::size_t kExact = std::numeric_limits<std::size_t>::max();

  ErrorTape() : previous_(current_) { current_ = this; }
  ~ErrorTape() { current_ = previous_; }
  ErrorTape(const ErrorTape&) = delete;
  ErrorTape& operator=(const ErrorTape&) = delete;

  static ErrorTape& current() { return *current_; }

  /// Appends a result with its partial derivatives with respect to its operands and the largest error, in units of u,
  /// that rounding it makes. Returns its place, kExact if nothing on which it depends was rounded.
  std::size_t append(std::size_t first, double first_slope, std::size_t second, double second_slope, double rounding) {
    if (first == kExact && second == kExact && rounding == 0.0) {
      return kExact;
    }
    operations_.push_back({first, second, first_slope, second_slope, rounding});
    return operations_.size() - 1;
  }

  /// The absolute error of the result at `place`, in units of u and to first order, when every rounding that led to it
  /// is as large as it may be and of the worse sign.
  double worstError(std::size_t place) const {
    if (place == kExact) {
      return 0.0;
    }
    std::vector<double> slopes(place + 1, 0.0);
    slopes[place] = 1.0;
    double error = 0.0;
    for (std::size_t i = place + 1; i-- > 0;) {
      const Operation& operation = operations_[i];
      error += std::abs(slopes[i]) * operation.rounding;
      if (operation.first != kExact) {
        slopes[operation.first] += slopes[i] * operation.first_slope;
      }
      if (operation.second != kExact) {
        slopes[operation.second] += slopes[i] * operation.second_slope;
      }
    }
    return error;
  }

 private:
  struct Operation {
    std::size_t first, second;
    double first_slope, second_slope;
    double rounding;
  };
  std::vector<Operation> operations_;
  ErrorTape* previous_;
  static inline thread_local ErrorTape* current_ = nullptr;
};

/// A number that counts rounding errors by machine: its value without them, in long double, and its place on the tape.
/// Sums, products, quotients and roots err by at most u relative to their result, sin, cos and atan2 by 2 u
/// (docs/derivations/error_bounds.md, section 1). Constants of the program are exact, as are sums with the constant 0,
/// products with a constant power of two, and what constants add and multiply up to where a double holds it. Every
/// other operation counts, also where a lucky one would be exact.
template <Arithmetic kArithmetic>
class TrackedScalar {
 public:
  TrackedScalar() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): constants of the program.
  TrackedScalar(double constant) : value_(constant), is_constant_(true) {}

  /// The same number in the other arithmetic, with one rounding on the way out of the wide one.
  template <Arithmetic kOther>
  explicit TrackedScalar(const TrackedScalar<kOther>& other)
      : value_(other.value()), place_(other.place()), is_constant_(other.isConstant()) {
    if (kOther == Arithmetic::kWide && !is_constant_) {
      place_ = ErrorTape::current().append(place_, 1.0, ErrorTape::kExact, 0.0, roundingOf(value_, 1.0));
    }
  }

  /// An input that is given exactly, or with the relative error of `units` u.
  static TrackedScalar input(long double value, double units = 0.0) {
    return {value, ErrorTape::kExact, 0.0L, ErrorTape::kExact, 0.0L, units};
  }

  long double value() const { return value_; }
  std::size_t place() const { return place_; }
  bool isConstant() const { return is_constant_; }
  /// Largest absolute error in units of u, to first order.
  double worstError() const { return ErrorTape::current().worstError(place_); }

  friend TrackedScalar operator+(const TrackedScalar& a, const TrackedScalar& b) {
    if (a.is_constant_ && a.value_ == 0.0L) {
      return b;
    }
    if (b.is_constant_ && b.value_ == 0.0L) {
      return a;
    }
    const long double sum = a.value_ + b.value_;
    if (isConstantResult(a, b, sum)) {
      return static_cast<double>(sum);
    }
    return {sum, a.place_, 1.0L, b.place_, 1.0L, 1.0};
  }
  friend TrackedScalar operator-(const TrackedScalar& a) {
    if (a.is_constant_) {
      return static_cast<double>(-a.value_);
    }
    return {-a.value_, a.place_, -1.0L, ErrorTape::kExact, 0.0L, 0.0};
  }
  friend TrackedScalar operator-(const TrackedScalar& a, const TrackedScalar& b) { return a + (-b); }
  friend TrackedScalar operator*(const TrackedScalar& a, const TrackedScalar& b) {
    const long double product = a.value_ * b.value_;
    if (isConstantResult(a, b, product)) {
      return static_cast<double>(product);
    }
    const double units = a.isConstantPowerOfTwo() || b.isConstantPowerOfTwo() ? 0.0 : 1.0;
    return {product, a.place_, b.value_, b.place_, a.value_, units};
  }
  friend TrackedScalar operator/(const TrackedScalar& a, const TrackedScalar& b) {
    const long double quotient = a.value_ / b.value_;
    return {quotient, a.place_, 1.0L / b.value_, b.place_, -quotient / b.value_, b.isConstantPowerOfTwo() ? 0.0 : 1.0};
  }
  TrackedScalar& operator+=(const TrackedScalar& other) { return *this = *this + other; }
  TrackedScalar& operator-=(const TrackedScalar& other) { return *this = *this - other; }
  TrackedScalar& operator*=(const TrackedScalar& other) { return *this = *this * other; }

  friend bool operator==(const TrackedScalar& a, const TrackedScalar& b) { return a.value_ == b.value_; }
  friend auto operator<=>(const TrackedScalar& a, const TrackedScalar& b) { return a.value_ <=> b.value_; }

  friend TrackedScalar abs(const TrackedScalar& a) { return a.value_ < 0.0L ? -a : a; }
  friend TrackedScalar sqrt(const TrackedScalar& a) {
    const long double root = std::sqrt(a.value_);
    return {root, a.place_, 0.5L / root, ErrorTape::kExact, 0.0L, 1.0};
  }
  friend TrackedScalar sin(const TrackedScalar& a) {
    return {std::sin(a.value_), a.place_, std::cos(a.value_), ErrorTape::kExact, 0.0L, kFunctionError};
  }
  friend TrackedScalar cos(const TrackedScalar& a) {
    return {std::cos(a.value_), a.place_, -std::sin(a.value_), ErrorTape::kExact, 0.0L, kFunctionError};
  }
  friend TrackedScalar atan2(const TrackedScalar& y, const TrackedScalar& x) {
    const long double square = x.value_ * x.value_ + y.value_ * y.value_;
    return {std::atan2(y.value_, x.value_), y.place_, x.value_ / square, x.place_, -y.value_ / square, kFunctionError};
  }

 private:
  /// sin, cos and atan2 are within one unit in the last place.
  static constexpr double kFunctionError = 2.0;

  TrackedScalar(long double value, std::size_t first, long double first_slope, std::size_t second,
                long double second_slope, double units)
      : value_(value),
        place_(ErrorTape::current().append(first, static_cast<double>(first_slope), second,
                                           static_cast<double>(second_slope), roundingOf(value, units))) {}

  static double roundingOf(long double value, double units) {
    return kArithmetic == Arithmetic::kWide ? 0.0 : units * std::abs(static_cast<double>(value));
  }
  static bool isConstantResult(const TrackedScalar& a, const TrackedScalar& b, long double result) {
    return a.is_constant_ && b.is_constant_ && static_cast<double>(result) == result;
  }
  bool isConstantPowerOfTwo() const {
    int exponent = 0;
    return is_constant_ && std::abs(std::frexp(value_, &exponent)) == 0.5L;
  }

  long double value_ = 0.0L;
  std::size_t place_ = ErrorTape::kExact;
  bool is_constant_ = false;
};

using Tracked = TrackedScalar<Arithmetic::kMachine>;
using TrackedClosedForms = TrackedScalar<Arithmetic::kClosedForms>;
using WideTracked = TrackedScalar<Arithmetic::kWide>;

namespace detail {
template <Arithmetic kArithmetic>
struct WideOf<TrackedScalar<kArithmetic>> {
  using Type = WideTracked;
};
}  // namespace detail

}  // namespace irradiff

template <irradiff::Arithmetic kArithmetic>
class std::numeric_limits<irradiff::TrackedScalar<kArithmetic>> : public std::numeric_limits<double> {
 public:
  static constexpr int digits = kArithmetic == irradiff::Arithmetic::kMachine ? 53 : 1000;
};

template <irradiff::Arithmetic kArithmetic>
struct Eigen::NumTraits<irradiff::TrackedScalar<kArithmetic>> : Eigen::NumTraits<double> {
  using Real = irradiff::TrackedScalar<kArithmetic>;
  using NonInteger = Real;
  using Nested = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 1,
    AddCost = 16,
    MulCost = 16
  };
};
