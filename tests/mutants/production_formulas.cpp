// evaluatePolygon and all it calls in one translation unit, sources included: the search path puts the folder with the
// mutated file first, so that headers and sources are mutated alike, and nothing comes from a library built without it.

// NOLINTBEGIN(bugprone-suspicious-include)
#include "derivatives/boundary/gauss_legendre.cpp"
#include "derivatives/boundary/small_source.cpp"
#include "derivatives/form_factor/area_rule.cpp"
#include "derivatives/form_factor/polygon_evaluation.cpp"
// NOLINTEND(bugprone-suspicious-include)

#include "tests/mutants/plain_numbers.h"

namespace irradiff {
namespace {

void answerProduction(const Vertices& vertices, const Receiver& receiver, FormulaAnswer& answer) {
  const PolygonEvaluation evaluation = evaluatePolygon({"polygon", vertices, 1.0}, 0, receiver);
  const double factor = evaluation.is_clockwise ? std::numbers::inv_pi : -std::numbers::inv_pi;
  const IrradianceDerivatives<double>& d = evaluation.derivatives;
  write(factor * d.irradiance.value, factor * d.gradient.value, factor * d.hessian.value, answer);
  write(factor * d.rotational_gradient.value, answer.rotational_gradient);
  // 1/pi is rounded and so is the product.
  const double division = 2.0 * 0x1p-53;
  answer.bounds[0] = std::numbers::inv_pi * (evaluation.bounds.irradiance + division * d.irradiance.value);
  answer.bounds[1] =
      std::numbers::inv_pi * (evaluation.bounds.gradient + division * d.gradient.value.cwiseAbs().maxCoeff());
  answer.bounds[2] =
      std::numbers::inv_pi * (evaluation.bounds.hessian + division * d.hessian.value.cwiseAbs().maxCoeff());
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
