#include "experiments/ray_casting/ray_caster.h"

#include "derivatives/scene/triangulation.h"
#include "experiments/ray_casting/ray_batch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace irradiff {

namespace {

constexpr std::size_t kUnseen = std::numeric_limits<std::size_t>::max();

Eigen::Vector3d scaled(const Eigen::Vector3d& v, int exponent) {
  return v.unaryExpr([exponent](double c) { return std::ldexp(c, exponent); });
}

}  // namespace

RayCaster::RayCaster(std::span<const Polygon> polygons, RaySearch search) {
  double largest = 0.0;
  for (const Polygon& polygon : polygons) {
    for (const Eigen::Vector3d& vertex : polygon.vertices)
      largest = std::max(largest, vertex.lpNorm<Eigen::Infinity>());
  }
  std::frexp(largest, &exponent_);
  for (const Polygon& polygon : polygons) {
    for (const std::array<std::size_t, 3>& corners : triangulate(polygon)) {
      SceneFace& face = faces_.emplace_back();
      face.radiance = polygon.radiance;
      for (std::size_t i = 0; i < 3; ++i) face.vertices[i] = scaled(polygon.vertices[corners[i]], -exponent_);
    }
  }
  if (search == RaySearch::kTree || (search == RaySearch::kAuto && polygons.size() > kMostPolygonsWithoutTree)) {
    tree_.emplace(faces_);
  }
}

ReceiverRays RayCaster::from(const SampleFrame& frame) const { return {*this, frame}; }

ReceiverRays::ReceiverRays(const RayCaster& caster, const SampleFrame& frame)
    : caster_(&caster),
      position_(scaled(frame.position, -caster.exponent_)),
      axes_(frame.axes()),
      inverse_unit_(std::ldexp(1.0, -caster.exponent_)),
      // Seen from far away single precision would not do.
      uses_tree_(caster.tree_ && position_.lpNorm<Eigen::Infinity>() <= kLargestTreeCoordinate) {
  SampleFrame local = frame;
  local.position = position_;
  if (uses_tree_) place_.assign(caster.faces_.size(), kUnseen);
  for (std::size_t i = 0; i < caster.faces_.size(); ++i) {
    const std::optional<ViewedFace> face = viewedFace(caster.faces_[i], local);
    if (!face) continue;
    if (uses_tree_) place_[i] = viewed_.size();
    viewed_.push_back(*face);
  }
}

void ReceiverRays::cast(HemisphereSamples& samples) const {
  const std::size_t count = samples.direction_t.size();
  samples.inverse_distance.resize(count);
  samples.radiance.resize(count);
  if (uses_tree_) {
    for (std::size_t i = 0; i < count; ++i) {
      const RayHit hit = castThroughTree(samples.direction(i));
      samples.inverse_distance[i] = hit.inverse_distance;
      samples.radiance[i] = hit.radiance;
    }
    return;
  }
  castRays(viewed_, {samples.direction_t.data(), samples.direction_b.data(), samples.direction_n.data(),
                     samples.inverse_distance.data(), samples.radiance.data(), count});
  for (double& inverse : samples.inverse_distance) inverse *= inverse_unit_;
}

RayHit ReceiverRays::cast(const Eigen::Vector3d& direction) const {
  if (uses_tree_) return castThroughTree(direction);
  RayHit hit;
  castRays(viewed_, {&direction[0], &direction[1], &direction[2], &hit.inverse_distance, &hit.radiance, 1});
  hit.inverse_distance *= inverse_unit_;
  return hit;
}

RayHit ReceiverRays::castThroughTree(const Eigen::Vector3d& direction) const {
  RayHit nearest;
  std::size_t nearest_face = kUnseen;
  caster_->tree_->visit(position_, axes_ * direction, nearest.inverse_distance, [&](std::size_t index) {
    if (place_[index] == kUnseen) return false;
    const ViewedFace& face = viewed_[place_[index]];
    const double inverse = inverseDistance(face, direction);
    const bool is_nearer = inverse > nearest.inverse_distance ||
                           (inverse == nearest.inverse_distance && inverse > 0.0 && index < nearest_face);
    if (is_nearer) {
      nearest = {inverse, face.radiance};
      nearest_face = index;
    }
    return is_nearer;
  });
  nearest.inverse_distance *= inverse_unit_;
  return nearest;
}

RayQuery ReceiverRays::query() const {
  return [this](const Eigen::Vector3d& direction) { return cast(direction); };
}

}  // namespace irradiff
