#include "experiments/inspection/point_inspection.h"

#include "derivatives/flatland/flatland_scene.h"
#include "derivatives/flatland/nearest_events.h"
#include "derivatives/scene/invalid_scene.h"
#include "derivatives/visibility/radiance_topology.h"
#include "experiments/inspection/evaluation_cost.h"
#include "verification/certified/certified_flatland.h"
#include "verification/certified/certified_scene.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace irradiff {
namespace {

template <int Dimension>
double promisedRange(double irradiance, const Eigen::Matrix<double, Dimension, Dimension>& hessian) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dimension, Dimension>> solver(hessian,
                                                                                          Eigen::EigenvaluesOnly);
  const double largest = solver.eigenvalues().cwiseAbs().maxCoeff();
  return largest > 0.0 ? std::sqrt(2.0 * kRangeError * irradiance / largest) : std::numeric_limits<double>::infinity();
}

template <int Dimension>
void judgeHessian(const VisibilityEvents<Dimension>& events, PointInspection<Dimension>& point) {
  const SceneEvaluation<Dimension>& e = point.evaluation;
  if (!events.empty()) point.event = events.front();
  const auto jump = std::ranges::find_if(events, &VisibilityEvent<Dimension>::hessian_jumps);
  if (jump != events.end()) point.jump = *jump;
  if (!e.no_hessian.empty()) {
    point.hessian = HessianUse::kMissing;
    return;
  }
  const double irradiance = e.derivatives.irradiance.value;
  if (irradiance > 0.0) point.promised_range = promisedRange(irradiance, e.derivatives.hessian.value);
  if (point.jump && point.jump->distance <= point.jump->rounding) {
    point.hessian = HessianUse::kUndecided;
  } else if (irradiance > 0.0 && e.bounds.hessian > kRangeError * e.derivatives.hessian.value.cwiseAbs().maxCoeff()) {
    point.hessian = HessianUse::kUncertain;
  } else if (point.jump && point.jump->distance < 0.5 * point.promised_range) {
    point.hessian = HessianUse::kShort;
  }
}

}  // namespace

const char* nameOf(HessianUse use) {
  switch (use) {
    case HessianUse::kMissing:
      return "missing";
    case HessianUse::kUndecided:
      return "undecided";
    case HessianUse::kUncertain:
      return "uncertain";
    case HessianUse::kShort:
      return "short";
    case HessianUse::kGood:
      return "good";
  }
  return "";
}

const char* nameOf(EventKind kind) {
  switch (kind) {
    case EventKind::kVertexOnEdge:
      return "vertex_on_edge";
    case EventKind::kThreeEdges:
      return "three_edges";
    case EventKind::kEdgeOn:
      return "edge_on";
    case EventKind::kHorizon:
      return "horizon";
  }
  return "";
}

template <int Dimension>
LoosestBound loosestBound(const SceneEvaluation<Dimension>& evaluation) {
  const IrradianceDerivatives<double, Dimension>& d = evaluation.derivatives;
  LoosestBound loosest;
  const auto include = [&](std::string_view quantity, const std::string& reason, double bound, double norm) {
    if (!reason.empty() || bound == 0.0) return;
    const double relative = bound / norm;
    if (relative > loosest.relative) loosest = {relative, quantity};
  };
  // Without light nothing cancels.
  if (d.irradiance.value == 0.0 && d.gradient.value.isZero(0.0) && d.hessian.value.isZero(0.0)) return loosest;
  const double irradiance = std::abs(d.irradiance.value);
  include("irradiance", evaluation.no_irradiance, evaluation.bounds.irradiance, irradiance);
  include("gradient", evaluation.no_gradient, evaluation.bounds.gradient, d.gradient.value.cwiseAbs().maxCoeff());
  include("hessian", evaluation.no_hessian, evaluation.bounds.hessian, d.hessian.value.cwiseAbs().maxCoeff());
  include("tangential_hessian", evaluation.no_tangential_hessian, evaluation.bounds.tangential_hessian,
          d.tangential_hessian.value.cwiseAbs().maxCoeff());
  include("rotational_gradient", evaluation.no_irradiance, evaluation.bounds.rotational_gradient,
          std::max(irradiance, d.rotational_gradient.value.cwiseAbs().maxCoeff()));
  return loosest;
}

template LoosestBound loosestBound(const SceneEvaluation<3>&);
template LoosestBound loosestBound(const SceneEvaluation<2>&);

PointInspection<3> inspectPoint(const SceneEvaluator& evaluator, const Receiver& receiver, double tolerance) {
  PointInspection<3> point;
  point.receiver = receiver;
  point.evaluation = evaluator.evaluate(receiver);
  point.loosest_bound = loosestBound(point.evaluation);
  point.rung = certifyScene(evaluator, receiver, tolerance).rung();
  point.cost = estimateCost(workOf(evaluator, evaluator.compose(receiver), point.evaluation, receiver));
  judgeHessian(evaluator.nearestEvents(receiver, 1), point);
  return point;
}

PointInspection<2> inspectPoint(std::span<const Segment> segments, const FlatlandReceiver& receiver, double tolerance) {
  PointInspection<2> point;
  point.receiver = receiver;
  point.evaluation = evaluateScene(segments, receiver);
  point.loosest_bound = loosestBound(point.evaluation);
  point.rung = certifyScene(segments, receiver, tolerance).rung();
  judgeHessian(nearestEvents(segments, receiver, 1), point);
  return point;
}

std::optional<double> confirmedChange(const SceneEvaluator& evaluator, const Receiver& receiver) {
  std::vector<double> radiances;
  for (const Polygon& polygon : evaluator.polygons()) radiances.push_back(polygon.radiance);
  constexpr double kBeyond = 1.001;
  constexpr std::size_t kTried = 8;
  const VisibleBoundary here = radianceTopology(evaluator.view(receiver), radiances);
  for (const VisibilityEvent<3>& event : evaluator.nearestEvents(receiver, kTried)) {
    const Receiver beyond{receiver.position + kBeyond * event.displacement, receiver.normal};
    try {
      if (!(radianceTopology(evaluator.view(beyond), radiances) == here)) return kBeyond * event.displacement.norm();
    } catch (const InvalidScene&) {
      // On a surface: something else is seen there in any case.
      return kBeyond * event.displacement.norm();
    }
  }
  return std::nullopt;
}

}  // namespace irradiff
