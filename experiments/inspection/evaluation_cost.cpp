#include "experiments/inspection/evaluation_cost.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace irradiff {
namespace {

/// Directions from the receiver that hold points of the scene.
struct Cone {
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  double angle = 0.0;

  explicit Cone(const std::vector<Eigen::Vector3d>& directions) {
    for (const Eigen::Vector3d& direction : directions) axis += direction;
    axis.normalize();
    for (const Eigen::Vector3d& direction : directions) {
      angle = std::max(angle, std::acos(std::clamp(axis.dot(direction), -1.0, 1.0)));
    }
  }

  bool overlaps(const Cone& other) const {
    return std::acos(std::clamp(axis.dot(other.axis), -1.0, 1.0)) < angle + other.angle;
  }
};

/// Pairs of a polygon's edge and another polygon that may be seen in one direction.
double pairsInView(std::span<const Polygon> polygons, const Receiver& receiver) {
  std::vector<Cone> cones;
  std::vector<std::vector<Cone>> edge_cones;
  for (const Polygon& polygon : polygons) {
    std::vector<Eigen::Vector3d> directions;
    for (const Eigen::Vector3d& vertex : polygon.vertices)
      directions.push_back((vertex - receiver.position).normalized());
    cones.emplace_back(directions);
    std::vector<Cone>& edges = edge_cones.emplace_back();
    for (std::size_t i = 0; i < directions.size(); ++i) {
      edges.emplace_back(std::vector{directions[i], directions[(i + 1) % directions.size()]});
    }
  }
  double pairs = 0.0;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    for (std::size_t j = 0; j < polygons.size(); ++j) {
      if (i == j || !cones[i].overlaps(cones[j])) continue;
      pairs += static_cast<double>(
          std::ranges::count_if(edge_cones[i], [&](const Cone& edge) { return edge.overlaps(cones[j]); }));
    }
  }
  return pairs;
}

}  // namespace

EvaluationWork workOf(const SceneEvaluator& evaluator, const SceneComposition& composition,
                      const SceneEvaluation<3>& evaluation, const Receiver& receiver) {
  EvaluationWork work;
  work.polygons = static_cast<double>(evaluator.polygons().size());
  double edges = 0.0;
  for (const std::size_t i : composition.whole) edges += static_cast<double>(evaluator.polygons()[i].vertices.size());
  if (!composition.whole.empty() && evaluation.sources) {
    // The evaluation tells how many there are of both kinds, and not which.
    const auto whole = static_cast<double>(composition.whole.size());
    const auto by_area = static_cast<double>(evaluation.sources->area_rule);
    work.boundary_edges = (whole - by_area) / whole * edges;
    work.area_triangles = by_area * (edges / whole - 2.0);
  }
  if (!composition.view.is_seen.empty()) {
    work.view_edges = static_cast<double>(evaluator.mesh().edges().size());
    work.pairs = pairsInView(evaluator.polygons(), receiver);
    work.apparent_vertices = static_cast<double>(evaluation.apparent_vertices);
  }
  return work;
}

double estimateCost(const EvaluationWork& work) {
  return 0.25 * work.polygons + 0.17 * work.boundary_edges + 0.57 * work.area_triangles + 0.15 * work.view_edges +
         0.06 * work.pairs + 1.8 * work.apparent_vertices;
}

}  // namespace irradiff
