#pragma once

#include "derivatives/boundary/scene_evaluation_result.h"
#include "derivatives/boundary/visibility_event.h"
#include "derivatives/form_factor/polygon_evaluation.h"
#include "derivatives/scene/coordinate_range.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/visibility/scene_mesh.h"
#include "derivatives/visibility/visible_boundary.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

/// How each polygon is evaluated.
enum class PolygonMethod {
  kBoundary,  ///< evaluatePolygon: the production path
  kAppendix,  ///< evaluateAppendix: the form of the 2012 paper, for comparison; knows no occlusion
};

/// Whether the motion of apparent vertices counts in the Hessian.
enum class ApparentVertices {
  kMove,   ///< the Hessian of the scene
  kFixed,  ///< that of the gap-filled scene of the 2012 paper (section 4.1), which has the same irradiance and gradient
};

/// What a scene is made of as one receiver sees it, before anything is integrated.
struct SceneComposition {
  /// Without values: the flags, why derivatives do not exist, and the counts, in which all of `whole` are integrated
  /// along their boundary.
  SceneEvaluation<3> dark;
  std::vector<std::size_t> whole;     ///< polygons that radiate and are seen whole, above the horizon
  std::vector<double> partly_hidden;  ///< of each polygon: its radiance if it is partly hidden, else 0
  VisibleBoundary view;               ///< empty where at most one polygon may be seen

  std::optional<std::size_t> firstPartlyHidden() const;
};

/// The irradiance of a scene of polygons, which may hide each other and pass through each other, with its derivatives.
///
/// What enters are validated polygons, of which a copy is kept, and receivers; what leaves are numbers with their
/// bounds. `evaluate` may be called from several threads at once, and its result does not depend on them.
class SceneEvaluator {
 public:
  /// Requires validated polygons; O(n^2) in their number.
  explicit SceneEvaluator(std::span<const Polygon> polygons);

  /// What a polygon that is not hidden adds is evaluatePolygon's; one that is partly hidden is bounded by arcs
  /// (boundaryOfView). A polygon that lies between the receiver and nothing that radiates changes no bit of a value or
  /// a bound; but where its outline is seen exactly on a vertex or along an edge of the others, or ends on the horizon,
  /// there may be derivatives no more (docs/derivations/visibility.md, section 4).
  ///
  /// Throws InvalidScene as evaluatePolygon and visibleBoundary do, and in the appendix form where something is hidden.
  SceneEvaluation<3> evaluate(const Receiver& receiver, PolygonMethod method = PolygonMethod::kBoundary) const;

  /// The same from a view that is known, `view(receiver)`; also as the gap-filled scene has it.
  SceneEvaluation<3> evaluate(const Receiver& receiver, const VisibleBoundary& view, ApparentVertices vertices) const;

  /// What `evaluate` integrates. Throws InvalidScene as it does.
  SceneComposition compose(const Receiver& receiver) const;

  /// The same from a composition that is known, `compose(receiver)`, or one that comes to the same: what `whole` holds
  /// may be partly hidden in name, as long as the view is there.
  SceneEvaluation<3> evaluate(const Receiver& receiver, const SceneComposition& scene, ApparentVertices vertices) const;

  /// What is seen from the receiver, and what bounds it: equal at receivers that no visibility event separates.
  /// Throws InvalidScene as `evaluate` does.
  VisibleBoundary view(const Receiver& receiver) const;

  /// The same, found with a ViewGrid of `grid_resolution` cells along each side, at least 1, instead of as many as suit
  /// the scene: it takes another time.
  VisibleBoundary view(const Receiver& receiver, int grid_resolution) const;

  /// The nearest visibility events, at most `count` of each kind, in order of distance (nearest_events.h). Takes as
  /// long as many evaluations. Throws InvalidScene as `evaluate` does.
  VisibilityEvents<3> nearestEvents(const Receiver& receiver, std::size_t count) const;

  std::span<const Polygon> polygons() const { return polygons_; }
  const SceneMesh& mesh() const { return mesh_; }

 private:
  /// How the receiver sees each polygon by itself.
  struct Classification {
    std::vector<PolygonEvaluation> polygons;
    std::vector<bool> is_present;  ///< it may hide another

    /// One polygon alone hides nothing.
    bool isAlone() const;
  };

  Classification classify(const Receiver& receiver) const;
  VisibleBoundary viewOf(const std::vector<bool>& is_present, const Receiver& receiver, int grid_resolution) const;
  SceneComposition composeView(const Classification& classified, VisibleBoundary view) const;
  SceneEvaluation<3> sumOf(const SceneComposition& scene, const Receiver& receiver, PolygonMethod method,
                           ApparentVertices vertices) const;
  std::string describe(std::size_t polygon) const;

  std::vector<Polygon> polygons_;
  SceneMesh mesh_;
  int grid_resolution_;
  CoordinateRange coordinates_;
};

}  // namespace irradiff
