#include "verification/certified/certified_value.h"

#include "verification/certified/ball_rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace irradiff {

namespace {

using Plain = RunningBound<double>;
using Machine = RunningBound<long double>;
using Extended = RunningBound<DoubleWord<double>>;

/// Calls `visit` with the matrices of each quantity of several sets of derivatives, and its index.
template <class Visit, class... Derivatives>
void visitMatrices(Visit visit, Derivatives&... derivatives) {
  visit(1, derivatives.gradient.value...);
  visit(2, derivatives.hessian.value...);
  visit(3, derivatives.tangential_hessian.value...);
  visit(4, derivatives.rotational_gradient.value...);
}

/// Calls `visit` with each number of several sets of derivatives, and the index of its quantity.
template <class Visit, class First, class... Others>
void visitNumbers(Visit visit, First& first, Others&... others) {
  visit(0, first.irradiance.value, others.irradiance.value...);
  visitMatrices(
      [&visit](int quantity, auto& matrix, auto&... other_matrices) {
        for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
          for (Eigen::Index j = 0; j < matrix.cols(); ++j) visit(quantity, matrix(i, j), other_matrices(i, j)...);
        }
      },
      first, others...);
}

/// Which power of the unit of length a quantity is divided by.
int powerOf(int quantity) { return quantity == 1 ? 1 : quantity == 2 || quantity == 3 ? 2 : 0; }

/// x times 2^exponent, with what is lost below the normal range.
Plain scaledBy(const Plain& x, int exponent) {
  if (exponent == 0) return x;
  return {std::ldexp(x.value(), exponent), std::ldexp(x.rawError(), exponent) + Plain::kUnderflow};
}

Ball scaledBy(const Ball& x, int exponent) { return x * Ball::powerOfTwo(exponent); }

std::array<long double, kQuantityCount> inARow(const DerivativeBounds& bounds) {
  return {bounds.irradiance, bounds.gradient, bounds.hessian, bounds.tangential_hessian, bounds.rotational_gradient};
}

template <int Dimension>
IrradianceDerivatives<Ball, Dimension> enclosuresOf(const CertifiedValue<Dimension>& value) {
  if (value.enclosure) return *value.enclosure;
  IrradianceDerivatives<Ball, Dimension> balls;
  visitNumbers([](int, Ball& ball, const Plain& number) { ball = enclosureOf(number); }, balls, value.rounded);
  return balls;
}

template <int Dimension>
void setRounded(CertifiedValue<Dimension>& value) {
  visitNumbers([](int, Plain& number, const Ball& ball) { number = rounded<double>(ball); }, value.rounded,
               *value.enclosure);
}

}  // namespace

template <int Dimension>
CertifiedValue<Dimension> noLight() {
  CertifiedValue<Dimension> value;
  visitNumbers([](int, Plain& number) { number = Plain(0.0); }, value.rounded);
  return value;
}

template <int Dimension>
CertifiedValue<Dimension> unknownLight() {
  CertifiedValue<Dimension> value;
  visitNumbers([](int, Plain& number) { number = Plain::unbounded(); }, value.rounded);
  return value;
}

template <class Scalar, int Dimension>
CertifiedValue<Dimension> inMetres(const CertifiedSums<Scalar, Dimension>& sums) {
  CertifiedValue<Dimension> value;
  const auto exponentOf = [&sums](int quantity) { return -powerOf(quantity) * sums.exponent; };
  if constexpr (std::same_as<Scalar, Plain> || std::same_as<Scalar, Machine>) {
    visitNumbers([&](int quantity, Plain& number,
                     const Scalar& sum) { number = scaledBy(static_cast<Plain>(sum), exponentOf(quantity)); },
                 value.rounded, sums.derivatives);
  } else {
    value.enclosure.emplace();
    visitNumbers(
        [&](int quantity, Ball& ball, const Scalar& sum) {
          if constexpr (std::same_as<Scalar, Ball>) {
            ball = scaledBy(sum, exponentOf(quantity));
          } else {
            ball = scaledBy(enclosureOf(sum), exponentOf(quantity));
          }
        },
        *value.enclosure, sums.derivatives);
    setRounded(value);
  }
  value.sizes = inARow(sums.sizes);
  for (std::size_t quantity = 0; quantity < kQuantityCount; ++quantity) {
    value.sizes[quantity] = std::ldexp(value.sizes[quantity], exponentOf(static_cast<int>(quantity)));
  }
  return value;
}

