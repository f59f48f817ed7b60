#include "experiments/cache_3d/known_geometry.h"

#include "derivatives/visibility/scene_evaluation.h"

#include <cstddef>

namespace irradiff {
namespace {

/// The mean radiance of the samples on each face; 0 where none is.
std::vector<double> meanRadiances(const RoomSamples& gathered, std::size_t faces) {
  std::vector<double> sums(faces, 0.0);
  std::vector<double> counts(faces, 0.0);
  for (std::size_t i = 0; i < gathered.faces.size(); ++i) {
    if (gathered.faces[i] == kNoFace) continue;
    sums[gathered.faces[i]] += gathered.samples.radiance[i];
    counts[gathered.faces[i]] += 1.0;
  }
  for (std::size_t f = 0; f < faces; ++f) sums[f] = counts[f] > 0.0 ? sums[f] / counts[f] : 0.0;
  return sums;
}

Eigen::Vector3d tangential(const Eigen::Vector3d& vector, const Eigen::Vector3d& normal) {
  return vector - normal * normal.dot(vector);
}

}  // namespace

KnownGeometry::KnownGeometry(std::span<const Polygon> polygons, GridShape shape)
    : polygons_(polygons.begin(), polygons.end()),
      walls_(makeEstimator("ward-heckbert", Stratification::kConcentric, shape)) {}

FirstOrder KnownGeometry::firstOrder(const Receiver& receiver, const RoomSamples& gathered) const {
  return firstOrder(receiver, gathered, meanRadiances(gathered, polygons_.size()));
}

FirstOrder KnownGeometry::firstOrder(const Receiver& receiver, const RoomSamples& gathered,
                                     std::span<const double> radiances) const {
  std::vector<Polygon> constant = polygons_;
  for (std::size_t f = 0; f < constant.size(); ++f) constant[f].radiance = radiances[f];
  const SceneEvaluation<3> exact = SceneEvaluator(constant).evaluate(receiver);

  HemisphereSamples rest = gathered.samples;
  for (std::size_t i = 0; i < rest.radiance.size(); ++i) {
    if (gathered.faces[i] != kNoFace) rest.radiance[i] -= radiances[gathered.faces[i]];
  }
  const IrradianceEstimate estimate = walls_->estimate(rest);
  const Eigen::Matrix3d axes = rest.frame.axes();
  const Eigen::Vector3d& normal = receiver.normal;
  FirstOrder result;
  result.irradiance = exact.derivatives.irradiance.value + estimate.irradiance;
  result.gradient = tangential(axes * *estimate.gradient, normal);
  // At an edge or a visibility event the exact gradient may not exist: there the samples' own has to do.
  result.gradient = exact.no_gradient.empty()
                        ? Eigen::Vector3d(tangential(exact.derivatives.gradient.value, normal) + result.gradient)
                        : tangential(axes * *walls_->estimate(gathered.samples).gradient, normal);
  result.rotational_gradient =
      exact.derivatives.rotational_gradient.value + Eigen::Vector3d(axes * *estimate.rotational_gradient);
  return result;
}

}  // namespace irradiff
