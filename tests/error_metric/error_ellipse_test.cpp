#include "derivatives/error_metric/error_ellipse.h"

#include "derivatives/error_metric/hessian_axes.h"
#include "tests/error_metric/ellipse_quadrature.h"

#include <Eigen/Geometry>
#include <boost/math/quadrature/gauss.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace irradiff::error_metric_test {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kRounding = std::numeric_limits<double>::epsilon() / 2.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = std::numbers::pi;
/// Beyond every aspect in the tests.
constexpr double kUncut = 1e6;

struct Case {
  double l1, l2, angle;

  Matrix2d hessian() const { return hessianOf(l1, l2, angle); }
  double ratio() const { return std::max(std::abs(l1 / l2), std::abs(l2 / l1)); }
};

/// Positive, negative, indefinite; with the larger eigenvalue first and second; diagonal; repeated; tiny and huge.
std::vector<Case> cases() {
  std::mt19937 random(20120806);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Case> result;
  for (int i = 0; i < 40; ++i) {
    const double l1 = std::pow(10.0, 2.0 * unit(random));
    const double l2 = l1 * std::pow(10.0, 2.0 * unit(random));
    const double angle = kPi * unit(random);
    for (const Vector2d& l :
         {Vector2d(l1, l2), Vector2d(-l1, -l2), Vector2d(l1, -l2), Vector2d(-l1, l2), Vector2d(l1, -l1)}) {
      result.push_back({l(0), l(1), angle});
      result.push_back({l(0), l(1), 0.0});
    }
    result.push_back({l1, l1, 0.0});
    result.push_back({-l1, -l1, 0.0});
    for (const double size : {1e-250, 1e250}) result.push_back({size * l1, -size * l2, angle});
  }
  return result;
}

EllipseOptions options(EllipseRule rule, double largest_aspect, ErrorScale scale = ErrorScale::kAbsolute,
                       ErrorMeasure measure = ErrorMeasure::kTotal) {
  return {scale, measure, rule, largest_aspect};
}

ValidRegion ellipse(const Matrix2d& hessian, double threshold, const EllipseOptions& options, double irradiance = 1.0) {
  return errorEllipse({hessian}, {irradiance}, threshold, options);
}

double area(const ValidRegion& region) { return kPi * region.half_axes.prod(); }

using Choice = std::function<ValidRegion(const Matrix2d&, double threshold)>;
using Integrand = std::function<Matrix2d(const Matrix2d&)>;

Matrix2d same(const Matrix2d& h) { return h; }

/// The largest difference of the integrated error from the threshold, relative to it, over what rounding and quadrature
/// are allowed. Half-axes count to the fourth power; the shorter eigenvalue is known to 4 u of the larger.
double worstOverBound(const Choice& choose, const Integrand& integrand, double threshold) {
  double worst = 0.0;
  for (const Case& c : cases()) {
    const Quadrature error = integrateHalfForm(integrand(c.hessian()), choose(c.hessian(), threshold));
    const double bound = (64.0 + 16.0 * c.ratio()) * kRounding * threshold + error.error_estimate;
    const double over = std::abs(error.value - threshold) / bound;
    worst = std::max(worst, std::isnan(over) ? kInfinity : over);
  }
  return worst;
}

TEST(ErrorEllipse, OfEqualErrorHasTheErrorOfTheThreshold) {
  for (const double aspect : {1.0, 2.0, kUncut}) {
    for (const double threshold : {1e-9, 0.02, 1e5}) {
      const auto bounded = [&](const Matrix2d& h, double eps) {
        return ellipse(h, eps, options(EllipseRule::kEqualError, aspect));
      };
      const auto exact = [&](const Matrix2d& h, double eps) {
        return ellipse(h, eps, options(EllipseRule::kEqualErrorExact, aspect));
      };
      const double worst_bounded = worstOverBound(bounded, absoluteHessian, threshold);
      const double worst_exact = worstOverBound(exact, same, threshold);
      std::cout << "aspect " << aspect << ", eps " << threshold << ": at most " << worst_bounded << " and "
                << worst_exact << " of the bound\n";
      EXPECT_LE(worst_bounded, 1.0);
      EXPECT_LE(worst_exact, 1.0);
      // The bound where the exact integral is meant, and the other way round.
      EXPECT_GT(worstOverBound(bounded, same, threshold), 1e6);
      EXPECT_GT(worstOverBound(exact, absoluteHessian, threshold), 1e6);
    }
  }
}

