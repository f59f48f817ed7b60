#pragma once

#include "derivatives/error_metric/valid_region.h"

#include <string_view>

namespace irradiff {

/// Whether the threshold is one of irradiance or of the share of the record's own: Eqs. (5) and (12) of [Schwarzhaupt
/// et al. 2012].
enum class ErrorScale { kAbsolute, kRelative };

/// What is kept at the threshold: the error's integral over the ellipse, as in Eq. (4), or its mean, the integral over
/// the area. The threshold of the former has a unit of area in it; that of the latter has not, so that with relative
/// errors it does not change with the unit of length.
enum class ErrorMeasure { kTotal, kMean };

/// How an ellipse in the axes of the Hessian is found from the eigenvalues l1, l2 and the threshold eps.
enum class EllipseRule {
  kPrinted,         ///< Eqs. (7) and (14) with |l|: half-axes (4 eps/(pi |l|))^(1/4); the longer one cut to the aspect
  kEqualError,      ///< the ellipse of largest area whose integratedErrorBound is eps, among those of the aspect
  kEqualErrorExact  ///< likewise with integratedError
};

// By the names "absolute" and "relative"; "total" and "mean"; "printed", "equal-error" and "equal-error-exact". Throw
// std::invalid_argument naming what was given and the names that there are.
ErrorScale errorScaleOf(std::string_view name);
ErrorMeasure errorMeasureOf(std::string_view name);
EllipseRule ellipseRuleOf(std::string_view name);

struct EllipseOptions {
  ErrorScale scale = ErrorScale::kRelative;
  ErrorMeasure measure = ErrorMeasure::kTotal;
  EllipseRule rule = EllipseRule::kEqualError;
  double largest_aspect = 2.0;  ///< longer half-axis over the shorter; 1 gives circles, of the lesser radius if printed

  /// Throws std::invalid_argument naming the aspect unless it is finite and at least 1, and for the printed rule with
  /// the mean: Eq. (7) inverts the total.
  void require() const;
};

// The ellipse at `threshold`: in W (absolute, total), W/m^2 (absolute, mean), m^2 (relative, total) or 1 (relative,
// mean). The first half-axis is along the eigenvector of the eigenvalue that is larger in size, and the shorter. A
// Hessian of zero gives infinite half-axes, one of rank 1 the largest aspect. kPrinted is off: its integratedErrorBound
// is eps cosh(ln|l1/l2|/4) where the aspect does not cut it. Derived in docs/derivations/error_metrics.md, sections 3
// to 5. Relative error of the half-axes: 16 u + 4 u |l1/l2|, since that is what an eigenvalue has, and of the two rules
// of equal error no more than 16 u + 4 u k^2, k the largest aspect. Throws std::invalid_argument naming the irradiance
// if it is not positive, the error relative and the Hessian not zero: no radius keeps a share of nothing. Requires
// `options.require()`, a finite Hessian whose entries off the diagonal are equal, a finite threshold > 0.
ValidRegion errorEllipse(const TangentialHessian<double>& hessian, Irradiance<double> irradiance, double threshold,
                         const EllipseOptions& options);

// The counterpart in flatland: half the length R of the interval along the tangent, with |H| R^3/3 (kTotal) or |H|
// R^2/6 (kMean) at the threshold; docs/derivations/error_metrics.md, section 8. m; infinite for a Hessian of zero.
// Threshold in W (absolute, total), W/m (absolute, mean), m (relative, total) or 1 (relative, mean). Error: 16 u
// relative. Throws and requires as errorEllipse.
double errorInterval(const TangentialHessian<double, 2>& hessian, Irradiance<double> irradiance, double threshold,
                     ErrorScale scale, ErrorMeasure measure);

}  // namespace irradiff
