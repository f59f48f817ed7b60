#include "derivatives/visibility/unoccluded_scene.h"

#include "derivatives/form_factor/appendix_evaluation.h"
#include "derivatives/form_factor/polygon_evaluation.h"
#include "derivatives/scene/invalid_scene.h"
#include "derivatives/visibility/view_overlap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

/// Why the tangential Hessian of a source has no value: not for a source that only ends on the horizon.
const std::string& noTangentialHessian(const PolygonEvaluation& source) { return source.no_gradient; }
const std::string& noTangentialHessian(const AppendixEvaluation& source) { return source.no_tangential_hessian; }

void keepFirst(std::string& reason, const std::string& other) {
  if (reason.empty()) {
    reason = other;
  }
}

template <class Evaluation>
void keepReasons(SceneEvaluation<3>& sum, const Evaluation& source) {
  keepFirst(sum.no_gradient, source.no_gradient);
  keepFirst(sum.no_hessian, source.no_hessian);
  keepFirst(sum.no_tangential_hessian, noTangentialHessian(source));
}

template <class Evaluation>
void add(SceneEvaluation<3>& sum, const Evaluation& source, double radiance) {
  addSource(sum, source.derivatives, source.bounds, radiance);
  sum.crosses_horizon = sum.crosses_horizon || source.crosses_horizon;
  keepReasons(sum, source);
}

[[noreturn]] void rejectOverlap(std::span<const Polygon> polygons, std::size_t a, std::size_t b,
                                const Receiver& receiver) {
  std::ostringstream text;
  text << "polygons[" << a << "] \"" << polygons[a].name << "\" and polygons[" << b << "] \"" << polygons[b].name
       << "\" overlap as seen from " << describeReceiver(receiver)
       << ": one hides part of the other, and occlusion is not evaluated";
  throw InvalidScene(text.str());
}

/// The irradiance that the sources in view would give with radiance 1, less what it may be off. Sources that hide
/// nothing of each other give no more than the whole hemisphere does. Closer to two sources than the rounding of their
/// coordinates, where directions tell nothing, this still does.
class Coverage {
 public:
  explicit Coverage(double hemisphere) : hemisphere_(hemisphere) {}

  void add(std::size_t index, double irradiance, double bound) {
    sum_ += irradiance - bound;
    parts_.emplace_back(irradiance, index);
  }

  /// Whether the sources overlap by more than neighbours that rounding pushes over each other.
  bool exceedsHemisphere() const { return parts_.size() > 1 && sum_ > 1.01 * hemisphere_; }

  /// The two that cover most, in the order of the scene. Requires exceedsHemisphere().
  std::pair<std::size_t, std::size_t> largest() const {
    std::vector<std::pair<double, std::size_t>> parts = parts_;
    std::partial_sort(parts.begin(), parts.begin() + 2, parts.end(), std::greater<>());
    return {std::min(parts[0].second, parts[1].second), std::max(parts[0].second, parts[1].second)};
  }

 private:
  double hemisphere_;
  double sum_ = 0.0;
  std::vector<std::pair<double, std::size_t>> parts_;
};

/// Adds what the polygon contributes; returns whether it covers a part of the view.
bool addPolygon(SceneEvaluation<3>& sum, Coverage& coverage, const Polygon& polygon, std::size_t index,
                const Receiver& receiver, PolygonMethod method) {
  const auto addEvaluation = [&](const auto& evaluation) {
    if (polygon.radiance > 0.0) {
      add(sum, evaluation, polygon.radiance);
    } else if (evaluation.rule == PolygonRule::kEdgeOn) {
      // A black polygon adds nothing, but on one side of its plane it may hide what radiates.
      keepReasons(sum, evaluation);
    }
    return evaluation.rule == PolygonRule::kBoundary || evaluation.rule == PolygonRule::kArea;
  };
  if (method == PolygonMethod::kBoundary) {
    const PolygonEvaluation evaluation = evaluatePolygon(polygon, index, receiver);
    coverage.add(index, evaluation.derivatives.irradiance.value, evaluation.bounds.irradiance);
    return addEvaluation(evaluation);
  }
  const AppendixEvaluation evaluation = evaluateAppendix(polygon, index, receiver);
  coverage.add(index, evaluation.derivatives.irradiance.value, evaluation.bounds.irradiance);
  if (polygon.radiance > 0.0) {
    keepFirst(sum.no_irradiance, evaluation.no_irradiance);
  }
  return addEvaluation(evaluation);
}

}  // namespace

SceneEvaluation<3> evaluateUnoccluded(std::span<const Polygon> polygons, const Receiver& receiver,
                                      PolygonMethod method) {
  SceneEvaluation<3> sum = darkScene<3>();
  Coverage coverage(std::numbers::pi);
  std::vector<std::size_t> visible;
  std::vector<PolygonView> views;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (addPolygon(sum, coverage, polygons[i], i, receiver, method)) {
      visible.push_back(i);
      views.push_back(polygons.size() > 1 ? viewOf(polygons[i], triangulate(polygons[i]), receiver) : PolygonView{});
    }
  }
  for (std::size_t b = 1; b < visible.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const bool radiates = polygons[visible[a]].radiance > 0.0 || polygons[visible[b]].radiance > 0.0;
      if (radiates && overlap(views[a], views[b])) {
        rejectOverlap(polygons, visible[a], visible[b], receiver);
      }
    }
  }
  if (coverage.exceedsHemisphere() && sum.derivatives.irradiance.value > 0.0) {
    const auto [a, b] = coverage.largest();
    rejectOverlap(polygons, a, b, receiver);
  }
  requireFinite(sum, receiver);
  return sum;
}

}  // namespace irradiff
