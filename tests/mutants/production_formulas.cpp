// evaluatePolygon.

#include "derivatives/form_factor/polygon_evaluation.h"
#include "tests/mutants/plain_numbers.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <span>

namespace irradiff {
namespace {

void answerProduction(const Vertices& vertices, const Receiver& receiver, FormulaAnswer& answer) {
  const PolygonEvaluation evaluation = evaluatePolygon({"polygon", vertices, 1.0}, 0, receiver);
  const double factor = evaluation.is_clockwise ? std::numbers::inv_pi : -std::numbers::inv_pi;
  const IrradianceDerivatives<double>& d = evaluation.derivatives;
  write(d.irradiance.value, d.gradient.value, d.hessian.value, factor, answer);
  write(d.tangential_hessian.value, factor, answer.tangential_hessian);
  write(d.rotational_gradient.value, factor, answer.rotational_gradient);
  // 1/pi is rounded and so is the product.
  constexpr double kDivision = 2.0 * 0x1p-53;
  const auto divided = [](double bound, std::span<const double> components) {
    double largest = 0.0;
    for (const double component : components) {
      largest = std::max(largest, std::abs(component));
    }
    return std::numbers::inv_pi * bound + kDivision * largest;
  };
  answer.bounds[0] = divided(evaluation.bounds.irradiance, {&answer.value, 1});
  answer.bounds[1] = divided(evaluation.bounds.gradient, answer.gradient);
  answer.bounds[2] = divided(evaluation.bounds.hessian, answer.hessian);
  answer.bounds[3] = divided(evaluation.bounds.tangential_hessian, answer.tangential_hessian);
  answer.bounds[4] = divided(evaluation.bounds.rotational_gradient, answer.rotational_gradient);
}

}  // namespace
}  // namespace irradiff

bool answerPolygon(PolygonFormula /*formula*/, const double* vertices, std::size_t vertex_count, const double* position,
                   const double* normal, FormulaAnswer* answer) {
  try {
    irradiff::answerProduction(irradiff::verticesFrom(vertices, vertex_count), irradiff::receiverFrom(position, normal),
                               *answer);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}
