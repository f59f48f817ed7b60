#pragma once

#include "derivatives/visibility/scene_in_view.h"
#include "derivatives/visibility/view_grid.h"
#include "derivatives/visibility/view_predicates.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace irradiff {

/// A face that may be seen beside an edge, and the sides of it on which the face is at one place, near or hidden.
struct FaceBeside {
  std::size_t face;
  bool left = false;
  bool right = false;
  bool meets_start = false;  ///< its outline may pass through the direction of the edge's start
  bool meets_end = false;
};

/// The sides of an edge on which a face begins or ceases to be at a crossing.
struct FaceToggle {
  std::size_t beside;  ///< index of EdgeCrossings::faces
  bool left;
  bool right;
};

/// What is on an edge in one direction.
struct EdgeCrossing {
  /// In increasing order of polygon, kind and index: the first stands for all, and must not depend on what was looked
  /// at first, nor on polygons that come after.
  /// On the horizon that alone: what happens there counts for nothing else.
  std::vector<EdgePlace> places;
  std::vector<FaceToggle> toggles;
};

/// Two points in one direction.
struct Alignment {
  std::size_t first;
  std::size_t second;
};

/// Everything that crosses an edge in view, near or hidden.
struct EdgeCrossings {
  std::vector<FaceBeside> faces;        ///< as they are at the edge's start
  std::vector<EdgeCrossing> crossings;  ///< between its ends, in their order on it
  std::vector<std::size_t> in_line;     ///< edges in the same plane of view
  std::vector<Alignment> at_ends;       ///< points in the direction of one of its ends, and that end
};

/// Finds what crosses the edges of a scene in view, one edge after another.
class EdgeCrossingFinder {
 public:
  /// Keeps a reference to the scene. `grid_resolution` is that of the ViewGrid: no result depends on it.
  EdgeCrossingFinder(const SceneInView& scene, int grid_resolution);

  /// Requires an edge with a plane of view.
  EdgeCrossings find(std::size_t edge);

 private:
  /// Where something crosses the great circle of the edge.
  struct CircleLocation {
    bool is_ahead = false;      ///< within the half circle that begins at the edge's start
    bool is_at_start = false;   ///< in the direction of the edge's start, or opposite
    bool is_at_end = false;     ///< in the direction of the edge's end, or opposite
    std::size_t event = kNone;  ///< index of the event, if it is between the edge's ends
  };

  /// A place between the ends of the edge, with an interval that contains its parameter.
  struct Event {
    EdgePlace place;
    double lower;
    double upper;
  };

  struct EventToggle {
    std::size_t event;
    FaceToggle toggle;
  };

  void addFace(std::size_t face);
  void addCrease(std::size_t crease);
  void addInLine(std::size_t other);
  std::size_t addEvent(const EdgePlace& place);
  int sideOf(std::size_t point);
  CircleLocation crossingAt(std::size_t other);
  CircleLocation pointAt(std::size_t point);
  void orderEvents();
  /// The first of the polygons that make a place; kNone for the horizon.
  std::size_t firstPolygonAt(const EdgePlace& place) const;

  const SceneInView& scene_;
  const ViewPredicates& predicates_;
  ViewGrid grid_;  ///< of the faces that count and of their creases

  // Of the edge in hand.
  std::size_t edge_ = kNone;
  EdgeCrossings found_;
  std::vector<Event> events_;
  std::vector<EventToggle> toggles_;
  std::vector<std::size_t> near_faces_, near_creases_;
  // What is known of points and edges; of this edge where the stamp is that of this search.
  std::size_t stamp_ = 0;
  std::vector<std::size_t> side_stamp_, point_stamp_, edge_stamp_;
  std::vector<std::int8_t> side_;
  std::vector<CircleLocation> point_location_, edge_location_;
};

}  // namespace irradiff