/// The eigenvector solved for with |l1|, as programs have done (docs/regressions.md).
Matrix2d axesFromAbsoluteEigenvalue(const Matrix2d& h) {
  const double larger = std::abs(hessianAxes({h}).eigenvalues(0));
  Vector2d axis(h(0, 1), larger - h(0, 0));
  if (axis.isZero(0.0)) axis = Vector2d(1.0, 0.0);
  Matrix2d axes;
  axis.normalize();
  axes << axis(0), -axis(1), axis(1), axis(0);
  return axes;
}

TEST(ErrorEllipse, MistakesOfRenderersAreSeen) {
  constexpr double kThreshold = 0.02;
  const EllipseOptions right = options(EllipseRule::kEqualError, kUncut);
  const auto mistaken = [&](const std::function<void(ValidRegion&, const Matrix2d&)>& change) {
    return worstOverBound(
        [&](const Matrix2d& h, double eps) {
          ValidRegion region = ellipse(h, eps, right);
          change(region, h);
          return region;
        },
        absoluteHessian, kThreshold);
  };
  EXPECT_LE(mistaken([](ValidRegion&, const Matrix2d&) {}), 1.0);
  EXPECT_GT(mistaken([](ValidRegion& r, const Matrix2d& h) { r.axes = axesFromAbsoluteEigenvalue(h); }), 1e6);
  // The square root of the second, where an error of order 2 is integrated over an area; and without 4/pi.
  EXPECT_GT(mistaken([](ValidRegion& r, const Matrix2d&) { r.half_axes = r.half_axes.cwiseAbs2(); }), 1e6);
  EXPECT_GT(mistaken([](ValidRegion& r, const Matrix2d&) { r.half_axes *= std::pow(kPi / 4.0, 0.25); }), 1e6);
  EXPECT_GT(mistaken([](ValidRegion& r, const Matrix2d&) { r.half_axes.reverseInPlace(); }), 1e6);
  const auto printed = [](const Matrix2d& h, double eps) {
    return ellipse(h, eps, options(EllipseRule::kPrinted, kUncut));
  };
  EXPECT_GT(worstOverBound(printed, absoluteHessian, kThreshold), 1e6);
}

TEST(ErrorEllipse, ThePrintedOneHasTheRadiiOfEquation7) {
  constexpr double kThreshold = 0.02;
  for (const Case& c : cases()) {
    const Vector2d half_axes = ellipse(c.hessian(), kThreshold, options(EllipseRule::kPrinted, kUncut)).half_axes;
    const double larger = std::max(std::abs(c.l1), std::abs(c.l2));
    const double lesser = std::min(std::abs(c.l1), std::abs(c.l2));
    const double common = std::pow(4.0 * kThreshold / kPi, 0.25);
    const double bound = (16.0 + 4.0 * c.ratio()) * kRounding;
    EXPECT_NEAR(half_axes(0) / (common / std::pow(larger, 0.25)), 1.0, bound);
    EXPECT_NEAR(half_axes(1) / (common / std::pow(lesser, 0.25)), 1.0, bound);
  }
}

TEST(ErrorEllipse, ThePrintedOneHasTheErrorTimesAHyperbolicCosine) {
  constexpr double kThreshold = 0.02;
  double largest = 0.0;
  for (const Case& c : cases()) {
    const ValidRegion region = ellipse(c.hessian(), kThreshold, options(EllipseRule::kPrinted, kUncut));
    const Quadrature error = integrateHalfForm(absoluteHessian(c.hessian()), region);
    const double predicted = kThreshold * std::cosh(0.25 * std::log(std::abs(c.l1 / c.l2)));
    EXPECT_NEAR(error.value, predicted, (64.0 + 16.0 * c.ratio()) * kRounding * predicted + error.error_estimate);
    largest = std::max(largest, error.value / kThreshold);
    // Of one area with the one of equal error.
    const ValidRegion equal = ellipse(c.hessian(), kThreshold, options(EllipseRule::kEqualError, kUncut));
    EXPECT_NEAR(area(region) / area(equal), 1.0, (64.0 + 16.0 * c.ratio()) * kRounding);
  }
  std::cout << "printed ellipse: up to " << largest << " times the threshold\n";
  // cosh(ln(100)/4): the prediction does not hold by being 1.
  EXPECT_GT(largest, 1.5);
}

