#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace irradiff {

/// What changes about a view as the receiver moves without turning (docs/derivations/visibility.md, section 6).
enum class EventKind {
  kVertexOnEdge,  ///< a vertex and a foreign edge come to lie in one direction; in flatland two ends, or crossings
  kThreeEdges,    ///< three edges do; not in flatland
  kEdgeOn,        ///< the receiver comes to lie in a polygon's plane, in flatland on a segment's line
  kHorizon,       ///< a vertex comes to lie on the horizon, or where two edges cross in view
};

inline constexpr std::array<EventKind, 4> kEventKinds = {EventKind::kVertexOnEdge, EventKind::kThreeEdges,
                                                         EventKind::kEdgeOn, EventKind::kHorizon};

/// A place at which the view may change.
template <int Dimension>
struct VisibilityEvent {
  EventKind kind = EventKind::kVertexOnEdge;
  /// The Hessian is another one beyond (in the plane of a polygon, and where parallel edges come into line, the
  /// gradient too); else only its derivative is.
  bool hessian_jumps = true;
  /// The receiver reaches the event by no shorter move. Metres.
  double distance = std::numeric_limits<double>::infinity();
  /// How far the event is off if every coordinate of the scene and of the receiver was rounded to double, to first
  /// order. Metres.
  double rounding = 0.0;
  /// A move to the event; of three edges to first order. Metres.
  Eigen::Matrix<double, Dimension, 1> displacement = Eigen::Matrix<double, Dimension, 1>::Zero();
  std::string what;  ///< "a vertex of polygons[1] "screen" and an edge of polygons[0] "lamp""
};

/// Events in order of distance; those that are nearer than the last are all there.
template <int Dimension>
using VisibilityEvents = std::vector<VisibilityEvent<Dimension>>;

/// At most `count` of the nearest of what has a distance, in order.
template <class Item>
class Nearest {
 public:
  explicit Nearest(std::size_t count) : count_(count) {}

  /// Nothing from here on is kept.
  double limit() const {
    return items_.size() < count_ ? std::numeric_limits<double>::infinity() : items_.back().distance;
  }
  void add(const Item& item) {
    if (!(item.distance < limit())) return;
    if (items_.size() == count_) items_.pop_back();
    const auto isNearer = [](const Item& a, const Item& b) { return a.distance < b.distance; };
    items_.insert(std::upper_bound(items_.begin(), items_.end(), item, isNearer), item);
  }
  const std::vector<Item>& items() const { return items_; }

 private:
  std::size_t count_;
  std::vector<Item> items_;
};

}  // namespace irradiff
