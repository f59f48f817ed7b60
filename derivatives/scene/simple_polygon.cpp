#include "derivatives/scene/simple_polygon.h"

#include "derivatives/scene/orientation.h"
#include "derivatives/scene/sweep_order.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <set>
#include <vector>

namespace irradiff {

namespace {

class Sweep {
 public:
  explicit Sweep(std::span<const Eigen::Vector2d> vertices)
      : vertices_(vertices), active_(LowerEdge{this}), position_(vertices.size(), active_.end()) {}

  std::optional<EdgePair> firstMeeting() {
    for (std::size_t edge = 0; edge < vertices_.size() && !meeting_; ++edge) compareWithNext(edge);
    std::vector<std::size_t> order(vertices_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [this](std::size_t a, std::size_t b) { return sweptBefore(vertices_[a], vertices_[b]); });
    for (const std::size_t vertex : order) {
      const std::size_t incoming = (vertex + vertices_.size() - 1) % vertices_.size();
      for (const std::size_t edge : {incoming, vertex}) {
        if (!meeting_ && last(edge) == vertex) leave(edge);
      }
      for (const std::size_t edge : {incoming, vertex}) {
        if (!meeting_ && first(edge) == vertex) enter(edge);
      }
      if (meeting_) break;
    }
    return meeting_;
  }

 private:
  // Order of two active edges along the sweep line. Consistent as long as no two active edges meet before the sweep
  // line, and the sweep ends where they do.
  struct LowerEdge {
    const Sweep* sweep;
    bool operator()(std::size_t a, std::size_t b) const { return sweep->isLower(a, b); }
  };
  using ActiveEdges = std::set<std::size_t, LowerEdge>;

  std::size_t next(std::size_t vertex) const { return vertex + 1 == vertices_.size() ? 0 : vertex + 1; }
  bool runsForward(std::size_t edge) const { return sweptBefore(vertices_[edge], vertices_[next(edge)]); }
  std::size_t first(std::size_t edge) const { return runsForward(edge) ? edge : next(edge); }
  std::size_t last(std::size_t edge) const { return runsForward(edge) ? next(edge) : edge; }

  int side(std::size_t edge, std::size_t vertex) const {
    return orientation(vertices_[first(edge)], vertices_[last(edge)], vertices_[vertex]);
  }

  bool isLower(std::size_t a, std::size_t b) const {
    if (a == b) return false;
    int side_of_b = 0;
    if (first(a) == first(b)) {
      side_of_b = side(a, last(b));
    } else if (sweptBefore(vertices_[first(a)], vertices_[first(b)])) {
      side_of_b = side(a, first(b));
    } else {
      side_of_b = -side(b, first(a));
    }
    // Zero: the edges meet. Then they become neighbours whatever their order, and that ends the sweep.
    return side_of_b != 0 ? side_of_b > 0 : a < b;
  }

  void enter(std::size_t edge) {
    const auto position = active_.insert(edge).first;
    position_[edge] = position;
    if (position != active_.begin()) compare(*std::prev(position), edge);
    if (std::next(position) != active_.end()) compare(edge, *std::next(position));
  }

  void leave(std::size_t edge) {
    const auto above = active_.erase(position_[edge]);
    if (above != active_.begin() && above != active_.end()) compare(*std::prev(above), *above);
  }

  // An edge and the next one meet beyond their common vertex only where the polygon turns back on itself.
  void compareWithNext(std::size_t edge) {
    const std::size_t following = next(edge);
    const bool turns_back = runsForward(edge) != runsForward(following);
    if (turns_back && side(edge, next(following)) == 0) found(edge, following);
  }

  // Two edges, each with its end points, have a common point.
  void compare(std::size_t a, std::size_t b) {
    if (meeting_ || next(a) == b || next(b) == a) return;
    const auto outside = [this](std::size_t edge, std::size_t other) {
      return side(edge, first(other)) * side(edge, last(other)) > 0;
    };
    const auto ends_before = [this](std::size_t edge, std::size_t other) {
      return sweptBefore(vertices_[last(edge)], vertices_[first(other)]);
    };
    if (!outside(a, b) && !outside(b, a) && !ends_before(a, b) && !ends_before(b, a)) found(a, b);
  }

  void found(std::size_t a, std::size_t b) { meeting_ = EdgePair{std::min(a, b), std::max(a, b)}; }

  std::span<const Eigen::Vector2d> vertices_;
  ActiveEdges active_;
  std::vector<ActiveEdges::iterator> position_;
  std::optional<EdgePair> meeting_;
};

}  // namespace

std::optional<EdgePair> meetingEdges(std::span<const Eigen::Vector2d> vertices) {
  return Sweep(vertices).firstMeeting();
}

}  // namespace irradiff
