#include "tests/figures/small_maps.h"

#include "derivatives/boundary/irradiance.h"

#include <cmath>

namespace irradiff {

SceneEvaluation<3> QuadraticField::at(const Eigen::Vector3d& position, const Eigen::Vector3d& normal) const {
  SceneEvaluation<3> result;
  result.derivatives.irradiance.value = offset + slope.dot(position) + 0.5 * position.dot(curvature * position);
  result.derivatives.gradient.value = slope + curvature * position;
  result.derivatives.hessian.value = curvature;
  const Eigen::Matrix<double, 3, 2> tangents = tangentFrame(normal);
  result.derivatives.tangential_hessian.value = tangents.transpose() * curvature * tangents;
  result.derivatives.rotational_gradient.value.setZero();
  result.bounds = {1e-14, 2e-14, 3e-14, 4e-14, 5e-14};
  return result;
}

ViewEvaluator evaluatorOf(const QuadraticField& field) {
  return [field](const Receiver& receiver) {
    const SceneEvaluation<3> at = field.at(receiver.position, receiver.normal);
    return ViewEvaluation{at, at.derivatives.hessian, {}};
  };
}

ReceiverGrid unitGrid(std::size_t width, std::size_t height) {
  return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, width, height};
}

DerivativeMap plainMap(std::size_t width, std::size_t height) {
  const auto columns = static_cast<double>(width);
  const auto rows = static_cast<double>(height);
  return derivativeMap(
      unitGrid(width, height),
      [columns, rows](const Receiver& receiver) {
        QuadraticField field;
        field.curvature = Eigen::Vector3d(3, 1, -4).asDiagonal();
        SceneEvaluation<3> evaluation = field.at({0, 0, 0}, receiver.normal);
        evaluation.derivatives.irradiance.value =
            10 * std::floor(receiver.position.y() * rows) + std::floor(receiver.position.x() * columns);
        evaluation.derivatives.gradient.value = {1, -2, 0};
        return ViewEvaluation{evaluation, evaluation.derivatives.hessian, {}};
      },
      1);
}

}  // namespace irradiff
