#include "experiments/cache_3d/room_gather.h"

#include "experiments/cache_3d/slice_view.h"
#include "experiments/figures/point_estimator.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace irradiff {

GridShape gatherShape(std::size_t rays) {
  const auto side = static_cast<std::size_t>(std::llround(std::sqrt(static_cast<double>(rays))));
  if (side < 2 || side * side != rays) {
    throw std::invalid_argument("a gather has " + std::to_string(rays) +
                                " rays, must have the square of a whole number that is at least 2, such as 4096");
  }
  return {side, side};
}

RoomGather::RoomGather(std::span<const Polygon> polygons, const SurfaceRadiance& radiance, GridShape shape,
                       std::uint64_t seed)
    : faces_(polygons), radiance_(&radiance), shape_(shape), seed_(seed) {}

RoomSamples RoomGather::gather(const Receiver& receiver, std::uint64_t point) const {
  const SampleFrame frame = sampleFrame(receiver);
  const ReceiverRays rays = faces_.from(frame);
  const SamplingPlan plan{Stratification::kConcentric, shape_, SamplePattern::kJittered, seed_};
  RoomSamples gathered{gatherSamples(rays, frame, plan, point).samples, {}};
  HemisphereSamples& samples = gathered.samples;
  gathered.faces.assign(samples.radiance.size(), kNoFace);
  // A receiver is on one side of each face.
  std::vector<SurfaceView> views;
  for (std::size_t face = 0; face < radiance_->faceCount(); ++face) views.push_back(radiance_->view(face, frame));
  for (std::size_t i = 0; i < samples.radiance.size(); ++i) {
    const std::optional<std::size_t> face = FaceRays::faceOf(samples.radiance[i]);
    samples.radiance[i] = 0.0;
    if (!face) continue;
    gathered.faces[i] = *face;
    const SurfaceView& view = views[*face];
    if (view.grid == nullptr || view.grid->values.empty()) continue;
    const Eigen::Vector3d hit = samples.direction(i) / samples.inverse_distance[i];
    samples.radiance[i] = view.grid->at(view.first_column + view.across.dot(hit), view.first_row + view.along.dot(hit));
  }
  return gathered;
}

}  // namespace irradiff
