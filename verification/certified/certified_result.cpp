#include "verification/certified/certified_result.h"

#include "derivatives/scene/invalid_scene.h"
#include "verification/certified/rounded_evaluation.h"

#include <cmath>
#include <string>

namespace irradiff {

namespace {

/// A quantity that does not exist has no number.
template <int Dimension>
void clearMissing(SceneEvaluation<Dimension>& evaluation) {
  if (!evaluation.no_gradient.empty()) {
    evaluation.derivatives.gradient.value.setZero();
    evaluation.bounds.gradient = 0.0;
  }
  if (!evaluation.no_hessian.empty()) {
    evaluation.derivatives.hessian.value.setZero();
    evaluation.bounds.hessian = 0.0;
  }
  if (!evaluation.no_tangential_hessian.empty()) {
    evaluation.derivatives.tangential_hessian.value.setZero();
    evaluation.bounds.tangential_hessian = 0.0;
  }
}

/// Whether irradiance and the rotational gradient are known at all; derivatives that are not get a reason.
template <int Dimension>
bool explainUnknown(SceneEvaluation<Dimension>& evaluation) {
  const DerivativeBounds& bounds = evaluation.bounds;
  const std::string reason =
      "irradiance has a kink, or what is seen is not told by " + std::to_string(kMostBits) + " bits";
  const auto explain = [&reason](double bound, std::string& missing) {
    if (!std::isfinite(bound) && missing.empty()) missing = reason;
  };
  explain(bounds.gradient, evaluation.no_gradient);
  explain(bounds.hessian, evaluation.no_hessian);
  explain(bounds.tangential_hessian, evaluation.no_tangential_hessian);
  return std::isfinite(bounds.irradiance) && std::isfinite(bounds.rotational_gradient);
}

}  // namespace

template <int Dimension>
Rung CertifiedScene<Dimension>::rung() const {
  Rung highest = Rung::kDouble;
  for (const Rung rung : kRungs) {
    if (sources[static_cast<std::size_t>(rung)] > 0) highest = rung;
  }
  return highest;
}

template <int Dimension>
CertifiedScene<Dimension> climbTogether(const SceneEvaluation<Dimension>& dark,
                                        std::vector<LadderSource<Dimension>>& sources,
                                        const ReceiverIn<Dimension>& receiver, double tolerance) {
  CertifiedScene<Dimension> result;
  result.evaluation = dark;
  const WantedQuantities wanted{dark.no_gradient.empty(), dark.no_hessian.empty(), dark.no_tangential_hessian.empty()};
  const CertifiedValue<Dimension> sum = climb(sources, tolerance, wanted);
  for (const LadderSource<Dimension>& source : sources) ++result.sources[static_cast<std::size_t>(source.step.rung)];
  result.enclosure = sum.enclosure;
  result.misses_tolerance = !meets(sum, tolerance, wanted);
  roundTo(sum, result.evaluation.derivatives, result.evaluation.bounds);
  const bool is_known = !isFinite(result.evaluation.derivatives) || explainUnknown(result.evaluation);
  clearMissing(result.evaluation);
  if (!is_known) {
    throw InvalidScene("what " + describeReceiver(receiver) + " sees is not told by " + std::to_string(kMostBits) +
                       " bits");
  }
  requireFinite(result.evaluation, receiver, [] { return std::string("what is seen"); });
  return result;
}

template struct CertifiedScene<2>;
template struct CertifiedScene<3>;
template CertifiedScene<2> climbTogether(const SceneEvaluation<2>&, std::vector<LadderSource<2>>&,
                                         const FlatlandReceiver&, double);
template CertifiedScene<3> climbTogether(const SceneEvaluation<3>&, std::vector<LadderSource<3>>&, const Receiver&,
                                         double);

}  // namespace irradiff
