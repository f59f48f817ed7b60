#include "derivatives/scene/triangulation.h"

#include "derivatives/scene/orientation.h"
#include "derivatives/scene/polygon_plane.h"
#include "derivatives/scene/sweep_order.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <set>
#include <span>
#include <utility>

namespace irradiff {

namespace {

using Triangle = std::array<std::size_t, 3>;

// The sweep of Hertel and Mehlhorn, "Fast triangulation of simple polygons" (1983). Left of the sweep line the inside
// of the polygon is triangulated but for its slabs: the parts that reach the line, each between a lower and an upper
// edge. A slab begins at its front, a chain of vertices from the left end of the lower edge to that of the upper one
// whose inner angles are 180 degrees or more: at a smaller one a triangle is cut off at once. So every vertex sees the
// one met last in its slab, and at the slab's end the last vertex sees the whole front.
class TriangulatingSweep {
 public:
  // Requires a simple polygon that turns counterclockwise: its inside is above the edges that run forward.
  explicit TriangulatingSweep(std::span<const Eigen::Vector2d> vertices)
      : vertices_(vertices), lower_edges_(LowerEdge{this}), slab_of_(vertices.size()) {}

  std::vector<Triangle> triangles() {
    std::vector<std::size_t> order(vertices_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [this](std::size_t a, std::size_t b) { return sweptBefore(vertices_[a], vertices_[b]); });
    triangles_.reserve(vertices_.size() - 2);
    for (const std::size_t vertex : order) meet(vertex);
    return std::move(triangles_);
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  // A place in a front. A vertex may have one in each of two slabs.
  struct Link {
    std::size_t vertex;
    std::size_t below = kNone;
    std::size_t above = kNone;
  };

  // The front as links, and its vertex met last.
  struct Slab {
    std::size_t lower_edge;
    std::size_t bottom;
    std::size_t top;
    std::size_t last;
  };

  // Order along the sweep line. Edges that run forward have no common point while both reach the line: one has left
  // before the next one enters.
  struct LowerEdge {
    const TriangulatingSweep* sweep;
    bool operator()(std::size_t a, std::size_t b) const { return sweep->isLower(a, b); }
  };

  std::size_t next(std::size_t vertex) const { return vertex + 1 == vertices_.size() ? 0 : vertex + 1; }
  std::size_t previous(std::size_t vertex) const { return (vertex == 0 ? vertices_.size() : vertex) - 1; }
  bool runsForward(std::size_t edge) const { return sweptBefore(vertices_[edge], vertices_[next(edge)]); }
  int turn(std::size_t a, std::size_t b, std::size_t c) const {
    return orientation(vertices_[a], vertices_[b], vertices_[c]);
  }

  bool isLower(std::size_t a, std::size_t b) const {
    if (a == b) return false;
    return sweptBefore(vertices_[a], vertices_[b]) ? turn(a, next(a), b) > 0 : turn(b, next(b), a) < 0;
  }

  void meet(std::size_t vertex) {
    const std::size_t incoming = previous(vertex);
    const std::size_t outgoing = vertex;
    const bool comes_forward = runsForward(incoming);
    const bool goes_forward = runsForward(outgoing);
    const bool is_convex = turn(incoming, vertex, next(vertex)) > 0;
    if (comes_forward) lower_edges_.erase(incoming);
    if (goes_forward) lower_edges_.insert(outgoing);
    if (comes_forward && goes_forward) {
      Slab& slab = slabs_[slab_of_[incoming]];
      slab.lower_edge = outgoing;
      slab_of_[outgoing] = slab_of_[incoming];
      extendBottom(slab, vertex);
    } else if (!comes_forward && !goes_forward) {
      slab_of_[incoming] = slab_of_[outgoing];
      extendTop(slabs_[slab_of_[incoming]], vertex);
    } else if (goes_forward && is_convex) {
      begin(vertex, incoming, outgoing);
    } else if (goes_forward) {
      split(vertex, incoming, outgoing);
    } else if (is_convex) {
      extendBottom(slabs_[slab_of_[incoming]], vertex);
    } else {
      merge(vertex, slab_of_[outgoing], slab_of_[incoming]);
    }
  }

  std::size_t link(std::size_t vertex) {
    links_.push_back({vertex});
    return links_.size() - 1;
  }

  void begin(std::size_t vertex, std::size_t upper_edge, std::size_t lower_edge) {
    const std::size_t only = link(vertex);
    slab_of_[upper_edge] = slab_of_[lower_edge] = slabs_.size();
    slabs_.push_back({lower_edge, only, only, only});
  }

  // The vertex comes between the edges of a slab, which becomes two with the vertex met last in both.
  void split(std::size_t vertex, std::size_t upper_edge, std::size_t lower_edge) {
    const std::size_t whole = slab_of_[*std::prev(lower_edges_.find(lower_edge))];
    const std::size_t last = slabs_[whole].last;
    const std::size_t copy = link(links_[last].vertex);
    links_[copy].below = links_[last].below;
    if (links_[copy].below != kNone) links_[links_[copy].below].above = copy;
    links_[last].below = kNone;

    Slab lower{slabs_[whole].lower_edge, slabs_[whole].bottom == last ? copy : slabs_[whole].bottom, copy, copy};
    extendTop(lower, vertex);
    slab_of_[lower.lower_edge] = slab_of_[upper_edge] = slabs_.size();
    slabs_.push_back(lower);

    Slab& upper = slabs_[whole];
    upper.lower_edge = lower_edge;
    upper.bottom = last;
    slab_of_[lower_edge] = whole;
    extendBottom(upper, vertex);
  }

  // The vertex ends the edges between two slabs, which become one.
  void merge(std::size_t vertex, std::size_t lower, std::size_t upper) {
    extendTop(slabs_[lower], vertex);
    extendBottom(slabs_[upper], vertex);
    const std::size_t join = slabs_[upper].bottom;
    const std::size_t below = links_[slabs_[lower].top].below;
    links_[join].below = below;
    links_[below].above = join;
    slabs_[upper].bottom = slabs_[lower].bottom;
    slabs_[upper].lower_edge = slabs_[lower].lower_edge;
    slab_of_[slabs_[lower].lower_edge] = upper;
  }

  // The vertex becomes the lower end of the front, with all triangles that it makes there.
  void extendBottom(Slab& slab, std::size_t vertex) {
    std::size_t end = slab.bottom;
    for (std::size_t above = links_[end].above; above != kNone; above = links_[end].above) {
      if (turn(links_[end].vertex, vertex, links_[above].vertex) <= 0) break;
      triangles_.push_back({links_[end].vertex, vertex, links_[above].vertex});
      end = above;
    }
    slab.bottom = slab.last = link(vertex);
    links_[slab.bottom].above = end;
    links_[end].below = slab.bottom;
  }

  void extendTop(Slab& slab, std::size_t vertex) {
    std::size_t end = slab.top;
    for (std::size_t below = links_[end].below; below != kNone; below = links_[end].below) {
      if (turn(links_[below].vertex, vertex, links_[end].vertex) <= 0) break;
      triangles_.push_back({links_[below].vertex, vertex, links_[end].vertex});
      end = below;
    }
    slab.top = slab.last = link(vertex);
    links_[slab.top].below = end;
    links_[end].above = slab.top;
  }

  std::span<const Eigen::Vector2d> vertices_;
  std::set<std::size_t, LowerEdge> lower_edges_;  // that reach the sweep line
  std::vector<std::size_t> slab_of_;              // of each edge that reaches the sweep line
  std::vector<Slab> slabs_;
  std::vector<Link> links_;
  std::vector<Triangle> triangles_;
};

// Of a simple polygon: the vertex that a sweep meets first is convex.
bool turnsCounterclockwise(const std::vector<Eigen::Vector2d>& vertices) {
  const auto first = std::ranges::min_element(vertices, sweptBefore);
  const Eigen::Vector2d& before = first == vertices.begin() ? vertices.back() : *std::prev(first);
  const Eigen::Vector2d& after = std::next(first) == vertices.end() ? vertices.front() : *std::next(first);
  return orientation(before, *first, after) > 0;
}

}  // namespace

std::vector<Triangle> triangulate(const Polygon& polygon) {
  const Eigen::Vector3d normal = widestNormal(localShape(polygon.vertices).vertices);
  std::vector<Eigen::Vector2d> plane = projection(polygon.vertices, normal);
  if (!turnsCounterclockwise(plane)) {
    // The mirror image does, and its triangles turn as it does.
    for (Eigen::Vector2d& vertex : plane) vertex.x() = -vertex.x();
  }
  return TriangulatingSweep(plane).triangles();
}

}  // namespace irradiff