template <int Dimension>
void negate(CertifiedValue<Dimension>& value) {
  const auto change = [](int, auto& number) { number = -number; };
  visitNumbers(change, value.rounded);
  if (value.enclosure) visitNumbers(change, *value.enclosure);
}

template <int Dimension>
void add(CertifiedValue<Dimension>& sum, const CertifiedValue<Dimension>& source, double radiance, slong bits) {
  if (!sum.enclosure && !source.enclosure) {
    visitNumbers([radiance](int, Plain& total, const Plain& part) { total += Plain(radiance) * part; }, sum.rounded,
                 source.rounded);
  } else {
    const WorkingPrecision precision(bits);
    IrradianceDerivatives<Ball, Dimension> total = enclosuresOf(sum);
    const IrradianceDerivatives<Ball, Dimension> part = enclosuresOf(source);
    visitNumbers([radiance](int, Ball& all, const Ball& one) { all += Ball(radiance) * one; }, total, part);
    sum.enclosure = std::move(total);
    setRounded(sum);
  }
  for (std::size_t quantity = 0; quantity < kQuantityCount; ++quantity) {
    sum.sizes[quantity] += radiance * source.sizes[quantity];
  }
}

namespace {

/// Coordinates span 1000 binary orders at most (derivatives/scene/coordinate_range.h): what cancels further is 0.
constexpr int kVanishingExponent = -1024;

}  // namespace

bool QuantityState::meets(double tolerance, long double reference) const {
  return error <= allowed(tolerance, reference);
}

long double QuantityState::allowed(double tolerance, long double reference) const {
  const long double known = std::max(norm - error, reference);
  const long double relative = known > 0.0L ? tolerance * known : 0.0L;
  // A size without bound says nothing.
  const long double vanishing = std::isfinite(size) ? tolerance * std::ldexp(size, kVanishingExponent) : 0.0L;
  return norm <= vanishing ? std::max(relative, vanishing) : relative;
}

template <int Dimension>
std::array<QuantityState, kQuantityCount> statesOf(const CertifiedValue<Dimension>& value) {
  constexpr long double kUnknown = std::numeric_limits<long double>::infinity();
  std::array<QuantityState, kQuantityCount> states;
  const auto include = [&states](int quantity, long double number, long double error) {
    QuantityState& state = states[static_cast<std::size_t>(quantity)];
    state.norm = std::max(state.norm, std::abs(number));
    // NaN counts as what it is: nothing known.
    if (!(error <= state.error)) state.error = error < kUnknown ? error : kUnknown;
  };
  if (value.enclosure) {
    visitNumbers(
        [&include](int quantity, const Ball& ball) {
          include(quantity, midpointInLongDouble(ball), ball.isFinite() ? radiusInLongDouble(ball) : kUnknown);
        },
        *value.enclosure);
  } else {
    visitNumbers([&include](int quantity, const Plain& number) { include(quantity, number.value(), number.error()); },
                 value.rounded);
  }
  // Irradiance is positive wherever anything is seen: it cannot vanish.
  for (std::size_t quantity = 1; quantity < states.size(); ++quantity) {
    states[quantity].size = value.sizes[quantity];
  }
  return states;
}

template CertifiedValue<2> noLight<2>();
template CertifiedValue<2> unknownLight<2>();
template CertifiedValue<2> inMetres(const CertifiedSums<Machine, 2>&);
template CertifiedValue<2> inMetres(const CertifiedSums<Extended, 2>&);
template CertifiedValue<2> inMetres(const CertifiedSums<Ball, 2>&);
template void add(CertifiedValue<2>&, const CertifiedValue<2>&, double, slong);
template std::array<QuantityState, kQuantityCount> statesOf(const CertifiedValue<2>&);
template CertifiedValue<3> noLight<3>();
template CertifiedValue<3> unknownLight<3>();
template CertifiedValue<3> inMetres(const CertifiedSums<Plain, 3>&);
template CertifiedValue<3> inMetres(const CertifiedSums<Machine, 3>&);
template CertifiedValue<3> inMetres(const CertifiedSums<Extended, 3>&);
template CertifiedValue<3> inMetres(const CertifiedSums<Ball, 3>&);
template void negate(CertifiedValue<3>&);
template void add(CertifiedValue<3>&, const CertifiedValue<3>&, double, slong);
template std::array<QuantityState, kQuantityCount> statesOf(const CertifiedValue<3>&);

}  // namespace irradiff
