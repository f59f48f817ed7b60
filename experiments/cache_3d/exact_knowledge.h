#pragma once

#include "derivatives/estimators/estimator.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "experiments/cache_3d/metric_records.h"
#include "experiments/ray_casting/ray_caster.h"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace irradiff {

/// What the scene says of a receiver.
struct PointTruth {
  double irradiance = 0.0;
  double irradiance_bound = 0.0;  ///< of the error of `irradiance`
  Eigen::Vector3d gradient;       ///< W/m^3
};

/// What a record would know at receivers of a scene if its derivatives were exact. Only the harmonic mean distance and
/// the geometric Hessian, which are integrals over what is seen and not over its boundary, are taken from
/// kExactKnowledgeRays rays through the middles of strata. docs/derivations/reprojection.md, section 8.
///
/// Where a derivative does not exist, since edges are in line as seen from the receiver, it is that of a place `beside`
/// it (metres, in the tangent plane). May be used from several threads at once. Throws InvalidScene as SceneEvaluator
/// does, and naming the receiver where there is no derivative beside it either.
class ExactKnowledge {
 public:
  /// Requires validated polygons, which are planar to rounding.
  explicit ExactKnowledge(std::span<const Polygon> polygons);

  PointTruth truth(const Receiver& receiver, double beside) const;
  RecordKnowledge record(const Receiver& receiver, double beside) const;

  /// Of each polygon: whether the receiver sees some of it.
  std::vector<bool> seenPolygons(const Receiver& receiver) const;

  std::span<const Polygon> polygons() const { return evaluator_.polygons(); }

 private:
  SceneEvaluation<3> derivativesAt(const SceneEvaluator& evaluator, const Receiver& receiver, double beside) const;

  SceneEvaluator evaluator_;
  SceneEvaluator bright_;  ///< of the same polygons with radiance 1
  std::vector<double> radiances_;
  RayCaster caster_;
  std::unique_ptr<Estimator> geometric_;
};

inline constexpr std::size_t kExactKnowledgeRays = 1024;

}  // namespace irradiff
