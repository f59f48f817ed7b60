#include "derivatives/visibility/unoccluded_scene.h"

#include "derivatives/flatland/segment_evaluation.h"
#include "derivatives/scene/invalid_scene.h"
#include "derivatives/visibility/view_overlap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

constexpr double kUnitRoundoff = 0x1p-53;

/// What the products with radiance lose below the normal range.
constexpr double kUnderflow = 2.0 * std::numeric_limits<double>::denorm_min();

/// Why the tangential Hessian of a source has no value: not for a source that only ends on the horizon.
const std::string& noTangentialHessian(const SegmentEvaluation& source) { return source.no_gradient; }

void keepFirst(std::string& reason, const std::string& other) {
  if (reason.empty()) {
    reason = other;
  }
}

template <int Dimension, class Evaluation>
void keepReasons(SceneEvaluation<Dimension>& sum, const Evaluation& source) {
  keepFirst(sum.no_gradient, source.no_gradient);
  keepFirst(sum.no_hessian, source.no_hessian);
  keepFirst(sum.no_tangential_hessian, noTangentialHessian(source));
}

/// Adds radiance times one source's evaluation, and to the bounds the roundings of that product and of the sums.
template <int Dimension, class Evaluation>
void add(SceneEvaluation<Dimension>& sum, const Evaluation& source, double radiance) {
  const IrradianceDerivatives<double, Dimension>& d = source.derivatives;
  IrradianceDerivatives<double, Dimension>& total = sum.derivatives;
  total.irradiance.value += radiance * d.irradiance.value;
  total.gradient.value += radiance * d.gradient.value;
  total.hessian.value += radiance * d.hessian.value;
  total.tangential_hessian.value += radiance * d.tangential_hessian.value;
  total.rotational_gradient.value += radiance * d.rotational_gradient.value;
  const auto addBound = [radiance](double& bound, double source_bound, double source_size, double total_size) {
    bound += radiance * source_bound + 2.0 * kUnitRoundoff * (radiance * source_size + total_size) + kUnderflow;
  };
  addBound(sum.bounds.irradiance, source.bounds.irradiance, std::abs(d.irradiance.value),
           std::abs(total.irradiance.value));
  addBound(sum.bounds.gradient, source.bounds.gradient, d.gradient.value.cwiseAbs().maxCoeff(),
           total.gradient.value.cwiseAbs().maxCoeff());
  addBound(sum.bounds.hessian, source.bounds.hessian, d.hessian.value.cwiseAbs().maxCoeff(),
           total.hessian.value.cwiseAbs().maxCoeff());
  addBound(sum.bounds.tangential_hessian, source.bounds.tangential_hessian,
           d.tangential_hessian.value.cwiseAbs().maxCoeff(), total.tangential_hessian.value.cwiseAbs().maxCoeff());
  addBound(sum.bounds.rotational_gradient, source.bounds.rotational_gradient,
           d.rotational_gradient.value.cwiseAbs().maxCoeff(), total.rotational_gradient.value.cwiseAbs().maxCoeff());
  sum.crosses_horizon = sum.crosses_horizon || source.crosses_horizon;
  keepReasons(sum, source);
}

template <int Dimension>
SceneEvaluation<Dimension> emptyScene() {
  SceneEvaluation<Dimension> sum;
  sum.derivatives.irradiance.value = 0.0;
  sum.derivatives.gradient.value.setZero();
  sum.derivatives.hessian.value.setZero();
  sum.derivatives.tangential_hessian.value.setZero();
  sum.derivatives.rotational_gradient.value.setZero();
  return sum;
}

template <class ReceiverType>
std::string describe(const ReceiverType& receiver) {
  std::ostringstream text;
  text.precision(17);
  text << "the receiver at [";
  for (Eigen::Index i = 0; i < receiver.position.size(); ++i) {
    text << (i > 0 ? ", " : "") << receiver.position(i);
  }
  text << ']';
  return text.str();
}

template <class Source, class ReceiverType>
[[noreturn]] void rejectOverlap(const char* kind, std::span<const Source> sources, std::size_t a, std::size_t b,
                                const ReceiverType& receiver) {
  std::ostringstream text;
  text << kind << '[' << a << "] \"" << sources[a].name << "\" and " << kind << '[' << b << "] \"" << sources[b].name
       << "\" overlap as seen from " << describe(receiver)
       << ": one hides part of the other, and occlusion is not evaluated";
  throw InvalidScene(text.str());
}

/// The irradiance that the sources in view would give with radiance 1, less what it may be off. Sources that hide
/// nothing of each other give no more than the whole hemisphere does. Closer to two sources than the rounding of their
/// coordinates, where directions tell nothing, this still does.
class Coverage {
 public:
  /// `hemisphere` is pi, in flatland 2.
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

}  // namespace

SceneEvaluation<2> evaluateUnoccluded(std::span<const Segment> segments, const FlatlandReceiver& receiver) {
  SceneEvaluation<2> sum = emptyScene<2>();
  Coverage coverage(2.0);
  std::vector<std::size_t> visible;
  std::vector<SegmentView> views;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const SegmentEvaluation evaluation = evaluateSegment(segments[i], i, receiver);
    const std::optional<SegmentView> view = viewOf(segments[i], receiver);
    coverage.add(i, evaluation.derivatives.irradiance.value, evaluation.bounds.irradiance);
    if (segments[i].radiance > 0.0) {
      add(sum, evaluation, segments[i].radiance);
      requireFinite(sum, receiver, [&] { return "segments[" + std::to_string(i) + "] \"" + segments[i].name + '"'; });
    } else if (!evaluation.no_gradient.empty()) {
      keepReasons(sum, evaluation);
    }
    if (view && evaluation.derivatives.irradiance.value > 0.0) {
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
  if (coverage.exceedsHemisphere() && sum.derivatives.irradiance.value > 0.0) {
    const auto [a, b] = coverage.largest();
    rejectOverlap("segments", segments, a, b, receiver);
  }
  return sum;
}

}  // namespace irradiff
