#include "derivatives/visibility/unoccluded_scene.h"

#include "derivatives/flatland/segment_evaluation.h"
#include "derivatives/form_factor/polygon_evaluation.h"
#include "derivatives/scene/invalid_scene.h"
#include "derivatives/visibility/view_overlap.h"

#include <cmath>
#include <cstddef>
#include <sstream>
#include <vector>

namespace irradiff {
namespace {

constexpr double kUnitRoundoff = 0x1p-53;

/// Adds radiance times one source's evaluation, and to the bounds the roundings of that product and of the sums.
template <int Dimension, class Evaluation>
void add(SceneEvaluation<Dimension>& sum, const Evaluation& source, double radiance) {
  const IrradianceDerivatives<double, Dimension>& d = source.derivatives;
  IrradianceDerivatives<double, Dimension>& total = sum.derivatives;
  total.irradiance.value += radiance * d.irradiance.value;
  total.gradient.value += radiance * d.gradient.value;
  total.hessian.value += radiance * d.hessian.value;
  total.rotational_gradient.value += radiance * d.rotational_gradient.value;
  constexpr double kRounding = 2.0 * kUnitRoundoff;
  sum.bounds.irradiance +=
      radiance * source.bounds.irradiance + kRounding * (radiance * d.irradiance.value + total.irradiance.value);
  sum.bounds.gradient += radiance * source.bounds.gradient +
                         kRounding * (radiance * d.gradient.value.cwiseAbs().maxCoeff() + total.gradient.value.cwiseAbs().maxCoeff());
  sum.bounds.hessian += radiance * source.bounds.hessian +
                        kRounding * (radiance * d.hessian.value.cwiseAbs().maxCoeff() + total.hessian.value.cwiseAbs().maxCoeff());
  sum.crosses_horizon = sum.crosses_horizon || source.crosses_horizon;
  if (sum.no_gradient.empty()) {
    sum.no_gradient = source.no_gradient;
  }
  if (sum.no_hessian.empty()) {
    sum.no_hessian = source.no_hessian;
  }
  // A source that only ends on the horizon leaves the tangential Hessian alone.
  if (sum.no_tangential_hessian.empty()) {
    sum.no_tangential_hessian = source.no_gradient;
  }
}

template <int Dimension>
SceneEvaluation<Dimension> emptyScene() {
  SceneEvaluation<Dimension> sum;
  sum.derivatives.irradiance.value = 0.0;
  sum.derivatives.gradient.value.setZero();
  sum.derivatives.hessian.value.setZero();
  sum.derivatives.rotational_gradient.value.setZero();
  return sum;
}

template <class Source, class ReceiverType>
[[noreturn]] void rejectOverlap(const char* kind, std::span<const Source> sources, std::size_t a, std::size_t b,
                                const ReceiverType& receiver) {
  std::ostringstream text;
  text.precision(17);
  text << kind << '[' << a << "] \"" << sources[a].name << "\" and " << kind << '[' << b << "] \"" << sources[b].name
       << "\" overlap as seen from the receiver at [";
  for (Eigen::Index i = 0; i < receiver.position.size(); ++i) {
    text << (i > 0 ? ", " : "") << receiver.position(i);
  }
  text << "]: one hides part of the other, and occlusion is not evaluated";
  throw InvalidScene(text.str());
}

template <int Dimension>
void requireFinite(const SceneEvaluation<Dimension>& sum) {
  const IrradianceDerivatives<double, Dimension>& d = sum.derivatives;
  if (!std::isfinite(d.irradiance.value) || !d.gradient.value.allFinite() || !d.hessian.value.allFinite() ||
      !d.rotational_gradient.value.allFinite() || !std::isfinite(sum.bounds.hessian)) {
    throw InvalidScene("the sum over the scene's sources exceeds the range of double");
  }
}

}  // namespace

SceneEvaluation<3> evaluateUnoccluded(std::span<const Polygon> polygons, const Receiver& receiver) {
  SceneEvaluation<3> sum = emptyScene<3>();
  std::vector<std::size_t> visible;
  std::vector<PolygonView> views;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const PolygonEvaluation evaluation = evaluatePolygon(polygons[i], i, receiver);
    if (evaluation.rule != PolygonRule::kBoundary && evaluation.rule != PolygonRule::kArea &&
        evaluation.no_gradient.empty()) {
      continue;
    }
    if (polygons[i].radiance > 0.0) {
      add(sum, evaluation, polygons[i].radiance);
    }
    if (evaluation.rule != PolygonRule::kEdgeOn) {
      visible.push_back(i);
      views.push_back(polygons.size() > 1 ? viewOf(polygons[i], triangulate(polygons[i]), receiver) : PolygonView{});
    }
  }
  for (std::size_t b = 1; b < visible.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const bool radiates = polygons[visible[a]].radiance > 0.0 || polygons[visible[b]].radiance > 0.0;
      if (radiates && overlap(views[a], views[b])) {
        rejectOverlap("polygons", polygons, visible[a], visible[b], receiver);
      }
    }
  }
  requireFinite(sum);
  return sum;
}

SceneEvaluation<2> evaluateUnoccluded(std::span<const Segment> segments, const FlatlandReceiver& receiver) {
  SceneEvaluation<2> sum = emptyScene<2>();
  std::vector<std::size_t> visible;
  std::vector<SegmentView> views;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const SegmentEvaluation evaluation = evaluateSegment(segments[i], i, receiver);
    if (segments[i].radiance > 0.0) {
      add(sum, evaluation, segments[i].radiance);
    }
    if (const std::optional<SegmentView> view = viewOf(segments[i], receiver);
        view && evaluation.derivatives.irradiance.value > 0.0) {
      visible.push_back(i);
      views.push_back(*view);
    }
  }
  for (std::size_t b = 1; b < visible.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const bool radiates = segments[visible[a]].radiance > 0.0 || segments[visible[b]].radiance > 0.0;
      if (radiates && overlap(views[a], views[b])) {
        rejectOverlap("segments", segments, visible[a], visible[b], receiver);
      }
    }
  }
  requireFinite(sum);
  return sum;
}

}  // namespace irradiff
