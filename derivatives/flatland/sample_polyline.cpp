#include "derivatives/flatland/sample_polyline.h"

#include "derivatives/flatland/radiance_points.h"
#include "derivatives/flatland/radiance_windows.h"

#include <cstddef>
#include <vector>

namespace irradiff {

namespace {

const FlatlandHit& fartherOf(const FlatlandHit& a, const FlatlandHit& b) {
  return b.inverse_distance < a.inverse_distance ? b : a;
}

/// `right` and `left` are the radiances beside the polyline, towards the clockwise and the other end of the horizon.
FlatlandEstimate estimateFromPolyline(const FlatlandSamples& samples, double right, double left) {
  FlatlandEstimate estimate = strataSums(samples);
  if (samples.size() < 2) return estimate;
  std::vector<RadiancePoint> vertices;
  vertices.reserve(samples.size());
  double before = right;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double after = i + 1 < samples.size() ? fartherOf(samples.hits[i], samples.hits[i + 1]).radiance : left;
    vertices.push_back({samples.directions[i], samples.hits[i].inverse_distance, after - before});
    before = after;
  }
  setDerivatives(estimate, vertices);
  return estimate;
}

}  // namespace

FlatlandEstimate estimateTriangulated(const FlatlandSamples& samples) {
  return estimateFromPolyline(samples, 0.0, 0.0);
}

FlatlandEstimate estimateTriangulatedClosed(const FlatlandSamples& samples) {
  return estimateFromPolyline(samples, samples.hits.front().radiance, samples.hits.back().radiance);
}

}  // namespace irradiff
