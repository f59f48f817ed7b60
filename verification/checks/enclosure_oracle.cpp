#include "verification/checks/oracle.h"
#include "verification/enclosure/area_integral.h"

#include <algorithm>

namespace irradiff {
namespace {

/// Enough to judge double precision; each digit more costs: two nested integrations.
constexpr int kDigits = 18;

Multiprecision midpoint(const Ball& ball) { return Multiprecision(ball.midpointToDecimal(100)); }

/// The radius, and room for the rounding of it and of the midpoint's hundred digits.
double uncertainty(const Ball& ball) {
  return (ball.radius() + abs(ball.midpoint()) * Ball::powerOfTwo(-300)).toDouble() * 1.0001;
}

std::optional<OracleValue> enclosures(const Configuration& configuration) {
  const FormFactorEnclosure enclosure = encloseArea(configuration.polygon, configuration.receiver, kDigits);
  OracleValue value;
  value.form_factor = midpoint(enclosure.value);
  value.form_factor_uncertainty = uncertainty(enclosure.value);
  for (int i = 0; i < 3; ++i) {
    value.gradient(i) = midpoint(enclosure.gradient(i));
    value.gradient_uncertainty = std::max(value.gradient_uncertainty, uncertainty(enclosure.gradient(i)));
    for (int j = 0; j < 3; ++j) {
      value.hessian(i, j) = midpoint(enclosure.hessian(i, j));
      value.hessian_uncertainty = std::max(value.hessian_uncertainty, uncertainty(enclosure.hessian(i, j)));
    }
  }
  value.projectHessian(configuration);
  const WorkingPrecision scope(precisionForDigits(40));
  const BallVector rotational =
      enclosure::cross<Ball>(exactly(configuration.receiver.normal), enclosure.normal_gradient);
  for (int i = 0; i < 3; ++i) {
    value.rotational_gradient(i) = midpoint(rotational(i));
    value.rotational_gradient_uncertainty = std::max(value.rotational_gradient_uncertainty, uncertainty(rotational(i)));
  }
  return value;
}

}  // namespace

Oracle enclosureOracle() {
  return {"area-integral enclosure",
          "a wrong F or derivative: shares nothing with the formulas",
          {kQuantities.begin(), kQuantities.end()},
          enclosures};
}

}  // namespace irradiff
