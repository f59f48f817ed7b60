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

/// The Hessian of the form factor as the sum over edges leaves it, before its transpose is averaged in. For polygons
/// that are not small compared with their distance.
Eigen::Matrix3d edgeTermsOfHessian(const Configuration& c) {
  const ClippedPolygon<double> clipped = clipAtHorizon<double>(std::span<const Eigen::Vector3d>(c.polygon.vertices),
                                                               c.receiver.position, c.receiver.normal);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const BoundaryArc<double>& arc : polygonBoundary(clipped, c.receiver.normal).arcs) {
    sum += arcTerms(arc, c.receiver.normal).hessian;
  }
  return std::numbers::inv_pi * sum;
}

/// A formula that returns a FormFactor<double>; the tangential Hessian is its Hessian projected.
template <class Evaluate>
Candidate candidateOf(const char* name, const Evaluate& evaluate) {
  Candidate candidate;
  candidate.name = name;
  candidate.form_factor = [evaluate](const Configuration& c) { return evaluate(c).value; };
  candidate.gradient = [evaluate](const Configuration& c) { return evaluate(c).gradient; };
  candidate.hessian = [evaluate](const Configuration& c) { return evaluate(c).hessian; };
  candidate.tangential_hessian = [evaluate](const Configuration& c) {
    return tangentialHessian<double>(evaluate(c).hessian, c.receiver.normal).value;
  };
  return candidate;
}

Candidate appendixCandidate(const char* name, VertexAngle angle) {
  const auto evaluate = [angle](const Configuration& c) {
    std::vector<Eigen::Vector3d> relative;
    for (const Eigen::Vector3d& v : c.polygon.vertices) {
      relative.push_back(v - c.receiver.position);
    }
    return appendixFormFactor<double>(std::span<const Eigen::Vector3d>(relative), c.receiver.normal, angle);
  };
  return candidateOf(name, evaluate);
}

}  // namespace

Candidate productionCandidate() {
  const auto evaluate = [](const Configuration& c) { return evaluatePolygon(c.polygon, 0, c.receiver); };
  Candidate candidate;
  candidate.name = "production";
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
  candidate.tangential_hessian = [evaluate](const Configuration& c) -> Eigen::Matrix2d {
    const PolygonEvaluation evaluation = evaluate(c);
    return toFormFactor(evaluation) * evaluation.derivatives.tangential_hessian.value;
  };
  candidate.rotational_gradient = [evaluate](const Configuration& c) -> Eigen::Vector3d {
    const PolygonEvaluation evaluation = evaluate(c);
    return toFormFactor(evaluation) * evaluation.derivatives.rotational_gradient.value;
  };
  candidate.hessian_before_symmetrisation = edgeTermsOfHessian;
  candidate.bounds = [evaluate](const Configuration& c) {
    const PolygonEvaluation evaluation = evaluate(c);
    // Dividing by pi rounds the value twice more.
    constexpr double kDivision = 2.0 * 0x1p-53;
    constexpr double kInversePi = std::numbers::inv_pi;
    const IrradianceDerivatives<double>& d = evaluation.derivatives;
    return DerivativeBounds{
        kInversePi * (evaluation.bounds.irradiance + kDivision * d.irradiance.value),
        kInversePi * (evaluation.bounds.gradient + kDivision * d.gradient.value.cwiseAbs().maxCoeff()),
        kInversePi * (evaluation.bounds.hessian + kDivision * d.hessian.value.cwiseAbs().maxCoeff()),
        kInversePi *
            (evaluation.bounds.tangential_hessian + kDivision * d.tangential_hessian.value.cwiseAbs().maxCoeff()),
        kInversePi *
            (evaluation.bounds.rotational_gradient + kDivision * d.rotational_gradient.value.cwiseAbs().maxCoeff())};
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
  return candidateOf("boundary form, not compensated", evaluate);
}

Candidate appendixArccosCandidate() { return appendixCandidate("appendix form, acos", VertexAngle::kArccos); }

Candidate appendixArctangentCandidate() { return appendixCandidate("appendix form, atan2", VertexAngle::kArctangent); }

}  // namespace irradiff