/// What the errors of the printed ellipse, cut to the aspect, are between, over the threshold.
std::pair<double, double> printedErrors(double aspect) {
  constexpr double kThreshold = 0.02;
  std::pair<double, double> range{kInfinity, 0.0};
  for (const Case& c : cases()) {
    const ValidRegion region = ellipse(c.hessian(), kThreshold, options(EllipseRule::kPrinted, aspect));
    const double error = integrateHalfForm(absoluteHessian(c.hessian()), region).value / kThreshold;
    range = {std::min(range.first, error), std::max(range.second, error)};
  }
  return range;
}

TEST(ErrorEllipse, ThePrintedOneCutToTwiceItsWidthIsAtMostAQuarterOff) {
  constexpr double kSlack = 2000.0 * kRounding;  // ratios are up to 100, see worstOverBound
  EXPECT_GE(printedErrors(2.0).first, 1.0 - kSlack);
  EXPECT_LE(printedErrors(2.0).second, 1.25 + kSlack);
  EXPECT_GT(printedErrors(2.0).second, 1.2);
  EXPECT_GE(printedErrors(1.0).first, 0.5 - kSlack);
  EXPECT_LT(printedErrors(1.0).first, 0.51);
  EXPECT_LE(printedErrors(1.0).second, 1.0 + kSlack);
}

TEST(ErrorEllipse, NoOtherEllipseOfThatErrorHasALargerArea) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  constexpr double kThreshold = 0.02;
  double closest = 0.0;
  for (const Case& c : cases()) {
    const Matrix2d h = c.hessian();
    for (const double aspect : {1.5, kUncut}) {
      for (const EllipseRule rule : {EllipseRule::kEqualError, EllipseRule::kEqualErrorExact}) {
        const double largest = area(ellipse(h, kThreshold, options(rule, aspect)));
        for (int i = 0; i < 50; ++i) {
          const double length = std::min(aspect, std::pow(10.0, std::abs(unit(random))));
          ValidRegion other{{1.0, length}, Eigen::Rotation2Dd(kPi * unit(random)).toRotationMatrix()};
          const double error =
              rule == EllipseRule::kEqualError ? integratedErrorBound({h}, other) : integratedError({h}, other);
          // Such that its error is the threshold.
          other.half_axes *= std::pow(kThreshold, 0.25) / std::pow(error, 0.25);
          closest = std::max(closest, area(other) / largest);
          EXPECT_LE(area(other), largest * (1.0 + (64.0 + 16.0 * c.ratio()) * kRounding));
        }
      }
    }
    // The printed one, made to have the error, is smaller.
    if (c.ratio() < 2.0) continue;
    const double factor = std::pow(std::cosh(0.25 * std::log(c.ratio())), -0.5);
    const double equal = area(ellipse(h, kThreshold, options(EllipseRule::kEqualError, kUncut)));
    EXPECT_LT(area(ellipse(h, kThreshold, options(EllipseRule::kPrinted, kUncut))) * factor, equal);
  }
  // Others come near.
  EXPECT_GT(closest, 0.999);
}

TEST(ErrorEllipse, OfIndefiniteHessiansTheExactIntegralAllowsAQuarticRootOfHalfPiMore) {
  const Matrix2d h = hessianOf(4.0, -1.0, 0.7);
  const double exact = ellipse(h, 0.1, options(EllipseRule::kEqualErrorExact, kUncut)).half_axes(0);
  const double bounded = ellipse(h, 0.1, options(EllipseRule::kEqualError, kUncut)).half_axes(0);
  EXPECT_NEAR(exact / bounded, std::pow(0.5 * kPi, 0.25), 64.0 * kRounding);
}

