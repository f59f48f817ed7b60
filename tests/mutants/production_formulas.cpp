// evaluatePolygon.

#include "derivatives/form_factor/polygon_evaluation.h"
#include "tests/mutants/plain_numbers.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>

namespace irradiff {
namespace {

void answerProduction(const Vertices& vertices, const Receiver& receiver, FormulaAnswer& answer) {
  const PolygonEvaluation evaluation = evaluatePolygon({"polygon", vertices, 1.0}, 0, receiver);
  const double factor = evaluation.is_clockwise ? std::numbers::inv_pi : -std::numbers::inv_pi;
  const IrradianceDerivatives<double>& d = evaluation.derivatives;
  write(d.irradiance.value, d.gradient.value, d.hessian.value, factor, answer);
  write(d.rotational_gradient.value, factor, answer.rotational_gradient);
  // 1/pi is rounded and so is the product.
  constexpr double kDivision = 2.0 * 0x1p-53;
  double largest_slope = 0.0;
  for (const double component : answer.gradient) {
    largest_slope = std::max(largest_slope, std::abs(component));
  }
  double largest_entry = 0.0;
  for (const double entry : answer.hessian) {
    largest_entry = std::max(largest_entry, std::abs(entry));
  }
  answer.bounds[0] = std::numbers::inv_pi * evaluation.bounds.irradiance + kDivision * std::abs(answer.value);
  answer.bounds[1] = std::numbers::inv_pi * evaluation.bounds.gradient + kDivision * largest_slope;
  answer.bounds[2] = std::numbers::inv_pi * evaluation.bounds.hessian + kDivision * largest_entry;
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
