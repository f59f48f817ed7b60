// evaluateSegment.

#include "derivatives/flatland/segment_evaluation.h"
#include "tests/mutants/formula_entry_points.h"

#include <exception>

bool answerSegment(const double* vertices, const double* position, const double* normal, FormulaAnswer* answer) {
  try {
    const irradiff::Segment segment{"segment", {{{vertices[0], vertices[1]}, {vertices[2], vertices[3]}}}, 1.0};
    const irradiff::FlatlandReceiver receiver{{position[0], position[1]}, {normal[0], normal[1]}};
    const irradiff::SegmentEvaluation evaluation = irradiff::evaluateSegment(segment, 0, receiver);
    const irradiff::IrradianceDerivatives<double, 2>& d = evaluation.derivatives;
    answer->value = d.irradiance.value;
    answer->tangential_hessian[0] = d.tangential_hessian.value(0);
    answer->rotational_gradient[0] = d.rotational_gradient.value(0);
    for (int i = 0; i < 2; ++i) {
      answer->gradient[i] = d.gradient.value(i);
      for (int j = 0; j < 2; ++j) {
        answer->hessian[2 * i + j] = d.hessian.value(i, j);
      }
    }
    answer->bounds[0] = evaluation.bounds.irradiance;
    answer->bounds[1] = evaluation.bounds.gradient;
    answer->bounds[2] = evaluation.bounds.hessian;
    answer->bounds[3] = evaluation.bounds.tangential_hessian;
    answer->bounds[4] = evaluation.bounds.rotational_gradient;
    return true;
  } catch (const std::exception&) {
    return false;
  }
}
