#include "derivatives/flatland/flatland_scene.h"

#include "derivatives/flatland/segment_visibility.h"
#include "derivatives/scene/coordinate_range.h"
#include "derivatives/scene/invalid_scene.h"
#include "derivatives/scene/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using WideVector2 = Vector2<DoubleWord<double>>;

/// With errors of both points of up to 18 u^2 of their distances, the 16 u^2 that evaluateSegment() counts for the
/// height of fixed ends over the line between them become 16 + 2 * 18 < 4 * 16 (docs/derivations/error_bounds.md,
/// section 4).
constexpr double kPointErrors = 4.0;

void scale(WideVector2& r, int exponent) {
  for (int i = 0; i < 2; ++i) {
    r(i) = {std::ldexp(r(i).hi, -exponent), std::ldexp(r(i).lo, -exponent)};
  }
}

/// The segments that a part depends on.
std::vector<std::size_t> segmentsOf(const VisiblePart& part) {
  std::vector<std::size_t> indices{part.segment};
  for (const BoundaryPoint& point : {part.first, part.last}) {
    indices.push_back(point.segment);
    if (point.kind == BoundaryPoint::Kind::kCrossing) indices.push_back(point.other);
  }
  return indices;
}

[[noreturn]] void reject(const Segment& segment, std::size_t index, const FlatlandReceiver& receiver,
                         const std::string& rule) {
  throw InvalidScene("segments[" + std::to_string(index) + "] \"" + segment.name +
                     "\", seen in part: " + describeReceiver(receiver) + ' ' + rule);
}

/// What a part of a segment of radiance 1 adds.
SegmentEvaluation evaluatePart(const VisiblePart& part, std::span<const Segment> segments,
                               const FlatlandReceiver& receiver) {
  const ScaledPart scaled = scaledPart(part, segments, receiver);
  // Scaled once more, so that the farther point is about 1 away.
  ClippedSegment<double> clipped = clipPart<double>(part, scaled.ends, scaled.position, receiver.normal);
  const double farthest =
      std::max(narrow<double>(clipped.first).cwiseAbs().maxCoeff(), narrow<double>(clipped.last).cwiseAbs().maxCoeff());
  const int fine = std::ilogb(farthest) + 1;
  scale(clipped.first, fine);
  scale(clipped.last, fine);
  clipped.first_height = std::ldexp(clipped.first_height, -fine);
  clipped.last_height = std::ldexp(clipped.last_height, -fine);
  const WideVector2 wide_edge = difference(clipped.last, clipped.first);
  const double area = std::abs(static_cast<double>(cross(clipped.first, wide_edge)));
  const double first_distance = norm(narrow<double>(clipped.first));
  const double reach = std::max(norm(narrow<double>(wide_edge)), norm(narrow<double>(clipped.last)));
  SegmentEvaluation evaluation =
      evaluateClipped(clipped, receiver.normal, area / (kPointErrors * reach * first_distance), scaled.exponent + fine);
  const IrradianceDerivatives<double, 2>& d = evaluation.derivatives;
  if (!std::isfinite(d.irradiance.value) || !d.gradient.value.allFinite() || !d.hessian.value.allFinite() ||
      !d.rotational_gradient.value.allFinite() || !std::isfinite(evaluation.bounds.hessian)) {
    reject(segments[part.segment], part.segment, receiver,
           "is so close, or what is seen so narrow, that a derivative exceeds the range of double");
  }
  return evaluation;
}

/// What became of the segments, given what each is by itself and the parts seen of them, whole ones all as if they were
/// integrated by their ends.
SourceCounts countSources(std::span<const Segment> segments, std::span<const SegmentEvaluation> whole,
                          std::span<const VisiblePart> parts) {
  std::vector<bool> is_seen(segments.size(), false);
  std::vector<bool> is_whole(segments.size(), false);
  for (const VisiblePart& part : parts) {
    is_seen[part.segment] = true;
    is_whole[part.segment] = part.is_whole;
  }
  SourceCounts counts;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    switch (whole[i].rule) {
      case SegmentRule::kBelowHorizon:
        ++counts.below_horizon;
        continue;
      case SegmentRule::kOwnSurface:
        ++counts.own_surface;
        continue;
      case SegmentRule::kEndOn:
        ++counts.edge_on;
        continue;
      case SegmentRule::kBoundary:
      case SegmentRule::kLength:
        break;
    }
    if (!is_seen[i]) {
      ++counts.hidden;
    } else if (segments[i].radiance == 0.0) {
      ++counts.black;
    } else if (!is_whole[i]) {
      ++counts.partly_hidden;
    } else {
      ++counts.boundary;
    }
  }
  return counts;
}

}  // namespace

