#include "derivatives/visibility/scene_evaluation.h"

#include "derivatives/boundary/boundary_sums.h"
#include "derivatives/form_factor/appendix_evaluation.h"
#include "derivatives/scene/coordinate_range.h"
#include "derivatives/scene/invalid_scene.h"
#include "derivatives/scene/number_text.h"
#include "derivatives/visibility/boundary_of_view.h"
#include "derivatives/visibility/view_grid.h"
#include "derivatives/visibility/view_unit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace irradiff {
namespace {

/// Whether a polygon may hide another. Seen edge-on it does on one side of its plane.
bool isPresent(PolygonRule rule) {
  return rule == PolygonRule::kBoundary || rule == PolygonRule::kArea || rule == PolygonRule::kEdgeOn;
}

/// Why the tangential Hessian of a source has no value: not for a source that only ends on the horizon.
const std::string& noTangentialHessian(const PolygonEvaluation& source) { return source.no_gradient; }
const std::string& noTangentialHessian(const AppendixEvaluation& source) { return source.no_tangential_hessian; }

const std::string& noIrradiance(const PolygonEvaluation&) {
  static const std::string none;
  return none;
}
const std::string& noIrradiance(const AppendixEvaluation& source) { return source.no_irradiance; }

void keepFirst(std::string& reason, const std::string& other) {
  if (reason.empty()) reason = other;
}

template <class Evaluation>
void keepReasons(SceneEvaluation<3>& sum, const Evaluation& source) {
  keepFirst(sum.no_irradiance, noIrradiance(source));
  keepFirst(sum.no_gradient, source.no_gradient);
  keepFirst(sum.no_hessian, source.no_hessian);
  keepFirst(sum.no_tangential_hessian, noTangentialHessian(source));
}

struct ViewSums {
  IrradianceDerivatives<double> derivatives;
  DerivativeBounds bounds;
  std::size_t apparent_vertices;
};

/// What the products with two tangents add to kVertexError (docs/derivations/visibility.md, section 5.4).
constexpr double kTurningError = 32.0;

/// What arcs and apparent vertices add up to.
ViewSums sumOverView(const SceneMesh& mesh, const VisibleBoundary& view, std::span<const double> radiances,
                     const Receiver& receiver, ApparentVertices vertices) {
  constexpr double kUnitRoundoff = 0x1p-53;
  const ViewUnit unit = viewUnit(mesh, view, radiances, receiver);
  const BoundaryOfView<double> of_view =
      boundaryOfView<double>(mesh, view, radiances, unit.position, receiver.normal, unit.exponent);
  const BoundarySums<double> sums = boundarySums(of_view.boundary, receiver.normal);
  // Beyond, the errors of places are not small any more.
  constexpr double kLargestPlaceError = 0x1p-10;
  if (!(kPlaceError * of_view.largest_place_error <= kLargestPlaceError)) {
    throw InvalidScene("edges cross at less than 1e-25 rad as seen from " + describeReceiver(receiver) +
                       ": where they do is beyond doubled precision");
  }
  // Squares of products of such distances leave the normal range, as those of polygons would (prepared_polygon.cpp).
  constexpr double kLargestInverseDistance = 0x1p250;
  for (const BoundaryArc<double>& arc : of_view.boundary.arcs) {
    if (!(arc.first.inverse_distance <= kLargestInverseDistance &&
          arc.last.inverse_distance <= kLargestInverseDistance)) {
      throw InvalidScene("an edge in view of " + describeReceiver(receiver) +
                         " comes nearer than 2^-250 of the distance of others that bound what is partly hidden: in "
                         "double, products of such coordinates underflow");
    }
  }
  // Every term rounds the partial sum once more, and so does the radiance jump.
  const auto terms =
      static_cast<double>(1 + of_view.boundary.arcs.size() + of_view.horizon_arcs + of_view.vertex_terms.size());
  const double irradiance_error = (kAngleError + terms) * kUnitRoundoff;
  const double derivative_error = (kArcError + terms) * kUnitRoundoff;
  const double tangential_error = (kTangentialError + terms) * kUnitRoundoff;
  ViewSums result{sums.derivatives, {}, of_view.vertex_terms.size()};
  result.bounds = {
      irradiance_error * sums.irradiance_size + kPlaceError * of_view.irradiance_slack,
      derivative_error * sums.gradient_size + kPlaceError * of_view.gradient_slack,
      derivative_error * sums.hessian_size + kPlaceError * of_view.hessian_slack,
      tangential_error * sums.tangential_size + kPlaceError * (sums.tangential_wide_size + of_view.hessian_slack),
      irradiance_error * sums.rotational_size + kPlaceError * (sums.rotational_wide_size + of_view.irradiance_slack)};
  if (vertices == ApparentVertices::kMove) {
    for (const ApparentVertexTerm<double>& term : of_view.vertex_terms) {
      result.derivatives.hessian.value += term.hessian;
      result.derivatives.tangential_hessian.value += tangentialHessian(term.hessian, receiver.normal).value;
      const double slack = kPlaceError * term.slack;
      result.bounds.hessian += (kVertexError + terms) * kUnitRoundoff * term.size + slack;
      // Each entry is a sum of nine with weights that are products of two direction cosines.
      result.bounds.tangential_hessian +=
          3.0 * ((kVertexError + kTurningError + terms) * kUnitRoundoff * term.size + slack);
    }
  }
  const int exponent = mesh.exponent() + unit.exponent;
  if (result.derivatives.irradiance.value < 0.0) {
    // Irradiance is not negative; setting it to 0 moves it by as much.
    result.bounds.irradiance -= result.derivatives.irradiance.value;
    result.derivatives.irradiance.value = 0.0;
  }
  const auto unscale = [](auto& value, int scale) {
    value = value.unaryExpr([scale](double v) { return std::ldexp(v, -scale); }).eval();
  };
  unscale(result.derivatives.gradient.value, exponent);
  unscale(result.derivatives.hessian.value, 2 * exponent);
  unscale(result.derivatives.tangential_hessian.value, 2 * exponent);
  // What is below the normal range loses digits.
  constexpr double kUnderflow = 4.0 * std::numeric_limits<double>::denorm_min();
  constexpr double kScaledUnderflow = 0x1p-1000;
  const auto unscaleBound = [](double& bound, int scale) {
    bound = std::ldexp(bound + kScaledUnderflow, -scale) + kUnderflow;
  };
  unscaleBound(result.bounds.irradiance, 0);
  unscaleBound(result.bounds.rotational_gradient, 0);
  unscaleBound(result.bounds.gradient, exponent);
  unscaleBound(result.bounds.hessian, 2 * exponent);
  unscaleBound(result.bounds.tangential_hessian, 2 * exponent);
  return result;
}

}  // namespace

