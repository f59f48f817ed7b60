#include "verification/certified/certified_flatland.h"

#include "derivatives/flatland/flatland_scene.h"
#include "verification/certified/ball_rounding.h"
#include "verification/certified/ladder.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace irradiff {

namespace {

template <class Scalar>
Vector2<Scalar> lifted(const Vector2<double>& v) {
  return {lift<Scalar>(v(0)), lift<Scalar>(v(1))};
}

/// The part in units in which its farther point is about 1 away.
ScaledPart inItsOwnUnit(const VisiblePart& part, std::span<const Segment> segments, const FlatlandReceiver& receiver) {
  ScaledPart scaled = scaledPart(part, segments, receiver);
  const ClippedSegment<double> clipped = clipPart<double>(part, scaled.ends, scaled.position, receiver.normal);
  const double farthest =
      std::max(narrow<double>(clipped.first).cwiseAbs().maxCoeff(), narrow<double>(clipped.last).cwiseAbs().maxCoeff());
  const int fine = std::ilogb(farthest) + 1;
  const auto shrink = [fine](Vector2<double>& p) {
    for (int i = 0; i < 2; ++i) p(i) = std::ldexp(p(i), -fine);
  };
  shrink(scaled.position);
  for (SegmentEnds<double>& ends : scaled.ends) {
    for (Vector2<double>& end : ends) shrink(end);
  }
  scaled.exponent += fine;
  return scaled;
}

template <class Scalar>
CertifiedSums<Scalar, 2> partSums(const VisiblePart& part, const ScaledPart& scaled, const Vector2<double>& normal) {
  std::vector<SegmentEnds<Scalar>> ends;
  for (const SegmentEnds<double>& end : scaled.ends) ends.push_back({lifted<Scalar>(end[0]), lifted<Scalar>(end[1])});
  const Vector2<Scalar> lifted_normal = lifted<Scalar>(normal);
  const SegmentSums<Scalar> sums =
      segmentBoundaryForm(clipPart<Scalar>(part, std::span<const SegmentEnds<Scalar>>(ends),
                                           lifted<Scalar>(scaled.position), lifted_normal),
                          lifted_normal);
  return {sums.derivatives,
          {sizeOf(sums.irradiance_size), sizeOf(sums.gradient_size), sizeOf(sums.hessian_size),
           sizeOf(sums.tangential_size), sizeOf(sums.rotational_size)},
          scaled.exponent};
}

CertifiedValue<2> partValue(const VisiblePart& part, const ScaledPart& scaled, const Vector2<double>& normal,
                            const LadderStep& step) {
  switch (step.rung) {
    case Rung::kDouble:
      return inMetres(partSums<RunningBound<long double>>(part, scaled, normal));
    case Rung::kExtended:
      return inMetres(partSums<RunningBound<DoubleWord<double>>>(part, scaled, normal));
    case Rung::kBall:
      break;
  }
  const WorkingPrecision precision(step.bits);
  return inMetres(partSums<Ball>(part, scaled, normal));
}

}  // namespace

CertifiedScene<2> certifyScene(std::span<const Segment> segments, const FlatlandReceiver& receiver, double tolerance) {
  requireTolerance(tolerance);
  const FlatlandComposition scene = composeScene(segments, receiver);
  std::vector<LadderSource<2>> sources;
  for (const VisiblePart& part : scene.parts) {
    sources.push_back({segments[part.segment].radiance,
                       [&, scaled = inItsOwnUnit(part, segments, receiver)](const LadderStep& step) {
                         return partValue(part, scaled, receiver.normal, step);
                       },
                       {},
                       {}});
  }
  return climbTogether(scene.dark, sources, receiver, tolerance);
}

}  // namespace irradiff