ScaledPart scaledPart(const VisiblePart& part, std::span<const Segment> segments, const FlatlandReceiver& receiver) {
  const std::vector<std::size_t> indices = segmentsOf(part);
  CoordinateRange coordinates;
  coordinates.include(receiver.position);
  for (const std::size_t index : indices) {
    coordinates.include(segments[index].vertices[0]);
    coordinates.include(segments[index].vertices[1]);
  }
  if (const std::string violation = rangeViolation(coordinates, "an end in front of it", receiver.normal);
      !violation.empty()) {
    reject(segments[part.segment], part.segment, receiver, violation);
  }
  ScaledPart scaled{{}, {}, std::ilogb(coordinates.largest()) + 2};
  const auto shrink = [&scaled](const Eigen::Vector2d& p) {
    return Vector2<double>(std::ldexp(p(0), -scaled.exponent), std::ldexp(p(1), -scaled.exponent));
  };
  scaled.ends.resize(1 + *std::max_element(indices.begin(), indices.end()));
  for (const std::size_t index : indices) {
    scaled.ends[index] = {shrink(segments[index].vertices[0]), shrink(segments[index].vertices[1])};
  }
  scaled.position = shrink(receiver.position);
  return scaled;
}

FlatlandComposition composeScene(std::span<const Segment> segments, const FlatlandReceiver& receiver) {
  FlatlandComposition scene{darkScene<2>(), {}, {}};
  std::vector<std::size_t> considered;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    scene.segments.push_back(evaluateSegment(segments[i], i, receiver));
    if (scene.segments.back().rule != SegmentRule::kOwnSurface) considered.push_back(i);
  }
  SegmentVisibility visibility = visibleParts(segments, considered, receiver);
  // In the order of the scene, so that what is seen whole adds up as if it were alone.
  std::stable_sort(visibility.parts.begin(), visibility.parts.end(),
                   [](const VisiblePart& a, const VisiblePart& b) { return a.segment < b.segment; });
  for (const VisiblePart& part : visibility.parts) {
    if (segments[part.segment].radiance == 0.0) continue;
    const auto isCut = [](const BoundaryPoint& point) { return point.kind == BoundaryPoint::Kind::kHorizon; };
    scene.dark.crosses_horizon = scene.dark.crosses_horizon || isCut(part.first) || isCut(part.last);
    scene.parts.push_back(part);
  }
  scene.dark.sources = countSources(segments, scene.segments, visibility.parts);
  scene.dark.has_occlusion = visibility.hides_something;
  scene.dark.no_gradient = visibility.no_gradient;
  scene.dark.no_tangential_hessian = visibility.no_gradient;
  scene.dark.no_hessian = visibility.no_gradient.empty() ? visibility.no_hessian : visibility.no_gradient;
  return scene;
}

SceneEvaluation<2> evaluateScene(std::span<const Segment> segments, const FlatlandReceiver& receiver) {
  const FlatlandComposition scene = composeScene(segments, receiver);
  SceneEvaluation<2> sum = scene.dark;
  for (const VisiblePart& part : scene.parts) {
    const double radiance = segments[part.segment].radiance;
    const SegmentEvaluation evaluation =
        part.is_whole ? scene.segments[part.segment] : evaluatePart(part, segments, receiver);
    if (part.is_whole && evaluation.rule == SegmentRule::kLength) {
      --sum.sources->boundary;
      ++sum.sources->area_rule;
    }
    addSource(sum, evaluation.derivatives, evaluation.bounds, radiance);
    requireFinite(sum, receiver, [&] {
      return "segments[" + std::to_string(part.segment) + "] \"" + segments[part.segment].name + "\": its radiance " +
             numberText(radiance);
    });
  }
  return sum;
}

}  // namespace irradiff
