// The formulas that are templates, at double.

#include "derivatives/form_factor/appendix_form.h"
#include "derivatives/form_factor/boundary_form.h"
#include "tests/mutants/plain_numbers.h"

#include <exception>
#include <numbers>

namespace irradiff {
namespace {

void answerBoundaryForm(const Vertices& vertices, const Receiver& receiver, FormulaAnswer& answer) {
  const FormFactor<double> f = boundaryFormFactor<double>(vertices, receiver.position, receiver.normal);
  write(f.value, f.gradient, f.hessian, answer);
}

void answerEdgeTerms(const Vertices& vertices, const Receiver& receiver, FormulaAnswer& answer) {
  const ClippedPolygon<double> clipped =
      clipAtHorizon<double>(std::span<const Vector3<double>>(vertices), receiver.position, receiver.normal);
  const RadianceBoundary<double> boundary = polygonBoundary(clipped, receiver.normal);
  const IrradianceDerivatives<double> sums = boundarySums(boundary, receiver.normal).derivatives;
  Vector3<double> gradient = Vector3<double>::Zero();
  Matrix3<double> hessian = Matrix3<double>::Zero();
  for (const BoundaryArc<double>& arc : boundary.arcs) {
    const ArcTerms<double> terms = arcTerms(arc, receiver.normal);
    gradient += std::numbers::inv_pi * terms.gradient;
    hessian += std::numbers::inv_pi * terms.hessian;
  }
  write(std::numbers::inv_pi * sums.irradiance.value, gradient, hessian, answer);
  write(std::numbers::inv_pi * sums.rotational_gradient.value, answer.rotational_gradient);
}

void answerAppendix(const Vertices& vertices, const Receiver& receiver, VertexAngle angle, FormulaAnswer& answer) {
  Vertices relative;
  for (const Vector3<double>& vertex : vertices) {
    relative.push_back(vertex - receiver.position);
  }
  const FormFactor<double> f = appendixFormFactor<double>(relative, receiver.normal, angle);
  write(f.value, f.gradient, f.hessian, answer);
}

bool answer(PolygonFormula formula, const Vertices& vertices, const Receiver& receiver, FormulaAnswer& result) {
  switch (formula) {
    case PolygonFormula::kBoundaryForm:
      answerBoundaryForm(vertices, receiver, result);
      return true;
    case PolygonFormula::kEdgeTerms:
      answerEdgeTerms(vertices, receiver, result);
      return true;
    case PolygonFormula::kAppendixArccos:
      answerAppendix(vertices, receiver, VertexAngle::kArccos, result);
      return true;
    case PolygonFormula::kAppendixArctangent:
      answerAppendix(vertices, receiver, VertexAngle::kArctangent, result);
      return true;
    case PolygonFormula::kProduction:
      break;
  }
  return false;
}

}  // namespace
}  // namespace irradiff

bool answerPolygon(PolygonFormula formula, const double* vertices, std::size_t vertex_count, const double* position,
                   const double* normal, FormulaAnswer* answer) {
  try {
    return irradiff::answer(formula, irradiff::verticesFrom(vertices, vertex_count),
                            irradiff::receiverFrom(position, normal), *answer);
  } catch (const std::exception&) {
    return false;
  }
}