TEST(ErrorEllipse, IsAtMostAsLongAsTheAspectAllows) {
  for (const Case& c : cases()) {
    for (const EllipseRule rule : {EllipseRule::kPrinted, EllipseRule::kEqualError, EllipseRule::kEqualErrorExact}) {
      for (const double aspect : {1.0, 2.0, 3.5}) {
        const Vector2d half_axes = ellipse(c.hessian(), 0.02, options(rule, aspect)).half_axes;
        EXPECT_GE(half_axes(1), half_axes(0) * (1.0 - 4.0 * kRounding));
        EXPECT_LE(half_axes(1), half_axes(0) * aspect * (1.0 + 4.0 * kRounding));
      }
    }
    // Isotropic: the minimum of the two printed radii.
    const Vector2d uncut = ellipse(c.hessian(), 0.02, options(EllipseRule::kPrinted, kUncut)).half_axes;
    const Vector2d circle = ellipse(c.hessian(), 0.02, options(EllipseRule::kPrinted, 1.0)).half_axes;
    EXPECT_EQ(circle, Vector2d::Constant(uncut(0)));
  }
}

TEST(ErrorEllipse, LiesAcrossTheSharpestDirectionWhateverTheSigns) {
  for (const Case& c : cases()) {
    if (c.ratio() < 1.1) continue;
    const Matrix2d h = c.hessian();
    const ValidRegion region = ellipse(h, 0.02, options(EllipseRule::kEqualError, 2.0));
    // The definition of the axes, found by looking: no direction is sharper than the short one.
    double sharpest = 0.0;
    for (int degree = 0; degree < 180; ++degree) {
      const Vector2d v(std::cos(degree * kPi / 180.0), std::sin(degree * kPi / 180.0));
      sharpest = std::max(sharpest, std::abs(v.dot(h * v)));
    }
    const Vector2d minor = region.axes.col(0);
    EXPECT_GE(std::abs(minor.dot(h * minor)), sharpest * (1.0 - 16.0 * kRounding));
    const Vector2d twin = axesFromAbsoluteEigenvalue(h).col(0);
    const bool larger_is_negative = hessianAxes({h}).eigenvalues(0) < 0.0;
    if (larger_is_negative && c.angle != 0.0) {
      EXPECT_LT(std::abs(twin.dot(h * twin)), sharpest * 0.999);
    }
  }
}

TEST(ErrorEllipse, OfRelativeErrorIsThatOfTheThresholdTimesTheIrradiance) {
  for (const Case& c : cases()) {
    for (const double irradiance : {1e-6, 3.0, 1e7}) {
      const ValidRegion relative =
          ellipse(c.hessian(), 0.02, options(EllipseRule::kEqualError, 2.0, ErrorScale::kRelative), irradiance);
      const Quadrature error = integrateHalfForm(absoluteHessian(c.hessian()), relative);
      EXPECT_NEAR(error.value / irradiance, 0.02,
                  (64.0 + 16.0 * c.ratio()) * kRounding * 0.02 + error.error_estimate / irradiance);
    }
  }
}

TEST(ErrorEllipse, OfMeanErrorHasTheThresholdTimesItsArea) {
  for (const Case& c : cases()) {
    for (const double aspect : {1.0, 2.0, kUncut}) {
      const ValidRegion bounded = ellipse(
          c.hessian(), 0.02, options(EllipseRule::kEqualError, aspect, ErrorScale::kAbsolute, ErrorMeasure::kMean));
      const Quadrature bound = integrateHalfForm(absoluteHessian(c.hessian()), bounded);
      const double tolerance = (64.0 + 16.0 * c.ratio()) * kRounding * 0.02;
      EXPECT_NEAR(bound.value / area(bounded), 0.02, tolerance + bound.error_estimate / area(bounded));
      const ValidRegion exact =
          ellipse(c.hessian(), 0.02,
                  options(EllipseRule::kEqualErrorExact, aspect, ErrorScale::kAbsolute, ErrorMeasure::kMean));
      const Quadrature error = integrateHalfForm(c.hessian(), exact);
      EXPECT_NEAR(error.value / area(exact), 0.02, tolerance + error.error_estimate / area(exact));
    }
  }
}

