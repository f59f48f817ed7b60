#include "derivatives/visibility/view_horizon.h"

#include "derivatives/scene/certified_sign.h"
#include "derivatives/visibility/lifted_vector.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace irradiff {
namespace {

/// The ends of arcs on the horizon, arc by arc.
std::vector<HorizonPlace> endsOnHorizon(const SceneInView& scene, std::span<const VisibleArc> arcs) {
  std::vector<HorizonPlace> places;
  for (const VisibleArc& arc : arcs) {
    const MeshEdge& e = scene.edge(arc.edge);
    const auto meets = [&](const EdgePlace& place, std::size_t end, EdgePlace::Kind kind) {
      return place.kind == EdgePlace::Kind::kHorizon || (place.kind == kind && scene.height(end) == 0);
    };
    if (meets(arc.first, e.start, EdgePlace::Kind::kStart)) {
      places.push_back({arc.edge, arc.first, arc.sides.right, arc.sides.left});
    }
    if (meets(arc.last, e.end, EdgePlace::Kind::kEnd)) {
      places.push_back({arc.edge, arc.last, arc.sides.left, arc.sides.right});
    }
  }
  return places;
}

/// Directions on the horizon in counterclockwise order, from that of an origin on.
class HorizonOrder {
 public:
  HorizonOrder(const ViewPredicates& predicates, const HorizonPlace& origin)
      : predicates_(predicates), origin_(origin) {}

  /// 0 in the direction of the origin, 1 in the half circle after it, 2 opposite, 3 beyond.
  int quarter(const HorizonPlace& place) const {
    const int side = turn(origin_, place);
    if (side > 0) return 1;
    if (side < 0) return 3;
    return isBehind(place) ? 2 : 0;
  }

  /// 1 where b is counterclockwise of a by less than half a turn, -1 where clockwise, 0 where in line.
  int turn(const HorizonPlace& a, const HorizonPlace& b) const {
    return certifiedSign([&]<class Number>(std::type_identity<Number>) {
      return determinant(predicates_.normal<Number>(), predicates_.direction<Number>(a.edge, a.place),
                         predicates_.direction<Number>(b.edge, b.place));
    });
  }

 private:
  bool isBehind(const HorizonPlace& place) const {
    return certifiedSign([&]<class Number>(std::type_identity<Number>) {
             return dot(predicates_.direction<Number>(origin_.edge, origin_.place),
                        predicates_.direction<Number>(place.edge, place.place));
           }) < 0;
  }

  const ViewPredicates& predicates_;
  HorizonPlace origin_;
};

/// What places in one direction change together: the polygon that comes in and the one that goes out; nothing where the
/// same polygon lies on both sides.
std::optional<HorizonPlace> netChange(std::span<const std::pair<int, HorizonPlace>> places) {
  std::vector<std::size_t> incoming;
  std::vector<std::size_t> outgoing;
  for (const auto& [quarter, place] : places) {
    incoming.push_back(place.clockwise);
    outgoing.push_back(place.counterclockwise);
  }
  for (auto polygon = incoming.begin(); polygon != incoming.end();) {
    const auto same = std::ranges::find(outgoing, *polygon);
    if (same == outgoing.end()) {
      ++polygon;
    } else {
      outgoing.erase(same);
      polygon = incoming.erase(polygon);
    }
  }
  if (incoming.empty()) return std::nullopt;
  const HorizonPlace& first = places.front().second;
  return HorizonPlace{first.edge, first.place, incoming.front(), outgoing.front()};
}

}  // namespace

std::vector<HorizonPlace> placesOnHorizon(const SceneInView& scene, std::span<const VisibleArc> arcs) {
  const std::vector<HorizonPlace> ends = endsOnHorizon(scene, arcs);
  if (ends.empty()) return {};
  const HorizonOrder order(scene.predicates(), ends.front());
  std::vector<std::pair<int, HorizonPlace>> keyed;
  keyed.reserve(ends.size());
  for (const HorizonPlace& end : ends) keyed.emplace_back(order.quarter(end), end);
  std::ranges::stable_sort(keyed, [&](const auto& a, const auto& b) {
    if (a.first != b.first) return a.first < b.first;
    return a.first % 2 == 1 && order.turn(a.second, b.second) > 0;
  });
  std::vector<HorizonPlace> places;
  for (std::size_t first = 0; first < keyed.size();) {
    std::size_t last = first + 1;
    while (last < keyed.size() && keyed[last].first == keyed[first].first &&
           (keyed[first].first % 2 == 0 || order.turn(keyed[first].second, keyed[last].second) == 0)) {
      ++last;
    }
    if (const std::optional<HorizonPlace> net = netChange(std::span(keyed).subspan(first, last - first))) {
      places.push_back(*net);
    }
    first = last;
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].counterclockwise != places[(i + 1) % places.size()].clockwise) {
      throw std::logic_error("visibleBoundary: what is seen along the horizon does not connect");
    }
  }
  return places;
}

std::optional<std::string> creaseOnHorizon(const SceneInView& scene) {
  for (std::size_t c = scene.mesh().firstCrease(); c < scene.mesh().edges().size(); ++c) {
    const MeshEdge& crease = scene.edge(c);
    if (scene.isPresentEdge(c) && scene.height(crease.start) == 0 && scene.height(crease.end) == 0 &&
        scene.radianceOf(crease.faces.front()) != scene.radianceOf(crease.faces.back())) {
      return scene.describeEdge(c) +
             " lies on the receiver's horizon: the second derivative along the normal is one-sided";
    }
  }
  return std::nullopt;
}

}  // namespace irradiff
