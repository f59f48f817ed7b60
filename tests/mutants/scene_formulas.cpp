// SceneEvaluator.

#include "derivatives/visibility/scene_evaluation.h"
#include "tests/mutants/plain_numbers.h"

#include <exception>
#include <limits>

namespace irradiff {
namespace {

void answerWith(const std::vector<Polygon>& polygons, const Receiver& receiver, FormulaAnswer& answer) {
  const SceneEvaluation<3> sum = SceneEvaluator(polygons).evaluate(receiver);
  const IrradianceDerivatives<double>& d = sum.derivatives;
  write(d.irradiance.value, d.gradient.value, d.hessian.value, 1.0, answer);
  if (!sum.no_gradient.empty()) answer.gradient[0] = std::numeric_limits<double>::quiet_NaN();
  if (!sum.no_hessian.empty()) answer.hessian[0] = std::numeric_limits<double>::quiet_NaN();
  answer.bounds[0] = sum.bounds.irradiance;
  answer.bounds[1] = sum.bounds.gradient;
  answer.bounds[2] = sum.bounds.hessian;
}

}  // namespace
}  // namespace irradiff

bool answerScene(const double* vertices, const std::size_t* vertex_counts, const double* radiances,
                 std::size_t polygon_count, const double* position, const double* normal, FormulaAnswer* answer) {
  try {
    std::vector<irradiff::Polygon> polygons;
    for (std::size_t i = 0; i < polygon_count; ++i) {
      polygons.push_back({"polygon", irradiff::verticesFrom(vertices, vertex_counts[i]), radiances[i]});
      vertices += 3 * vertex_counts[i];
    }
    irradiff::answerWith(polygons, irradiff::receiverFrom(position, normal), *answer);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}