/// In a unit of length in which the numbers of lengths are `factor` times as large, E stays and H falls by its square.
double radiusRatio(const Case& c, double factor, const EllipseOptions& chosen, double threshold_factor) {
  const ValidRegion before = ellipse(c.hessian(), 0.02, chosen, 3.0);
  const ValidRegion after = ellipse(c.hessian() / (factor * factor), 0.02 * threshold_factor, chosen, 3.0);
  // Entries of H are rounded, which turns the axes by that over the difference of the eigenvalues.
  const double turn = std::max(std::abs(c.l1), std::abs(c.l2)) / std::abs(c.l1 - c.l2);
  EXPECT_LE((after.axes - before.axes).cwiseAbs().maxCoeff(), 8.0 * turn * kRounding);
  EXPECT_NEAR(after.half_axes(1) / before.half_axes(1), after.half_axes(0) / before.half_axes(0),
              (32.0 + 8.0 * c.ratio()) * kRounding * after.half_axes(0) / before.half_axes(0));
  return after.half_axes(0) / before.half_axes(0);
}

TEST(ErrorEllipse, OfMeanRelativeErrorDoesNotDependOnTheUnitOfLengthAndOfTotalErrorDoes) {
  for (const Case& c : cases()) {
    // Nearly a circle: which axis is which is rounding.
    if (c.ratio() < 1.01) continue;
    for (const double factor : {1000.0, 0.01, 3.2808, 1024.0}) {
      for (const EllipseRule rule : {EllipseRule::kPrinted, EllipseRule::kEqualError, EllipseRule::kEqualErrorExact}) {
        const EllipseOptions total = options(rule, 2.0, ErrorScale::kRelative);
        const double rounding = (64.0 + 16.0 * c.ratio()) * kRounding;
        EXPECT_NEAR(radiusRatio(c, factor, total, 1.0) / std::sqrt(factor), 1.0, rounding);
        EXPECT_NEAR(radiusRatio(c, factor, total, factor * factor) / factor, 1.0, rounding);
        if (rule == EllipseRule::kPrinted) continue;
        const EllipseOptions mean = options(rule, 2.0, ErrorScale::kRelative, ErrorMeasure::kMean);
        EXPECT_NEAR(radiusRatio(c, factor, mean, 1.0) / factor, 1.0, rounding);
      }
    }
  }
}

TEST(ErrorEllipse, OfZeroIsInfiniteWhateverTheIrradiance) {
  for (const double irradiance : {0.0, 1.0}) {
    for (const ErrorScale scale : {ErrorScale::kAbsolute, ErrorScale::kRelative}) {
      const ValidRegion region =
          ellipse(Matrix2d::Zero(), 0.02, options(EllipseRule::kEqualError, 2.0, scale), irradiance);
      EXPECT_EQ(region.half_axes, Vector2d(kInfinity, kInfinity));
      EXPECT_EQ(region.axes, Matrix2d::Identity());
    }
  }
}

TEST(ErrorEllipse, OfRankOneHasTheLargestAspectAndTheError) {
  const Matrix2d h = hessianOf(0.0, -5.0, 0.0);
  for (const double aspect : {1.0, 2.0, 1e9}) {
    for (const EllipseRule rule : {EllipseRule::kEqualError, EllipseRule::kEqualErrorExact}) {
      const ValidRegion region = ellipse(h, 0.02, options(rule, aspect));
      EXPECT_DOUBLE_EQ(region.half_axes(1) / region.half_axes(0), aspect);
      EXPECT_EQ(region.axes.col(0).cwiseAbs(), Vector2d(0.0, 1.0));
      EXPECT_NEAR(integrateHalfForm(h, region).value, 0.02, 64.0 * kRounding);
    }
  }
  // In other axes the second eigenvalue is what rounding leaves of it.
  const Matrix2d turned = hessianOf(0.0, -5.0, 0.7);
  for (const double aspect : {2.0, 100.0, 1000.0}) {
    const ValidRegion region = ellipse(turned, 0.02, options(EllipseRule::kEqualError, aspect));
    const Quadrature error = integrateHalfForm(absoluteHessian(turned), region);
    EXPECT_NEAR(error.value / 0.02, 1.0, (64.0 + 16.0 * aspect * aspect) * kRounding + error.error_estimate / 0.02);
  }
}

