#include "tests/io/example_samples.h"

#include "derivatives/samples/sample_hemisphere.h"
#include "experiments/io/samples_file.h"
#include "experiments/io/scene_file.h"

#include <Eigen/Geometry>

#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace irradiff {

namespace {

/// The inverse distance along a unit direction to a convex polygon, 0 if it is not hit.
double inverseDistance(const Polygon& polygon, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  bool is_left = true;
  bool is_right = true;
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    const Eigen::Vector3d p = polygon.vertices[i] - origin;
    const Eigen::Vector3d q = polygon.vertices[(i + 1) % polygon.vertices.size()] - origin;
    const double side = p.cross(q).dot(direction);
    is_left = is_left && side >= 0.0;
    is_right = is_right && side <= 0.0;
  }
  if (!is_left && !is_right) return 0.0;
  const Eigen::Vector3d& p = polygon.vertices[0];
  const Eigen::Vector3d normal = (polygon.vertices[1] - p).cross(polygon.vertices[2] - p);
  return normal.dot(direction) / normal.dot(p - origin);
}

Scene figure5() {
  std::ifstream file("data/scenes/figure5.json");
  if (!file) throw std::runtime_error("data/scenes/figure5.json: cannot be read, run this in the project's root");
  return parseScene(std::string(std::istreambuf_iterator<char>(file), {}));
}

}  // namespace

std::string exampleSamplesText() {
  const Scene scene = figure5();
  const SampleFrame frame{{0.9, -0.8, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const RayQuery cast_ray = [&](const Eigen::Vector3d& direction) {
    RayHit nearest;
    for (const Polygon& polygon : scene.polygons) {
      const double inverse_distance = inverseDistance(polygon, frame.position, frame.axes() * direction);
      if (inverse_distance > nearest.inverse_distance) nearest = {inverse_distance, polygon.radiance};
    }
    return nearest;
  };
  const Strata strata(Stratification::kConcentric, {16, 16});
  std::ostringstream text;
  writeSamples(
      text, sampleHemisphere(strata, SamplePattern::kJittered, 5, 0, frame, cast_ray),
      "What a receiver beside the shadows of data/scenes/figure5.json sees: jittered samples of seed 5. Made by "
      "build/release/make_example_samples.");
  return text.str();
}

}  // namespace irradiff
