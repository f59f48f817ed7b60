#include "verification/exact_boundary/exact_evaluation.h"

#include "derivatives/form_factor/polygon_evaluation.h"
#include "verification/enclosure/ball_vector.h"
#include "verification/exact_boundary/exact_boundary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace irradiff {

namespace {

/// Rounds balls to doubles and bounds what that leaves, in the max norm.
class BallRounding {
 public:
  explicit BallRounding(double& bound) : bound_(bound) {}

  double operator()(const Ball& ball) const {
    const double value = ball.toDouble();
    // The magnitude is rounded upwards, and then once more to double.
    const double distance = (ball - Ball(value)).magnitude().toDouble();
    bound_ = std::max(bound_, std::nextafter(distance, std::numeric_limits<double>::infinity()));
    return value;
  }

 private:
  double& bound_;
};

/// Whether something hides a part of the polygon: it is then less bright in the scene than alone.
bool isPartlyHidden(const ExactVisibility& seen, const std::vector<Polygon>& polygons, std::size_t index,
                    const Receiver& receiver) {
  std::vector<double> alone(polygons.size(), 0.0);
  alone[index] = 1.0;
  const BallVector normal = exactly(receiver.normal);
  const Ball in_scene =
      sumsOf<Ball>(exactBoundary(seen, polygons, alone, receiver), normal).derivatives.irradiance.value;
  const std::vector<Polygon> polygon{polygons[index]};
  const std::vector<double> radiance{1.0};
  const Ball by_itself =
      sumsOf<Ball>(exactBoundary(exactVisibility(polygon, receiver), polygon, radiance, receiver), normal)
          .derivatives.irradiance.value;
  return in_scene < by_itself;
}

void keepFirst(std::string& reason, const std::string& other) {
  if (reason.empty()) reason = other;
}

}  // namespace

SceneEvaluation<3> evaluateExactly(const std::vector<Polygon>& polygons, const Receiver& receiver) {
  const WorkingPrecision precision(kDefaultPrecision);
  std::vector<double> radiances;
  std::vector<PolygonEvaluation> rules;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    radiances.push_back(polygons[i].radiance);
    rules.push_back(classifyPolygon(polygons[i], i, receiver));
  }
  const ExactVisibility seen = exactVisibility(polygons, receiver);
  const ExactBoundary boundary = exactBoundary(seen, polygons, radiances, receiver);
  const IrradianceDerivatives<Ball> balls = sumsOf<Ball>(boundary, exactly(receiver.normal)).derivatives;

  SceneEvaluation<3> evaluation = darkScene<3>();
  IrradianceDerivatives<double>& values = evaluation.derivatives;
  values.irradiance.value = BallRounding(evaluation.bounds.irradiance)(balls.irradiance.value);
  values.gradient.value = balls.gradient.value.unaryExpr(BallRounding(evaluation.bounds.gradient));
  values.hessian.value = balls.hessian.value.unaryExpr(BallRounding(evaluation.bounds.hessian));
  values.tangential_hessian.value =
      balls.tangential_hessian.value.unaryExpr(BallRounding(evaluation.bounds.tangential_hessian));
  values.rotational_gradient.value =
      balls.rotational_gradient.value.unaryExpr(BallRounding(evaluation.bounds.rotational_gradient));
  evaluation.apparent_vertices = boundary.apparent_vertices;
  keepFirst(evaluation.no_gradient, boundary.no_gradient);
  keepFirst(evaluation.no_hessian, boundary.no_hessian);

  std::vector<bool> is_seen(polygons.size(), false);
  for (const ExactArc& arc : seen.arcs) {
    for (const FrontPolygon& side : {arc.left, arc.right}) {
      if (side) is_seen[*side] = true;
    }
  }
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const PolygonEvaluation& rule = rules[i];
    if (rule.rule == PolygonRule::kEdgeOn || is_seen[i]) {
      keepFirst(evaluation.no_gradient, rule.no_gradient);
      keepFirst(evaluation.no_hessian, rule.no_hessian);
    }
    if (is_seen[i] && polygons[i].radiance > 0.0 && rule.crosses_horizon) evaluation.crosses_horizon = true;
    if (!evaluation.has_occlusion && rule.rule == PolygonRule::kBoundary) {
      evaluation.has_occlusion = isPartlyHidden(seen, polygons, i, receiver);
    }
  }
  keepFirst(evaluation.no_hessian, evaluation.no_gradient);
  evaluation.no_tangential_hessian = evaluation.no_gradient;
  keepFirst(evaluation.no_tangential_hessian, boundary.no_hessian);
  requireFinite(evaluation, receiver, [] { return std::string("what is seen"); });
  return evaluation;
}

}  // namespace irradiff
