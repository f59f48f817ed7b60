// The appendix form, a template, at double, with vertices relative to the receiver in double.

#include "derivatives/form_factor/appendix_form.h"
#include "tests/mutants/plain_numbers.h"

#include <exception>

bool answerPolygon(PolygonFormula formula, const double* vertices, std::size_t vertex_count, const double* position,
                   const double* normal, FormulaAnswer* answer) {
  using irradiff::VertexAngle;
  try {
    const irradiff::Receiver receiver = irradiff::receiverFrom(position, normal);
    irradiff::Vertices relative;
    for (const irradiff::Vector3<double>& vertex : irradiff::verticesFrom(vertices, vertex_count)) {
      relative.push_back(irradiff::difference(vertex, receiver.position));
    }
    const irradiff::FormFactor<double> f = irradiff::appendixFormFactor<double>(
        relative, receiver.normal,
        formula == PolygonFormula::kAppendixArccos ? VertexAngle::kArccos : VertexAngle::kArctangent);
    irradiff::write(f.value, f.gradient, f.hessian, 1.0, *answer);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}
