#include "experiments/atlas/event_map.h"

#include "derivatives/scene/invalid_scene.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "verification/certified/certified_scene.h"
#include "verification/checks/random.h"
#include "verification/exact_boundary/exact_evaluation.h"
#include "verification/report/parallel_tasks.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace irradiff {
namespace {

using Eigen::Vector3d;
using WideVector = Eigen::Matrix<long double, 3, 1>;

constexpr const char* kFile = "event_angle";
constexpr double kNotHeld = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vector3d tangentTowards(const Vector3d& direction, const Vector3d& target) {
  return (target - target.dot(direction) * direction).normalized();
}

WideVector wide(const Vector3d& v) { return v.cast<long double>(); }

double quotient(double difference, double size) { return difference == 0.0 ? 0.0 : difference / size; }

struct NamedEvaluator {
  const char* name;
  SceneEvaluation<3> (*evaluate)(const SceneEvaluator&, const Receiver&);
};

constexpr std::array kEvaluators = {
    NamedEvaluator{"scene evaluator", [](const SceneEvaluator& e, const Receiver& r) { return e.evaluate(r); }},
    NamedEvaluator{"certified", [](const SceneEvaluator& e, const Receiver& r) {
                     return certifyScene(e, r, kDefaultTolerance).evaluation;
                   }}};

}  // namespace

OccludedScene drawNearEvent(KeyedRandom& random, double along, double sine) {
  for (;;) {
    const Vector3d up = random.direction();
    const auto corner = [&] { return Vector3d(2.0 * up + random.direction() * random.between(0.3, 0.8)); };
    const std::array<Vector3d, 3> far = {corner(), corner(), corner()};
    const Vector3d edge = far[1] - far[0];
    const Vector3d crossing = far[0] + along * edge;
    const Vector3d ray = crossing.normalized();
    const Vector3d forward = tangentTowards(ray, edge);
    const Vector3d across = ray.cross(forward);
    const double turn = random.below(2) == 0 ? sine : -sine;
    const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
    const Vector3d line = cosine * forward + turn * across + random.between(-0.5, 0.5) * ray;
    // Away from the emitter's third corner: enough of it is seen for irradiance not to be what cancellation leaves.
    const Vector3d across_line = ray.cross(line).normalized();
    const Vector3d side = across_line.dot(far[2]) > 0.0 ? Vector3d(-across_line) : across_line;
    const Vector3d near = random.between(0.3, 0.7) * crossing;
    const double length = random.between(0.2, 0.5);
    const double before = random.between(0.3, 0.7);
    OccludedScene scene;
    scene.polygons = {{"emitter", {far[0], far[1], far[2]}, 1.0},
                      {"screen",
                       {near - before * length * line, near + (1.0 - before) * length * line,
                        near + random.between(0.2, 0.5) * side + random.between(-0.1, 0.1) * ray},
                       random.below(2) == 0 ? 0.0 : random.between(0.1, 3.0)}};
    scene.receiver = {Vector3d::Zero(), (up + 0.2 * random.direction()).normalized()};
    const Vector3d plane = edge.cross(far[2] - far[0]);
    const bool is_clear = edge.norm() > 0.3 && plane.norm() > 0.1 * edge.norm() &&
                          std::abs(plane.normalized().dot(ray)) > 0.3 && forward.dot(edge) > 0.3 * edge.norm();
    const auto is_above = [&](const Polygon& polygon) {
      return std::ranges::all_of(polygon.vertices,
                                 [&](const Vector3d& v) { return v.dot(scene.receiver.normal) > 0.1 * v.norm(); });
    };
    if (is_clear && std::ranges::all_of(scene.polygons, is_above)) return scene;
  }
}

