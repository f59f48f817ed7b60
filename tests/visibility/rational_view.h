#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "verification/exact_boundary/rational_geometry.h"
#include "verification/exact_visibility/exact_visibility.h"

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace irradiff {

/// What two routes say of one view in a form that both can be brought to. It holds what does not depend on their
/// conventions:
///   - An arc is known by the great circle it lies on, its ends, the straight line of the scene that carries it, and
///   its
///     sides, not by the edge: which of several edges on one line carries an arc is a convention, and so is whether
///     arcs that continue each other on one line are one.
///   - Polygons of one radiance that overlap in one plane stand for each other; no arc between them counts.
///   - Where lines at different depths lie over each other in view, or a polygon is seen edge-on, which of them carries
///     the arc is a convention; on such circles the depth is not compared.
///   - An apparent vertex counts if what is seen beside the farther line changes there. None does on the circle of a
///     polygon seen edge-on, whose edges the exact route leaves out.
/// All numbers are exact.

/// A place on a great circle above the horizon or on it: the tangent of its angle from the circle's highest point,
/// without limit on the horizon (first -1 or 1, the number then 0).
using CirclePlace = std::pair<int, Rational>;

/// Polygons on the sides as seen along the circle, kNone for nothing.
struct ArcSidesInView {
  std::size_t left = kNone;
  std::size_t right = kNone;
  bool operator==(const ArcSidesInView&) const = default;
  bool operator<(const ArcSidesInView& other) const {
    return std::tie(left, right) < std::tie(other.left, other.right);
  }
};

/// A straight line in space: its direction and its moment about the receiver.
using SpaceLine = std::pair<RationalVector, RationalVector>;

struct ArcInView {
  CirclePlace from;
  CirclePlace to;
  ArcSidesInView sides;
  SpaceLine line;
};

struct VertexInView {
  RationalVector direction;
  RationalVector far_circle;
  RationalVector near_circle;
  ArcSidesInView before;  ///< beside the farther line along its circle; nothing where both sides are the same
  ArcSidesInView after;

  auto key() const { return std::tie(direction, far_circle, near_circle, before, after); }
  bool operator<(const VertexInView& other) const { return key() < other.key(); }
  bool operator==(const VertexInView& other) const { return key() == other.key(); }
};

struct HorizonInView {
  RationalVector begin;
  RationalVector end;
  std::size_t polygon;

  auto key() const { return std::tie(begin, end, polygon); }
  bool operator<(const HorizonInView& other) const { return key() < other.key(); }
  bool operator==(const HorizonInView& other) const { return key() == other.key(); }
};

struct RationalView {
  /// By great circle, a normal of which is the key; those of one circle in their order.
  std::map<RationalVector, std::vector<ArcInView>> arcs;
  std::set<VertexInView> vertices;
  std::set<HorizonInView> horizon;
  std::set<std::size_t> edge_on;
  std::set<RationalVector> edge_on_circles;
  /// Circles on which the depth is not compared.
  std::set<RationalVector> lines_over_each_other;
  bool has_aligned_arcs = false;  ///< without lines that touch the inside of a polygon, as in `meetings`
  /// Directions in which more than two lines meet at different depths, and whether an arc of two different radiances
  /// is among them and no line that touches the inside of a polygon: behind that it stays hidden, which the exact route
  /// does not look at. Known to the exact route alone.
  std::map<RationalVector, bool> meetings;
  std::vector<std::string> contradictions;  ///< of a route with itself
};

/// Which polygons stand for which: the lowest of each group of polygons of one radiance that may overlap in one plane
/// (their boxes do). Directly or through others.
std::vector<std::size_t> overlapGroups(std::span<const Polygon> polygons);

/// The view of exactVisibility().
RationalView rationalView(const ExactVisibility& seen, std::span<const Polygon> polygons, const Receiver& receiver);

/// That of SceneEvaluator::view(). Places are computed from the coordinates of what they are named after, by the
/// definition of EdgePlace: not by any predicate of the route.
RationalView rationalView(const VisibleBoundary& seen, const SceneMesh& mesh, std::span<const Polygon> polygons,
                          const Receiver& receiver);

/// What differs between the exact route's view and the other's; empty if nothing does.
std::vector<std::string> differences(const RationalView& exact, const RationalView& other);

/// Whether a vertex or a crossing of two edges lies on an arc of the view, or an edge on an end of an arc, as seen from
/// the receiver and not in space. There the fast route may call the second derivative missing although the faces on
/// both sides of the arc hide what is behind it for good: it takes for hidden only what one face hides all around.
bool hasCornerBehindAnArc(const RationalView& view, std::span<const Polygon> polygons, const Receiver& receiver);

namespace detail {

/// Puts arcs, vertices and intervals into their comparable form.
class ViewBuilder {
 public:
  ViewBuilder(std::span<const Polygon> polygons, const Receiver& receiver)
      : groups_(overlapGroups(polygons)), normal_(rational(receiver.normal)) {}

  const RationalVector& normal() const { return normal_; }
  std::size_t group(std::size_t polygon) const { return polygon == kNone ? kNone : groups_[polygon]; }
  ArcSidesInView sides(std::size_t left, std::size_t right) const { return {group(left), group(right)}; }

  /// A point of the circle with that normal.
  CirclePlace place(const RationalVector& circle, const RationalVector& direction) const;

  /// From one end to the other, relative to the receiver, and what is on the sides seen that way.
  void addArc(const RationalVector& begin, const RationalVector& end, ArcSidesInView sides);
  void addHorizon(const RationalVector& begin, const RationalVector& end, std::size_t polygon);
  /// Joins what continues each other. After the last arc, before vertices().
  void join();

  RationalView view;

 private:
  std::vector<std::size_t> groups_;
  RationalVector normal_;
  std::vector<HorizonInView> horizon_;
};

}  // namespace detail

}  // namespace irradiff
