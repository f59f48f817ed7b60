// The boundary form, a template, at double.

#include "derivatives/form_factor/boundary_form.h"
#include "tests/mutants/plain_numbers.h"

#include <exception>
#include <numbers>

namespace irradiff {
namespace {

void answerBoundaryForm(const Vertices& vertices, const Receiver& receiver, FormulaAnswer& answer) {
  const FormFactor<double> f = boundaryFormFactor<double>(vertices, receiver.position, receiver.normal);
  write(f.value, f.gradient, f.hessian, 1.0, answer);
}

void answerEdgeTerms(const Vertices& vertices, const Receiver& receiver, FormulaAnswer& answer) {
  const ClippedPolygon<double> clipped =
      clipAtHorizon<double>(std::span<const Vector3<double>>(vertices), receiver.position, receiver.normal);
  const RadianceBoundary<double> boundary = polygonBoundary(clipped, receiver.normal);
  const IrradianceDerivatives<double> sums = boundarySums(boundary, receiver.normal).derivatives;
  Vector3<double> gradient = Vector3<double>::Constant(0.0);
  Matrix3<double> hessian = Matrix3<double>::Constant(0.0);
  for (const BoundaryArc<double>& arc : boundary.arcs) {
    const ArcTerms<double> terms = arcTerms(arc, receiver.normal);
    gradient += terms.gradient;
    hessian += terms.hessian;
  }
  write(sums.irradiance.value, gradient, hessian, std::numbers::inv_pi, answer);
  write(sums.tangential_hessian.value, std::numbers::inv_pi, answer.tangential_hessian);
  write(sums.rotational_gradient.value, std::numbers::inv_pi, answer.rotational_gradient);
}

}  // namespace
}  // namespace irradiff

bool answerPolygon(PolygonFormula formula, const double* vertices, std::size_t vertex_count, const double* position,
                   const double* normal, FormulaAnswer* answer) {
  try {
    const irradiff::Vertices polygon = irradiff::verticesFrom(vertices, vertex_count);
    const irradiff::Receiver receiver = irradiff::receiverFrom(position, normal);
    if (formula == PolygonFormula::kEdgeTerms) {
      irradiff::answerEdgeTerms(polygon, receiver, *answer);
    } else {
      irradiff::answerBoundaryForm(polygon, receiver, *answer);
    }
    return true;
  } catch (const std::exception&) {
    return false;
  }
}
