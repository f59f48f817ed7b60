#include "derivatives/boundary/irradiance.h"
#include "derivatives/form_factor/polygon_evaluation.h"
#include "verification/checks/input_families.h"
#include "verification/checks/random.h"
#include "verification/report/errata.h"
#include "verification/report/residual_range.h"

#include <Eigen/Eigenvalues>
#include <boost/math/quadrature/gauss.hpp>

#include <array>
#include <numbers>

namespace irradiff {
namespace {

constexpr double kPi = std::numbers::pi;
const char* const kEllipseOracle = "quadrature over the ellipse";

/// Semi-axes of a record's valid region, along the eigenvectors of the tangential Hessian.
struct Radii {
  double first;
  double second;
};

/// Eq. (7) as printed; a negative eigenvalue has no fourth root.
Radii printedRadii(double threshold, double lambda1, double lambda2) {
  const double common = std::pow(4.0 * threshold / kPi, 0.25);
  return {common * std::pow(1.0 / lambda1, 0.25), common * std::pow(1.0 / lambda2, 0.25)};
}

/// The ellipse of largest area at error `threshold`.
Radii correctedRadii(double threshold, double lambda1, double lambda2) {
  const double common = std::pow(4.0 * threshold / kPi, 0.25);
  const double l1 = std::abs(lambda1);
  const double l2 = std::abs(lambda2);
  return {common * std::pow(l2 / (l1 * l1 * l1), 0.125), common * std::pow(l1 / (l2 * l2 * l2), 0.125)};
}

/// 1/2 integral of f(x, y) over the ellipse for f homogeneous of degree 2 and even in x and y: Gauss-Legendre in the
/// angle over the first quadrant, split at `kink`, where f may have one.
template <class Function>
double halfIntegral(const Radii& radii, double kink, const Function& f) {
  const auto ray = [&](double angle) { return f(radii.first * std::cos(angle), radii.second * std::sin(angle)); };
  using Rule = boost::math::quadrature::gauss<double, 30>;
  const double quadrant = Rule::integrate(ray, 0.0, kink) + Rule::integrate(ray, kink, 0.5 * kPi);
  // int_0^1 rho^3 drho = 1/4.
  return 0.5 * radii.first * radii.second * 0.25 * 4.0 * quadrant;
}

/// The integral (6): what the radii are meant to keep at the threshold.
double printedError(const Radii& radii, double lambda1, double lambda2) {
  return halfIntegral(radii, 0.25 * kPi,
                      [&](double x, double y) { return std::abs(lambda1) * x * x + std::abs(lambda2) * y * y; });
}

/// The integral (5), with the absolute value around the whole form.
double trueError(const Radii& radii, double lambda1, double lambda2) {
  const double a = std::abs(lambda1) * radii.first * radii.first;
  const double b = std::abs(lambda2) * radii.second * radii.second;
  return halfIntegral(radii, std::atan(std::sqrt(a / b)),
                      [&](double x, double y) { return std::abs(lambda1 * x * x + lambda2 * y * y); });
}

/// The integral (5) in closed form for eigenvalues of opposite signs: with C and D half the difference and half the sum
/// of |l1| a^2 and |l2| b^2 it is (ab/2)(C asin(C/D) + sqrt(D^2 - C^2)).
double indefiniteError(const Radii& radii, double lambda1, double lambda2) {
  const double a = std::abs(lambda1) * radii.first * radii.first;
  const double b = std::abs(lambda2) * radii.second * radii.second;
  const double c = 0.5 * (a - b);
  const double d = 0.5 * (a + b);
  return 0.5 * radii.first * radii.second * (c * std::asin(c / d) + std::sqrt(a * b));
}

double relativeTo(double expected, double value) { return std::abs(value / expected - 1.0); }

/// Radii (14) of a configuration for relative threshold `threshold`, corrected in shape.
Radii recordRadii(const Configuration& c, double threshold) {
  const IrradianceDerivatives<double> d = evaluatePolygon(c.polygon, 0, c.receiver).derivatives;
  const Eigen::Matrix2d hessian = tangentialHessian<double>(d.hessian.value, c.receiver.normal).value;
  const Eigen::Vector2d lambda = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(hessian).eigenvalues();
  return correctedRadii(threshold * d.irradiance.value, lambda(0), lambda(1));
}

}  // namespace

Erratum measureEllipseShape(std::size_t inputs, std::uint64_t seed) {
  ResidualRange absolute("integrated error over threshold, (7)", kEllipseOracle, 1e-12);
  ResidualRange relative("integrated error over threshold, (14)", kEllipseOracle, 1e-12);
  ResidualRange real_radii("share of Hessians without real radii", "2 x 2 Hessians with eigenvalues of any sign", 0.0);
  double not_real_printed = 0.0;
  double not_real_corrected = 0.0;
  for (std::size_t i = 0; i < inputs; ++i) {
    KeyedRandom random(seed, "ellipse", i);
    const double lambda1 = random.decade(-2.0, 2.0);
    const double lambda2 = lambda1 * random.decade(1.0, 4.0);
    const double threshold = random.decade(-4.0, 0.0);
    const double irradiance = random.decade(-2.0, 2.0);
    const auto error = [&](const Radii& radii) { return printedError(radii, lambda1, lambda2); };
    absolute.add(relativeTo(threshold, error(printedRadii(threshold, lambda1, lambda2))),
                 relativeTo(threshold, error(correctedRadii(threshold, lambda1, lambda2))));
    const double scaled_threshold = threshold * irradiance;
    relative.add(relativeTo(threshold, error(printedRadii(scaled_threshold, lambda1, lambda2)) / irradiance),
                 relativeTo(threshold, error(correctedRadii(scaled_threshold, lambda1, lambda2)) / irradiance));
    const double signed1 = random.below(2) == 0 ? lambda1 : -lambda1;
    const double signed2 = random.below(2) == 0 ? lambda2 : -lambda2;
    const auto is_real = [](const Radii& r) { return std::isfinite(r.first) && std::isfinite(r.second); };
    not_real_printed += is_real(printedRadii(threshold, signed1, signed2)) ? 0.0 : 1.0;
    not_real_corrected += is_real(correctedRadii(threshold, signed1, signed2)) ? 0.0 : 1.0;
  }
  const double count = static_cast<double>(inputs);
  real_radii.add(not_real_printed / count, not_real_corrected / count);
  ErratumMeasurement shares = real_radii.measurement();
  shares.inputs = inputs;
  const double hundredfold = printedError(printedRadii(1.0, 1.0, 100.0), 1.0, 100.0);
  return {"Equations (7) and (14)",
          "the shape of the ellipse, and absolute values",
          "R_k = (4 eps/pi)^(1/4) lambda_k^(-1/4); in (14) with eps E in place of eps",
          "R_1 = (4 eps/pi)^(1/4) (|lambda_2|/|lambda_1|^3)^(1/8), R_2 with the indices exchanged: the ellipse of "
          "largest area at error eps",
          "The printed ellipse has the integrated error eps cosh(ln(lambda_1/lambda_2)/4): at a ratio of 100 it is " +
              std::to_string(hundredfold).substr(0, 6) + " eps (predicted " +
              std::to_string(std::cosh(0.25 * std::log(100.0))).substr(0, 6) + " eps). Ratios here from 10 to 10^4.",
          {absolute.measurement(), relative.measurement(), shares}};
}

Erratum measureIndefiniteBound(std::size_t inputs, std::uint64_t seed) {
  ResidualRange error("integrated error of indefinite Hessians", kEllipseOracle, 1e-12);
  ResidualRange equal_error("the same on the corrected ellipse", kEllipseOracle, 1e-12);
  for (std::size_t i = 0; i < inputs; ++i) {
    KeyedRandom random(seed, "indefinite", i);
    const double lambda1 = random.decade(-2.0, 2.0);
    const double lambda2 = -lambda1 * random.decade(-2.0, 2.0);
    const Radii any{random.decade(-1.0, 1.0), random.decade(-1.0, 1.0)};
    const auto add = [&](ResidualRange& range, const Radii& radii) {
      const double expected = trueError(radii, lambda1, lambda2);
      range.add(relativeTo(expected, printedError(radii, lambda1, lambda2)),
                relativeTo(expected, indefiniteError(radii, lambda1, lambda2)));
    };
    add(error, any);
    add(equal_error, correctedRadii(1.0, lambda1, lambda2));
  }
  return {"Equations (6) and (13)",
          "a bound, not an equality",
          "the integral of |x^T H x| equals that of |lambda_1| x^2 + |lambda_2| y^2",
          "it is at most that, and equal only if the eigenvalues do not have opposite signs; else it is (ab/2)(C "
          "asin(C/D) + sqrt(D^2 - C^2)), C and D half the difference and half the sum of |lambda_1| a^2 and "
          "|lambda_2| b^2",
          "On the corrected ellipse the true integral is 2/pi of the bound: the bound is too large by pi/2 - 1 = "
          "0.5708. It is safe, not wrong in sign.",
          {error.measurement(), equal_error.measurement()}};
}

Erratum measureThresholdUnit(std::size_t inputs, std::uint64_t seed) {
  ResidualRange radii("radius in centimetres over 100 times the radius in metres", "the same scene in both units",
                      1e-12);
  constexpr double kCentimetres = 100.0;
  constexpr double kThreshold = 0.01;
  for (const Configuration& metres : drawInputs(inputFamily("well-conditioned"), inputs, seed)) {
    Configuration centimetres = metres;
    for (Eigen::Vector3d& v : centimetres.polygon.vertices) {
      v *= kCentimetres;
    }
    centimetres.receiver.position *= kCentimetres;
    const double expected = kCentimetres * recordRadii(metres, kThreshold).first;
    radii.add(relativeTo(expected, recordRadii(centimetres, kThreshold).first),
              relativeTo(expected, recordRadii(centimetres, kThreshold * kCentimetres * kCentimetres).first));
  }
  return {"The threshold has a unit",
          "eps of (7) and (14)",
          "eps in (7) and (14) without a unit",
          "eps of (7) is an irradiance times an area, eps of (14) an area: it changes with the unit of length",
          "With the same number eps the radius grows as the square root of the length unit: 10 times where the scene's "
          "numbers grow 100 times.",
          {radii.measurement()}};
}

}  // namespace irradiff
