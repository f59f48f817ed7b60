#include "derivatives/error_metric/error_ellipse.h"

#include "derivatives/error_metric/hessian_axes.h"
#include "derivatives/scene/number_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace irradiff {
namespace {

/// b/a for |l2|/|l1| = `ratio`, before it is cut: the radii (7), or |l1| a^2 = |l2| b^2.
double uncutAspect(EllipseRule rule, double ratio) {
  const double equal = 1.0 / std::sqrt(ratio);
  return rule == EllipseRule::kPrinted ? std::sqrt(equal) : equal;
}

/// The error integrated over the ellipse with half-axes 1 and `aspect` if the eigenvalues are 1 and `ratio` in size.
/// `level` is ratio aspect^2, the second term over the first.
double unitError(bool exactly_indefinite, double aspect, double level) {
  if (!exactly_indefinite) return 0.125 * std::numbers::pi * aspect * (1.0 + level);
  const double half_difference = 0.5 * (1.0 - level);
  const double mean = std::sqrt(level);
  return 0.5 * aspect * (half_difference * std::atan2(half_difference, mean) + mean);
}

/// What the threshold is a share of. The Hessian is not zero.
double unitOfError(Irradiance<double> irradiance, ErrorScale scale) {
  if (scale == ErrorScale::kAbsolute) return 1.0;
  if (!(irradiance.value > 0.0)) {
    throw std::invalid_argument("the irradiance of a record is " + numberText(irradiance.value) +
                                ", must be positive for a relative error unless the Hessian is zero");
  }
  return irradiance.value;
}

template <class Value, std::size_t Count>
Value valueOf(std::string_view thing, std::string_view name,
              const std::array<std::pair<std::string_view, Value>, Count>& values) {
  std::string known;
  for (const auto& [known_name, value] : values) {
    if (known_name == name) return value;
    known += (known.empty() ? " " : ", ") + std::string(known_name);
  }
  throw std::invalid_argument("unknown " + std::string(thing) + " \"" + std::string(name) + "\": must be one of" +
                              known);
}

}  // namespace

ErrorScale errorScaleOf(std::string_view name) {
  return valueOf<ErrorScale, 2>("error scale", name,
                                {{{"absolute", ErrorScale::kAbsolute}, {"relative", ErrorScale::kRelative}}});
}

ErrorMeasure errorMeasureOf(std::string_view name) {
  return valueOf<ErrorMeasure, 2>("error measure", name,
                                  {{{"total", ErrorMeasure::kTotal}, {"mean", ErrorMeasure::kMean}}});
}

EllipseRule ellipseRuleOf(std::string_view name) {
  return valueOf<EllipseRule, 3>("ellipse", name,
                                 {{{"printed", EllipseRule::kPrinted},
                                   {"equal-error", EllipseRule::kEqualError},
                                   {"equal-error-exact", EllipseRule::kEqualErrorExact}}});
}

void EllipseOptions::require() const {
  if (!(largest_aspect >= 1.0) || std::isinf(largest_aspect)) {
    throw std::invalid_argument("the largest aspect of an ellipse is " + numberText(largest_aspect) +
                                ", must be finite and at least 1");
  }
  if (rule == EllipseRule::kPrinted && measure == ErrorMeasure::kMean) {
    throw std::invalid_argument(
        "the ellipse is \"printed\" and the error measure \"mean\": the printed radii are those of \"total\"");
  }
}

ValidRegion errorEllipse(const TangentialHessian<double>& hessian, Irradiance<double> irradiance, double threshold,
                         const EllipseOptions& options) {
  const HessianAxes own = hessianAxes(hessian);
  const Eigen::Vector2d sizes = own.eigenvalues.cwiseAbs();
  if (sizes(0) == 0.0) return {Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), own.axes};
  const double unit = unitOfError(irradiance, options.scale);

  const double ratio = sizes(1) / sizes(0);
  const double aspect = std::min(options.largest_aspect, uncutAspect(options.rule, ratio));
  const double level = ratio * aspect * aspect;

  // The printed radius of the sharper axis is that of a circle whose two eigenvalues are the larger one.
  const bool indefinite = own.eigenvalues(0) * std::copysign(1.0, own.eigenvalues(1)) < 0.0;
  double error = options.rule == EllipseRule::kPrinted
                     ? unitError(false, 1.0, 1.0)
                     : unitError(options.rule == EllipseRule::kEqualErrorExact && indefinite, aspect, level);
  // An ellipse s times as large has s^4 times the total error and s^2 times its mean. Roots of the factors, since their
  // product may be beyond double where the half-axes are not.
  double exponent = 0.25;
  if (options.measure == ErrorMeasure::kMean) {
    error /= std::numbers::pi * aspect;
    exponent = 0.5;
  }
  const auto root = [exponent](double value) { return std::pow(value, exponent); };
  const double shorter = root(threshold) * root(unit) / (root(sizes(0)) * root(error));
  return {{shorter, aspect * shorter}, own.axes};
}

double errorInterval(const TangentialHessian<double, 2>& hessian, Irradiance<double> irradiance, double threshold,
                     ErrorScale scale, ErrorMeasure measure) {
  const double curvature = std::abs(hessian.value(0, 0));
  if (curvature == 0.0) return std::numeric_limits<double>::infinity();
  const double unit = unitOfError(irradiance, scale);
  if (measure == ErrorMeasure::kTotal) {
    return std::cbrt(3.0) * std::cbrt(threshold) * std::cbrt(unit) / std::cbrt(curvature);
  }
  return std::sqrt(6.0) * std::sqrt(threshold) * std::sqrt(unit) / std::sqrt(curvature);
}

}  // namespace irradiff