std::array<double, 2> measureNearEvent(const OccludedScene& scene) {
  const std::vector<Vector3d>& far = scene.polygons[0].vertices;
  const std::vector<Vector3d>& near = scene.polygons[1].vertices;
  const WideVector r = wide(far[0]);
  const WideVector e = wide(far[1]) - r;
  const WideVector w = wide(near[0]).cross(wide(near[1]) - wide(near[0]));
  const WideVector plane = r.cross(e);
  return {static_cast<double>(-r.dot(w) / e.dot(w)),
          static_cast<double>(plane.cross(w).norm() / (plane.norm() * w.norm()))};
}

AtlasErrors sceneErrors(const SceneEvaluation<3>& actual, const SceneEvaluation<3>& truth) {
  const auto& a = actual.derivatives;
  const auto& b = truth.derivatives;
  AtlasErrors errors = {
      quotient(std::abs(a.irradiance.value - b.irradiance.value), std::abs(b.irradiance.value)),
      quotient((a.gradient.value - b.gradient.value).cwiseAbs().maxCoeff(), b.gradient.value.cwiseAbs().maxCoeff()),
      quotient((a.hessian.value - b.hessian.value).cwiseAbs().maxCoeff(), b.hessian.value.cwiseAbs().maxCoeff())};
  if (!actual.no_gradient.empty()) errors[1] = kInfinity;
  if (!actual.no_hessian.empty()) errors[2] = kInfinity;
  return errors;
}

ErrorProbe probeScene(const OccludedScene& scene, double along, double sine) {
  const std::array<double, 2> place = measureNearEvent(scene);
  ErrorProbe probe{std::vector(kEvaluators.size(), AtlasErrors{kNotHeld, kNotHeld, kNotHeld}), place, place};
  if (!isHeldAt(place, along, sine)) return probe;
  const SceneEvaluation<3> truth = evaluateExactly(scene.polygons, scene.receiver);
  const SceneEvaluator evaluator(scene.polygons);
  for (std::size_t i = 0; i < kEvaluators.size(); ++i) {
    AtlasErrors& errors = probe.errors[i];
    try {
      errors = sceneErrors(kEvaluators[i].evaluate(evaluator, scene.receiver), truth);
    } catch (const InvalidScene&) {
      errors = {kInfinity, kInfinity, kInfinity};
    }
    if (!truth.no_gradient.empty()) errors[1] = kNotHeld;
    if (!truth.no_hessian.empty()) errors[2] = kNotHeld;
  }
  return probe;
}

StabilityMap emptyEventMap(const AtlasPlan& plan) {
  StabilityMap map{kFile,
                   "distance to a visibility event",
                   "Two triangles, one partly behind the other. Where an edge of the nearer one is seen to cross an "
                   "edge of the farther one, counted along that edge from a corner, over its length; and the sine of "
                   "the angle of the crossing. F stands for irradiance.",
                   {"vertex distance/edge", 1e-14, 1e-1},
                   {"sin(angle of crossing)", 1e-8, 1.0},
                   plan.event_cells,
                   plan.event_samples,
                   {}};
  for (const NamedEvaluator& evaluator : kEvaluators) {
    VariantErrors errors{evaluator.name, ScalarType::kDouble, {}};
    for (std::vector<double>& peak : errors.peak) peak.resize(map.cells * map.cells);
    map.variants.push_back(std::move(errors));
  }
  return map;
}

StabilityMap eventStability(const AtlasPlan& plan, unsigned threads, const TileStore* finished,
                            const QualityProgress& progress) {
  const std::size_t first_tile = polygonMaps().size() * plan.cells;
  StabilityMap map = emptyEventMap(plan);
  const auto errorsAt = [](KeyedRandom& random, double x, double y) {
    return probeScene(drawNearEvent(random, x, y), x, y).errors;
  };
  std::vector<std::function<void()>> tasks;
  for (std::size_t row = 0; row < map.cells; ++row) {
    tasks.emplace_back([&, row] { fillRow(map, row, plan.seed, errorsAt, finished, first_tile + row); });
  }
  runTasks(tasks, threads, [&](std::size_t done, std::size_t all) {
    if (progress) progress("errors near visibility events", done, all);
  });
  return map;
}

}  // namespace irradiff