SceneEvaluator::SceneEvaluator(std::span<const Polygon> polygons)
    : polygons_(polygons.begin(), polygons.end()),
      mesh_(polygons_),
      grid_resolution_(viewGridResolution(mesh_.faces().size())) {
  for (const Polygon& polygon : polygons_) {
    for (const Eigen::Vector3d& vertex : polygon.vertices) coordinates_.include(vertex);
  }
}

VisibleBoundary SceneEvaluator::viewOf(const std::vector<bool>& is_present, const Receiver& receiver,
                                       int grid_resolution) const {
  CoordinateRange coordinates = coordinates_;
  coordinates.include(receiver.position);
  if (const std::string violation = rangeViolation(coordinates, "a vertex of the scene", receiver.normal);
      !violation.empty()) {
    throw InvalidScene(describeReceiver(receiver) + ' ' + violation);
  }
  const ViewPredicates predicates(mesh_, positionIn(mesh_, receiver), receiver.normal);
  return visibleBoundary(mesh_, polygons_, is_present, predicates, grid_resolution);
}

SceneEvaluator::Classification SceneEvaluator::classify(const Receiver& receiver) const {
  Classification result;
  for (std::size_t i = 0; i < polygons_.size(); ++i) {
    result.polygons.push_back(classifyPolygon(polygons_[i], i, receiver));
    result.is_present.push_back(isPresent(result.polygons.back().rule));
  }
  return result;
}

VisibleBoundary SceneEvaluator::view(const Receiver& receiver) const { return view(receiver, grid_resolution_); }

VisibleBoundary SceneEvaluator::view(const Receiver& receiver, int grid_resolution) const {
  return viewOf(classify(receiver).is_present, receiver, grid_resolution);
}

SceneComposition SceneEvaluator::compose(const Receiver& receiver) const {
  const Classification classified = classify(receiver);
  return composeView(
      classified, classified.isAlone() ? VisibleBoundary{} : viewOf(classified.is_present, receiver, grid_resolution_));
}

SceneEvaluation<3> SceneEvaluator::evaluate(const Receiver& receiver, PolygonMethod method) const {
  return sumOf(compose(receiver), receiver, method, ApparentVertices::kMove);
}

SceneEvaluation<3> SceneEvaluator::evaluate(const Receiver& receiver, const VisibleBoundary& view,
                                            ApparentVertices vertices) const {
  return sumOf(composeView(classify(receiver), view), receiver, PolygonMethod::kBoundary, vertices);
}

SceneEvaluation<3> SceneEvaluator::evaluate(const Receiver& receiver, const SceneComposition& scene,
                                            ApparentVertices vertices) const {
  return sumOf(scene, receiver, PolygonMethod::kBoundary, vertices);
}

