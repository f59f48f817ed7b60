#pragma once

#include "derivatives/boundary/derivative_bounds.h"
#include "derivatives/boundary/irradiance.h"
#include "verification/certified/certified_sums.h"
#include "verification/certified/running_bound.h"
#include "verification/enclosure/ball.h"

#include <array>
#include <optional>

namespace irradiff {

/// Irradiance, gradient, Hessian, tangential Hessian, rotational gradient.
inline constexpr std::size_t kQuantityCount = 5;

/// What a source of light adds, in metres, with its errors; or the sum of several.
template <int Dimension>
struct CertifiedValue {
  /// Each number with a bound of its distance from the exact one; infinity or NaN where nothing is known.
  IrradianceDerivatives<RunningBound<double>, Dimension> rounded;
  /// What `rounded` was rounded from, where that was more than a double.
  std::optional<IrradianceDerivatives<Ball, Dimension>> enclosure;
  /// Of the terms that were added up. In long double: terms that cancel may be beyond the range of double.
  std::array<long double, kQuantityCount> sizes{};
};

/// Nothing at all, exactly.
template <int Dimension>
CertifiedValue<Dimension> noLight();

/// A value of which nothing is known.
template <int Dimension>
CertifiedValue<Dimension> unknownLight();

/// The sums in metres, rounded where they are more than doubles.
template <class Scalar, int Dimension>
CertifiedValue<Dimension> inMetres(const CertifiedSums<Scalar, Dimension>& sums);

/// Minus the value.
template <int Dimension>
void negate(CertifiedValue<Dimension>& value);

/// The sum with `radiance` times `source`, in balls of `bits` as soon as one of the two is more than a double.
template <int Dimension>
void add(CertifiedValue<Dimension>& sum, const CertifiedValue<Dimension>& source, double radiance, slong bits);

/// One of the quantities of a value: max norm, error bound in that norm, size of its terms. In long double, since the
/// errors of Hessians near the end of the range of double are below it.
struct QuantityState {
  long double norm = 0.0L;
  long double error = 0.0L;
  long double size = 0.0L;

  /// rung.h says when. `reference` takes the place of the norm where that is larger.
  bool meets(double tolerance, long double reference = 0.0L) const;
  /// The error that meets the tolerance.
  long double allowed(double tolerance, long double reference = 0.0L) const;
};

/// The errors are those of the enclosure, where there is one.
template <int Dimension>
std::array<QuantityState, kQuantityCount> statesOf(const CertifiedValue<Dimension>& value);

}  // namespace irradiff