TEST(ErrorEllipse, RefusesAShareOfNothing) {
  for (const double irradiance : {0.0, -1.0}) {
    const auto choose = [irradiance] {
      ellipse(Matrix2d::Identity(), 0.02, options(EllipseRule::kEqualError, 2.0, ErrorScale::kRelative), irradiance);
    };
    EXPECT_THAT(choose, ThrowsMessage<std::invalid_argument>(HasSubstr("must be positive for a relative error")));
  }
  EXPECT_GT(ellipse(Matrix2d::Identity(), 0.02, options(EllipseRule::kEqualError, 2.0), 0.0).half_axes(0), 0.0);
}

/// 1/2 integral of |h| x^2 over [-R, R].
double intervalError(double h, double half_length) {
  const auto error = [h](double x) { return 0.5 * std::abs(h * x * x); };
  return boost::math::quadrature::gauss<double, 7>::integrate(error, -half_length, half_length);
}

TEST(ErrorInterval, HasTheErrorOfTheThreshold) {
  constexpr double kMargin = 64.0 * kRounding;  // a cube of what is known to 16 u
  for (const double h : {3.0, -0.02, 1e-200, -1e200}) {
    for (const double threshold : {1e-9, 0.02, 1e5}) {
      const auto interval = [&](ErrorScale scale, ErrorMeasure measure) {
        return errorInterval({Eigen::Matrix<double, 1, 1>(h)}, {7.0}, threshold, scale, measure);
      };
      const double total = interval(ErrorScale::kAbsolute, ErrorMeasure::kTotal);
      EXPECT_NEAR(intervalError(h, total) / threshold, 1.0, kMargin);
      const double relative = interval(ErrorScale::kRelative, ErrorMeasure::kTotal);
      EXPECT_NEAR(intervalError(h, relative) / (7.0 * threshold), 1.0, kMargin);
      const double mean = interval(ErrorScale::kAbsolute, ErrorMeasure::kMean);
      EXPECT_NEAR(intervalError(h, mean) / (2.0 * mean * threshold), 1.0, kMargin);
      // A root of another order, and the interval's length for its half.
      EXPECT_GT(std::abs(intervalError(h, std::pow(total, 0.75)) / threshold - 1.0), 1e-3);
      EXPECT_GT(std::abs(intervalError(h, 2.0 * total) / threshold - 1.0), 1e-3);
    }
  }
}

TEST(ErrorInterval, OfZeroIsInfiniteAndOfNoIrradianceRefused) {
  const auto interval = [](double h) {
    return errorInterval({Eigen::Matrix<double, 1, 1>(h)}, {0.0}, 0.1, ErrorScale::kRelative, ErrorMeasure::kTotal);
  };
  EXPECT_EQ(interval(0.0), kInfinity);
  EXPECT_THAT([&] { interval(1.0); }, ThrowsMessage<std::invalid_argument>(HasSubstr("must be positive")));
}

TEST(ErrorEllipse, OptionsAreFoundByNameAndRefusedWithTheRule) {
  EXPECT_EQ(errorScaleOf("absolute"), ErrorScale::kAbsolute);
  EXPECT_EQ(errorScaleOf("relative"), ErrorScale::kRelative);
  EXPECT_EQ(errorMeasureOf("total"), ErrorMeasure::kTotal);
  EXPECT_EQ(errorMeasureOf("mean"), ErrorMeasure::kMean);
  EXPECT_EQ(ellipseRuleOf("printed"), EllipseRule::kPrinted);
  EXPECT_EQ(ellipseRuleOf("equal-error"), EllipseRule::kEqualError);
  EXPECT_EQ(ellipseRuleOf("equal-error-exact"), EllipseRule::kEqualErrorExact);
  EXPECT_THAT([] { ellipseRuleOf("equal"); },
              ThrowsMessage<std::invalid_argument>(
                  "unknown ellipse \"equal\": must be one of printed, equal-error, equal-error-exact"));
  for (const double aspect : {0.5, -2.0, kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT([aspect] { options(EllipseRule::kEqualError, aspect).require(); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("must be finite and at least 1")));
  }
  EXPECT_THAT([] { options(EllipseRule::kPrinted, 2.0, ErrorScale::kRelative, ErrorMeasure::kMean).require(); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("the printed radii are those of \"total\"")));
}

}  // namespace
}  // namespace irradiff::error_metric_test
