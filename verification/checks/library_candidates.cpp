#include "verification/checks/library_candidates.h"

#include "derivatives/form_factor/appendix_form.h"
#include "derivatives/form_factor/boundary_form.h"
#include "derivatives/form_factor/polygon_evaluation.h"

#include <numbers>
#include <span>

namespace irradiff {
namespace {

/// The factor from irradiance, which is positive always, to the form factor, which is positive for vertices clockwise
/// seen from the receiver.
double toFormFactor(const PolygonEvaluation& evaluation) {
  return evaluation.is_clockwise ? std::numbers::inv_pi : -std::numbers::inv_pi;
}

Candidate appendixCandidate(const char* name, VertexAngle angle) {
  const auto evaluate = [angle](const Configuration& c) {
    std::vector<Eigen::Vector3d> relative;
    for (const Eigen::Vector3d& v : c.polygon.vertices) {
      relative.push_back(v - c.receiver.position);
    }
    return appendixFormFactor<double>(std::span<const Eigen::Vector3d>(relative), c.receiver.normal, angle);
  };
  return {name, [evaluate](const Configuration& c) { return evaluate(c).value; },
          [evaluate](const Configuration& c) { return evaluate(c).gradient; },
          [evaluate](const Configuration& c) { return evaluate(c).hessian; }, nullptr};
}

}  // namespace

Candidate productionCandidate() {
  const auto evaluate = [](const Configuration& c) { return evaluatePolygon(c.polygon, 0, c.receiver); };
  Candidate candidate{"production", nullptr, nullptr, nullptr, nullptr};
  candidate.form_factor = [evaluate](const Configuration& c) {
    const PolygonEvaluation evaluation = evaluate(c);
    return toFormFactor(evaluation) * evaluation.derivatives.irradiance.value;
  };
  candidate.gradient = [evaluate](const Configuration& c) -> Eigen::Vector3d {
    const PolygonEvaluation evaluation = evaluate(c);
    return toFormFactor(evaluation) * evaluation.derivatives.gradient.value;
  };
  candidate.hessian = [evaluate](const Configuration& c) -> Eigen::Matrix3d {
    const PolygonEvaluation evaluation = evaluate(c);
    return toFormFactor(evaluation) * evaluation.derivatives.hessian.value;
  };
  candidate.bounds = [evaluate](const Configuration& c) {
    const PolygonEvaluation evaluation = evaluate(c);
    // Dividing by pi rounds the value twice more.
    constexpr double kDivision = 2.0 * 0x1p-53;
    constexpr double kInversePi = std::numbers::inv_pi;
    const IrradianceDerivatives<double>& d = evaluation.derivatives;
    return DerivativeBounds{
        kInversePi * (evaluation.bounds.irradiance + kDivision * d.irradiance.value),
        kInversePi * (evaluation.bounds.gradient + kDivision * d.gradient.value.cwiseAbs().maxCoeff()),
        kInversePi * (evaluation.bounds.hessian + kDivision * d.hessian.value.cwiseAbs().maxCoeff())};
  };
  return candidate;
}

Candidate plainBoundaryCandidate() {
  const auto evaluate = [](const Configuration& c) {
    // Rounded differences from the receiver, and no wider arithmetic after them.
    std::vector<Eigen::Vector3d> relative;
    for (const Eigen::Vector3d& v : c.polygon.vertices) {
      relative.push_back(v - c.receiver.position);
    }
    return boundaryFormFactor<double, double>(relative, Eigen::Vector3d::Zero(), c.receiver.normal);
  };
  return {"boundary form, not compensated", [evaluate](const Configuration& c) { return evaluate(c).value; },
          [evaluate](const Configuration& c) { return evaluate(c).gradient; },
          [evaluate](const Configuration& c) { return evaluate(c).hessian; }, nullptr};
}

Candidate appendixArccosCandidate() { return appendixCandidate("appendix form, acos", VertexAngle::kArccos); }

Candidate appendixArctangentCandidate() { return appendixCandidate("appendix form, atan2", VertexAngle::kArctangent); }

}  // namespace irradiff