SceneComposition SceneEvaluator::composeView(const Classification& classified, VisibleBoundary view) const {
  const std::vector<PolygonEvaluation>& polygons = classified.polygons;
  const std::vector<bool>& is_present = classified.is_present;
  const bool is_alone = classified.isAlone();
  SceneComposition scene{darkScene<3>(), {}, std::vector<double>(polygons_.size(), 0.0), {}};
  SceneEvaluation<3>& dark = scene.dark;

  // A black polygon that ends on the horizon shows a change of radiance there only where something behind it radiates
  // as far down.
  const auto reachesHorizon = [&](std::size_t i) {
    return polygons_[i].radiance > 0.0 && is_present[i] &&
           (polygons[i].crosses_horizon || !polygons[i].no_hessian.empty());
  };
  bool any_reaches_horizon = false;
  for (std::size_t i = 0; i < polygons_.size(); ++i) any_reaches_horizon = any_reaches_horizon || reachesHorizon(i);

  SourceCounts counts;
  for (std::size_t i = 0; i < polygons_.size(); ++i) {
    const PolygonEvaluation& polygon = polygons[i];
    const double radiance = polygons_[i].radiance;
    const bool is_seen = is_alone || view.is_seen[i];
    if (polygon.rule == PolygonRule::kEdgeOn) {
      ++counts.edge_on;
      if (is_alone ? radiance > 0.0 : is_seen || view.edges_in_line) keepReasons(dark, polygon);
      continue;
    }
    if (is_present[i] && !is_seen) {
      ++counts.hidden;
      // What hangs down from an edge on the horizon is not seen yet.
      if (radiance > 0.0 || any_reaches_horizon) keepFirst(dark.no_hessian, polygon.no_hessian);
      continue;
    }
    if (radiance > 0.0) keepReasons(dark, polygon);
    if (radiance == 0.0 && any_reaches_horizon) keepFirst(dark.no_hessian, polygon.no_hessian);
    if (!is_present[i]) {
      ++(polygon.rule == PolygonRule::kOwnSurface ? counts.own_surface : counts.below_horizon);
      continue;
    }
    if (radiance == 0.0) {
      ++counts.black;
      continue;
    }
    dark.crosses_horizon = dark.crosses_horizon || polygon.crosses_horizon;
    if (!is_alone && view.is_partly_hidden[i]) {
      ++counts.partly_hidden;
      scene.partly_hidden[i] = radiance;
    } else {
      ++counts.boundary;
      scene.whole.push_back(i);
    }
  }
  dark.sources = counts;
  dark.has_occlusion = !is_alone && std::ranges::any_of(view.is_partly_hidden, std::identity{});
  if (view.edges_in_line) {
    keepFirst(dark.no_gradient, *view.edges_in_line);
    keepFirst(dark.no_hessian, *view.edges_in_line);
    keepFirst(dark.no_tangential_hessian, *view.edges_in_line);
  }
  if (view.crease_on_horizon) keepFirst(dark.no_hessian, *view.crease_on_horizon);
  if (view.meeting_in_view) {
    keepFirst(dark.no_hessian, *view.meeting_in_view);
    keepFirst(dark.no_tangential_hessian, *view.meeting_in_view);
  }
  scene.view = std::move(view);
  return scene;
}

SceneEvaluation<3> SceneEvaluator::sumOf(const SceneComposition& scene, const Receiver& receiver, PolygonMethod method,
                                         ApparentVertices vertices) const {
  SceneEvaluation<3> sum = scene.dark;
  for (const std::size_t i : scene.whole) {
    const double radiance = polygons_[i].radiance;
    const auto addWhole = [&](const auto& evaluation) {
      keepReasons(sum, evaluation);
      addSource(sum, evaluation.derivatives, evaluation.bounds, radiance);
    };
    if (method == PolygonMethod::kBoundary) {
      const PolygonEvaluation evaluation = evaluatePolygon(polygons_[i], i, receiver);
      if (evaluation.rule == PolygonRule::kArea) {
        --sum.sources->boundary;
        ++sum.sources->area_rule;
      }
      addWhole(evaluation);
    } else {
      addWhole(evaluateAppendix(polygons_[i], i, receiver));
    }
    requireFinite(sum, receiver, [&] { return describe(i) + ": its radiance " + numberText(radiance); });
  }
  if (const std::optional<std::size_t> hidden = scene.firstPartlyHidden()) {
    if (method == PolygonMethod::kAppendix) {
      throw InvalidScene(describe(*hidden) + " is partly hidden as seen from " + describeReceiver(receiver) +
                         ": the appendix form knows no occlusion, must be evaluated by the boundary form");
    }
    const ViewSums of_view = sumOverView(mesh_, scene.view, scene.partly_hidden, receiver, vertices);
    addSource(sum, of_view.derivatives, of_view.bounds, 1.0);
    sum.apparent_vertices = of_view.apparent_vertices;
    requireFinite(sum, receiver, [&] { return "what is seen of " + describe(*hidden) + " and others partly hidden"; });
  }
  return sum;
}

std::optional<std::size_t> SceneComposition::firstPartlyHidden() const {
  const auto first = std::ranges::find_if(partly_hidden, [](double radiance) { return radiance > 0.0; });
  if (first == partly_hidden.end()) return std::nullopt;
  return static_cast<std::size_t>(first - partly_hidden.begin());
}

bool SceneEvaluator::Classification::isAlone() const { return std::ranges::count(is_present, true) <= 1; }

std::string SceneEvaluator::describe(std::size_t polygon) const {
  return "polygons[" + std::to_string(polygon) + "] \"" + polygons_[polygon].name + '"';
}

}  // namespace irradiff
