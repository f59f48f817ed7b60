#include "tests/estimators/sampled_scene.h"

#include "derivatives/visibility/scene_evaluation.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace irradiff {

using Eigen::Vector3d;

Polygon parallelogram(const std::string& name, const Vector3d& centre, const Vector3d& u, const Vector3d& v,
                      double radiance) {
  return {name, {centre - u - v, centre + u - v, centre + u + v, centre - u + v}, radiance};
}

std::vector<Polygon> room(double radiance) {
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  const Vector3d z = Vector3d::UnitZ();
  return {parallelogram("east", x + z, y, z, radiance), parallelogram("west", z - x, y, z, radiance),
          parallelogram("north", y + z, x, z, radiance), parallelogram("south", z - y, x, z, radiance),
          parallelogram("ceiling", 2.0 * z, x, y, radiance)};
}

Sight look(std::span<const Polygon> scene, const Vector3d& from, const Vector3d& direction) {
  Sight nearest;
  for (const Polygon& polygon : scene) {
    const std::vector<Vector3d>& corners = polygon.vertices;
    const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double inverse_distance = normal.dot(direction) / normal.dot(corners[0] - from);
    if (!(inverse_distance > nearest.inverse_distance)) continue;
    const Vector3d hit = from + direction / inverse_distance;
    bool is_inside = true;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector3d edge = corners[(i + 1) % corners.size()] - corners[i];
      is_inside = is_inside && edge.cross(hit - corners[i]).dot(normal) >= 0.0;
    }
    if (is_inside) nearest = {inverse_distance, polygon.radiance};
  }
  return nearest;
}

namespace {

/// splitmix64 (Steele, Lea, Flood 2014), to [0, 1).
double uniform(std::uint64_t& state) {
  state += 0x9e3779b97f4a7c15u;
  std::uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

}  // namespace

Eigen::Vector2d SamplePlaces::next() {
  if (state_ == 0) return {0.5, 0.5};
  const double along_row = uniform(state_);
  return {along_row, uniform(state_)};
}

SampleFrame frameAt(const Vector3d& position) {
  return {position, Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
}

HemisphereSamples sampleScene(std::span<const Polygon> scene, const SampleFrame& frame, const Strata& strata,
                              SamplePlaces places) {
  HemisphereSamples samples;
  samples.frame = frame;
  samples.stratification = strata.stratification();
  samples.shape = strata.shape();
  const Eigen::Matrix3d axes = frame.axes();
  for (std::size_t row = 0; row < samples.shape.rows; ++row) {
    for (std::size_t column = 0; column < samples.shape.columns; ++column) {
      const Eigen::Vector2d place = places.next();
      const Vector3d direction = strata.direction({row, column, place.x(), place.y()});
      const Sight sight = look(scene, frame.position, axes * direction);
      samples.direction_t.push_back(direction.x());
      samples.direction_b.push_back(direction.y());
      samples.direction_n.push_back(direction.z());
      samples.inverse_distance.push_back(sight.inverse_distance);
      samples.radiance.push_back(sight.radiance);
    }
  }
  return samples;
}

HemisphereSamples uniformSamples(const Strata& strata, double distance, double radiance) {
  HemisphereSamples samples = sampleScene({}, frameAt(Vector3d::Zero()), strata, SamplePlaces::centred());
  samples.inverse_distance.assign(samples.shape.size(), 1.0 / distance);
  samples.radiance.assign(samples.shape.size(), radiance);
  return samples;
}

Strata strataOfSize(Stratification stratification, std::size_t n) {
  switch (stratification) {
    case Stratification::kPolar:
      return {stratification, {n / 2, 2 * n}};
    case Stratification::kConcentric:
      return {stratification, {n, n}};
    case Stratification::kHemicube:
      break;
  }
  return {stratification, {3 * (n / 2), n / 2}};
}

SceneDerivatives trueDerivatives(std::span<const Polygon> scene, const SampleFrame& frame) {
  const IrradianceDerivatives<double> d =
      SceneEvaluator(scene).evaluate(Receiver{frame.position, frame.normal}).derivatives;
  const Eigen::Matrix3d to_frame = frame.axes().transpose();
  return {d.irradiance.value, to_frame * d.rotational_gradient.value, to_frame * d.gradient.value,
          to_frame * d.hessian.value * to_frame.transpose()};
}

std::vector<Vector3d> receivers(std::size_t count, double extent) {
  std::vector<Vector3d> positions;
  std::uint64_t state = 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = 2.0 * uniform(state) - 1.0;
    const double y = 2.0 * uniform(state) - 1.0;
    positions.emplace_back(extent * x, extent * y, 0.0);
  }
  return positions;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace irradiff
