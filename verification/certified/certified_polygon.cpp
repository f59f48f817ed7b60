#include "verification/certified/certified_polygon.h"

#include "verification/certified/certified_sources.h"
#include "verification/certified/rounded_evaluation.h"

#include <cmath>
#include <vector>

namespace irradiff {

namespace {

WantedQuantities wantedOf(const PreparedPolygon& prepared) {
  WantedQuantities wanted;
  wanted.hessian = prepared.evaluation.no_hessian.empty();
  return wanted;
}

CertifiedPolygon polygonOf(const PreparedPolygon& prepared, const CertifiedValue<3>& value, Rung rung, double tolerance,
                           const Polygon& polygon, std::size_t index, const Receiver& receiver) {
  CertifiedPolygon result{prepared.evaluation, rung, value.enclosure, !meets(value, tolerance, wantedOf(prepared))};
  result.evaluation.is_clockwise = prepared.orientation >= 0.0;
  roundTo(value, result.evaluation.derivatives, result.evaluation.bounds);
  if (!isFinite(result.evaluation.derivatives)) {
    rejectReceiver(polygon, index, receiver,
                   "is so close, or the polygon so small, that a derivative exceeds the range of double");
  }
  return result;
}

/// Nothing to integrate, or a kink: what the classification says is exact.
bool isKnown(const PreparedPolygon& prepared) {
  return prepared.clipped.vertices.empty() || prepared.evaluation.rule == PolygonRule::kEdgeOn;
}

}  // namespace

CertifiedPolygon certifyPolygon(const Polygon& polygon, std::size_t index, const Receiver& receiver, double tolerance) {
  requireTolerance(tolerance);
  const PreparedPolygon prepared = preparePolygon(polygon, index, receiver);
  if (isKnown(prepared)) return {prepared.evaluation, Rung::kDouble, std::nullopt, false};
  std::vector<LadderSource<3>> source(1);
  source.front().evaluate = [&](const LadderStep& step) { return polygonValue(prepared, receiver, step); };
  const CertifiedValue<3> value = climb(source, tolerance, wantedOf(prepared));
  return polygonOf(prepared, value, source.front().step.rung, tolerance, polygon, index, receiver);
}

CertifiedPolygon certifyPolygonAt(Rung rung, const Polygon& polygon, std::size_t index, const Receiver& receiver,
                                  double tolerance) {
  requireTolerance(tolerance);
  const PreparedPolygon prepared = preparePolygon(polygon, index, receiver);
  if (isKnown(prepared)) return {prepared.evaluation, Rung::kDouble, std::nullopt, false};
  LadderStep step{rung, rung == Rung::kBall ? firstBits(tolerance) : 0};
  CertifiedValue<3> value = polygonValue(prepared, receiver, step);
  while (rung == Rung::kBall && step.bits < kMostBits && !meets(value, tolerance, wantedOf(prepared))) {
    step = above(step, tolerance);
    value = polygonValue(prepared, receiver, step);
  }
  return polygonOf(prepared, value, rung, tolerance, polygon, index, receiver);
}

}  // namespace irradiff
