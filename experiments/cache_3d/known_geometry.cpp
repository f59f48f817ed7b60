#include "experiments/cache_3d/known_geometry.h"

#include "derivatives/scene/invalid_scene.h"
#include "derivatives/scene/polygon_plane.h"
#include "derivatives/visibility/scene_evaluation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace irradiff {
namespace {

/// Over a polygon's extent: the distance of another's vertices from its plane up to which both may overlap in one.
constexpr double kSamePlane = 1e-9;

/// The mean radiance of the samples on each group of faces, for each face: of 0 where none is on the group. `groups`
/// holds the number of each face's group.
std::vector<double> meanRadiances(const RoomSamples& gathered, std::span<const std::size_t> groups) {
  std::vector<double> sums(groups.size(), 0.0);
  std::vector<double> counts(groups.size(), 0.0);
  for (std::size_t i = 0; i < gathered.faces.size(); ++i) {
    if (gathered.faces[i] == kNoFace) continue;
    sums[groups[gathered.faces[i]]] += gathered.samples.radiance[i];
    counts[groups[gathered.faces[i]]] += 1.0;
  }
  std::vector<double> means(groups.size());
  std::ranges::transform(groups, means.begin(),
                         [&](std::size_t g) { return counts[g] > 0.0 ? sums[g] / counts[g] : 0.0; });
  return means;
}

bool areInOnePlane(const Polygon& polygon, const Polygon& other) {
  const LocalShape shape = localShape(polygon.vertices);
  const Eigen::Vector3d normal = widestNormal(shape.vertices).normalized();
  const double tolerance = kSamePlane * std::ldexp(shape.extent, shape.exponent);
  return std::ranges::all_of(other.vertices, [&](const Eigen::Vector3d& vertex) {
    return std::abs(normal.dot(vertex - polygon.vertices.front())) <= tolerance;
  });
}

/// Of each polygon the first one in its plane.
std::vector<std::size_t> planesOf(std::span<const Polygon> polygons) {
  std::vector<std::size_t> planes;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    std::size_t first = 0;
    while (first < i && !areInOnePlane(polygons[first], polygons[i])) ++first;
    planes.push_back(first);
  }
  return planes;
}

Eigen::Vector3d tangential(const Eigen::Vector3d& vector, const Eigen::Vector3d& normal) {
  return vector - normal * normal.dot(vector);
}

}  // namespace

KnownGeometry::KnownGeometry(std::span<const Polygon> polygons, GridShape shape)
    : polygons_(polygons.begin(), polygons.end()),
      faces_(polygons.size()),
      planes_(planesOf(polygons)),
      walls_(makeEstimator("ward-heckbert", Stratification::kConcentric, shape)) {
  std::iota(faces_.begin(), faces_.end(), std::size_t{0});
}

FirstOrder KnownGeometry::firstOrder(const Receiver& receiver, const RoomSamples& gathered) const {
  try {
    return firstOrder(receiver, gathered, meanRadiances(gathered, faces_));
  } catch (const InvalidScene&) {
    // Faces that overlap in one plane, such as a floor and the bottom of what stands on it, must have one radiance. Any
    // radiance will do for a control variate: here that of all faces in the plane.
    return firstOrder(receiver, gathered, meanRadiances(gathered, planes_));
  }
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
