#include "derivatives/flatland/segment_visibility.h"

#include "derivatives/flatland/half_circle.h"
#include "derivatives/flatland/lower_envelope.h"
#include "derivatives/flatland/sight_ray.h"

#include <algorithm>
#include <optional>

namespace irradiff {
namespace {

std::string eventText(const HalfCircle& half_circle, const SightRay& ray) {
  for (const RayStop& stop : ray.stops) {
    if (half_circle.source(stop.source).is_end_on) {
      return half_circle.nameOf(stop.source) + " is seen end-on: the receiver lies on its line";
    }
  }
  const RayStop& near = ray.stops.front();
  const auto far = std::find_if(ray.stops.begin(), ray.stops.end(), [](const RayStop& stop) { return stop.rank > 0; });
  return half_circle.nameOf(near.source) + " has an end in line with " + (far->end ? "an end" : "a crossing") + " of " +
         half_circle.nameOf(far->source) + ": what is seen between them depends on where the receiver moves";
}

void report(const HalfCircle& half_circle, const FlatlandDirection& d, const SightRay& ray,
            SegmentVisibility& visibility) {
  if (isOnHorizon(d)) {
    // A move against the normal lifts the points over the horizon, the nearest most; a move along it hides them all.
    const bool is_start = d.kind == FlatlandDirection::Kind::kStart;
    const bool is_constant = is_start ? ray.is_constant_nearest_last : ray.is_constant_nearest_first;
    if (!is_constant && visibility.no_hessian.empty()) {
      visibility.no_hessian =
          half_circle.nameOf(ray.stops[0].source) +
          " has an end on the receiver's horizon: the second derivative along the normal is one-sided";
    }
  } else if (!ray.is_smooth && visibility.no_gradient.empty()) {
    visibility.no_gradient = eventText(half_circle, ray);
  }
}

BoundaryPoint ownPoint(const FlatlandSource& source, bool is_last) {
  const int height = is_last ? source.last_height : source.first_height;
  if (height < 0) return {BoundaryPoint::Kind::kHorizon, source.index};
  return {BoundaryPoint::Kind::kEnd, source.index, is_last ? 1 - source.first_end : source.first_end};
}

/// The point at which what is seen of a source begins or ends in direction d: its own end if the radiance jumps
/// there, or if no point is the one.
BoundaryPoint boundaryPoint(const HalfCircle& half_circle, const FlatlandSource& source, bool is_last,
                            const FlatlandDirection& d, const SightRay& ray) {
  if (d.kind == FlatlandDirection::Kind::kStart) return ownPoint(source, is_last);
  std::optional<BoundaryPoint> end;
  std::optional<std::size_t> through;
  BoundaryPoint crossing{BoundaryPoint::Kind::kCrossing};
  for (const RayStop& stop : ray.stops) {
    const FlatlandSource& met = half_circle.source(stop.source);
    const bool is_own = met.index == source.index && stop.end && (*stop.end == 1) == is_last;
    if (is_own && (!ray.is_smooth || stop.rank == ray.point_rank)) return ownPoint(source, is_last);
    if (stop.rank != ray.point_rank) continue;
    if (stop.end) {
      if (!end) end = ownPoint(met, *stop.end == 1);
    } else if (!through) {
      through = stop.source;
      crossing.segment = met.index;
    } else if (half_circle.turn(*through, stop.source) != 0) {
      crossing.other = met.index;
    }
  }
  return end ? *end : crossing;
}

}  // namespace

SegmentVisibility visibleParts(std::span<const Segment> segments, std::span<const std::size_t> considered,
                               const FlatlandReceiver& receiver) {
  const HalfCircle half_circle(segments, considered, receiver);
  const std::vector<FrontPiece> pieces = lowerEnvelope(half_circle);
  SegmentVisibility visibility;
  std::vector<SightRay> rays;
  for (const FrontPiece& piece : pieces) {
    rays.push_back(rayAlong(half_circle, piece.start));
    report(half_circle, piece.start, rays.back(), visibility);
  }
  report(half_circle, kHorizonStop, rayAlong(half_circle, kHorizonStop), visibility);
  for (const FlatlandSource& source : half_circle.sources()) {
    if (source.is_end_on && source.rises) {
      report(half_circle, source.start, rayAlong(half_circle, source.start), visibility);
    }
  }
  std::ptrdiff_t whole = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (pieces[k].source == kNobody) continue;
    const bool is_final = k + 1 == pieces.size();
    const FlatlandSource& source = half_circle.source(pieces[k].source);
    VisiblePart part;
    part.segment = source.index;
    part.first = boundaryPoint(half_circle, source, false, pieces[k].start, rays[k]);
    part.last =
        is_final ? ownPoint(source, true) : boundaryPoint(half_circle, source, true, pieces[k + 1].start, rays[k + 1]);
    part.is_whole = part.first.segment == source.index && part.first.kind != BoundaryPoint::Kind::kCrossing &&
                    part.last.segment == source.index && part.last.kind != BoundaryPoint::Kind::kCrossing;
    whole += part.is_whole ? 1 : 0;
    visibility.parts.push_back(part);
  }
  visibility.hides_something = whole < std::ranges::count_if(half_circle.sources(), &FlatlandSource::isBroad);
  return visibility;
}

}  // namespace irradiff
