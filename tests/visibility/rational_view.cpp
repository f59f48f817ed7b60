#include "tests/visibility/rational_view.h"

#include <algorithm>
#include <sstream>

namespace irradiff {

namespace {

std::string textOf(const RationalVector& v) {
  std::ostringstream text;
  text << '(' << v[0] << ", " << v[1] << ", " << v[2] << ')';
  return text.str();
}

std::string textOf(const CirclePlace& place) {
  std::ostringstream text;
  if (place.first != 0) {
    text << "horizon";
  } else {
    text << place.second;
  }
  return text.str();
}

std::string textOf(std::size_t polygon) { return polygon == kNone ? "-" : std::to_string(polygon); }
std::string textOf(const ArcSidesInView& sides) {
  return "left " + textOf(sides.left) + " right " + textOf(sides.right);
}

std::string textOf(const VertexInView& vertex) {
  return textOf(vertex.direction) + ": circle " + textOf(vertex.far_circle) + " behind " + textOf(vertex.near_circle) +
         ", before " + textOf(vertex.before) + ", after " + textOf(vertex.after);
}

std::string textOf(const HorizonInView& arc) {
  return textOf(arc.begin) + " to " + textOf(arc.end) + " polygon " + textOf(arc.polygon);
}

bool areInOnePlane(const Polygon& a, const Polygon& b) {
  const RationalVector origin = rational(a.vertices[0]);
  RationalVector area{};
  for (std::size_t i = 1; i + 1 < a.vertices.size(); ++i) {
    area = area + cross(rational(a.vertices[i]) - origin, rational(a.vertices[i + 1]) - origin);
  }
  return std::ranges::all_of(b.vertices,
                             [&](const Eigen::Vector3d& v) { return dot(area, rational(v) - origin) == 0; });
}

// In two axes at least; in that across the plane neither box may have a width.
bool boxesOverlap(const Polygon& a, const Polygon& b) {
  int overlaps = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto less = [axis](const Eigen::Vector3d& p, const Eigen::Vector3d& q) { return p(axis) < q(axis); };
    const auto [low_a, high_a] = std::ranges::minmax(a.vertices, less);
    const auto [low_b, high_b] = std::ranges::minmax(b.vertices, less);
    if (std::min(high_a(axis), high_b(axis)) < std::max(low_a(axis), low_b(axis))) return false;
    if (std::min(high_a(axis), high_b(axis)) > std::max(low_a(axis), low_b(axis))) ++overlaps;
  }
  return overlaps >= 2;
}

// Of one circle, in order; without the lines where they are not to be compared.
std::vector<std::string> arcTexts(const RationalView& view, const RationalVector& circle, bool with_lines) {
  std::vector<std::string> texts;
  const auto found = view.arcs.find(circle);
  if (found == view.arcs.end()) return texts;
  std::vector<ArcInView> arcs = found->second;
  if (!with_lines) {
    std::vector<ArcInView> joined;
    for (const ArcInView& arc : arcs) {
      if (!joined.empty() && joined.back().to == arc.from && joined.back().sides == arc.sides) {
        joined.back().to = arc.to;
      } else {
        joined.push_back(arc);
      }
    }
    arcs = joined;
  }
  for (const ArcInView& arc : arcs) {
    std::string text = "arc on circle " + textOf(circle) + " from " + textOf(arc.from) + " to " + textOf(arc.to) + ' ' +
                       textOf(arc.sides);
    if (with_lines) text += " on the line along " + textOf(arc.line.first) + " with moment " + textOf(arc.line.second);
    texts.push_back(text);
  }
  return texts;
}

template <class Part>
void compareSets(const std::set<Part>& exact, const std::set<Part>& other, const std::string& what,
                 std::vector<std::string>& found) {
  for (const Part& part : exact) {
    if (!other.contains(part)) found.push_back("missing " + what + ' ' + textOf(part));
  }
  for (const Part& part : other) {
    if (!exact.contains(part)) found.push_back("additional " + what + ' ' + textOf(part));
  }
}

}  // namespace

std::vector<std::size_t> overlapGroups(std::span<const Polygon> polygons) {
  std::vector<std::size_t> groups(polygons.size());
  for (std::size_t b = 0; b < polygons.size(); ++b) {
    groups[b] = b;
    for (std::size_t a = 0; a < b; ++a) {
      if (polygons[a].radiance != polygons[b].radiance || !boxesOverlap(polygons[a], polygons[b]) ||
          !areInOnePlane(polygons[a], polygons[b])) {
        continue;
      }
      const std::size_t low = std::min(groups[a], groups[b]);
      const std::size_t high = std::max(groups[a], groups[b]);
      std::ranges::replace(groups, high, low);
    }
  }
  return groups;
}

std::vector<std::string> differences(const RationalView& exact, const RationalView& other) {
  std::vector<std::string> found;
  for (const RationalView* view : {&exact, &other}) {
    found.insert(found.end(), view->contradictions.begin(), view->contradictions.end());
  }
  std::set<RationalVector> circles;
  for (const RationalView* view : {&exact, &other}) {
    for (const auto& [circle, arcs] : view->arcs) circles.insert(circle);
  }
  for (const RationalVector& circle : circles) {
    const bool with_lines = !exact.lines_over_each_other.contains(circle);
    const std::vector<std::string> a = arcTexts(exact, circle, with_lines);
    const std::vector<std::string> b = arcTexts(other, circle, with_lines);
    if (a == b) continue;
    for (const std::string& text : a) {
      if (std::ranges::find(b, text) == b.end()) found.push_back("missing " + text);
    }
    for (const std::string& text : b) {
      if (std::ranges::find(a, text) == a.end()) found.push_back("additional " + text);
    }
    if (found.empty()) found.push_back("an arc counted twice on circle " + textOf(circle));
  }
  const auto simple = [&exact](const RationalView& view) {
    std::set<VertexInView> vertices;
    for (const VertexInView& vertex : view.vertices) {
      const auto contains = [&vertex](const RationalVector& circle) { return dot(circle, vertex.direction) == 0; };
      if (!exact.meetings.contains(vertex.direction) && std::ranges::none_of(exact.edge_on_circles, contains)) {
        vertices.insert(vertex);
      }
    }
    return vertices;
  };
  compareSets(simple(exact), simple(other), "apparent vertex", found);
  compareSets(exact.horizon, other.horizon, "horizon interval", found);
  compareSets(exact.edge_on, other.edge_on, "polygon seen edge-on", found);
  return found;
}

bool hasCornerBehindAnArc(const RationalView& view, std::span<const Polygon> polygons, const Receiver& receiver) {
  const detail::ViewBuilder builder(polygons, receiver);
  const RationalVector position = rational(receiver.position);
  for (const auto& [circle, arcs] : view.arcs) {
    // Points of edges seen on the circle. A vertex is two of them.
    std::vector<RationalVector> points;
    for (const Polygon& polygon : polygons) {
      for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
        const RationalVector a = rational(polygon.vertices[i]) - position;
        const RationalVector b = rational(polygon.vertices[(i + 1) % polygon.vertices.size()]) - position;
        const Rational from = dot(circle, a);
        const Rational to = dot(circle, b);
        if (from == 0) points.push_back(a);
        if (to == 0) points.push_back(b);
        if (from * to < 0) points.push_back(a + from / (from - to) * (b - a));
      }
    }
    std::erase_if(points, [&](const RationalVector& point) { return dot(builder.normal(), point) <= 0; });
    for (const ArcInView& arc : arcs) {
      std::map<CirclePlace, int> behind;
      for (const RationalVector& point : points) {
        const CirclePlace place = builder.place(circle, point);
        if (place < arc.from || arc.to < place || cross(point, arc.line.first) == arc.line.second) continue;
        if (place == arc.from || place == arc.to) return true;
        ++behind[place];
      }
      if (std::ranges::any_of(behind, [](const auto& at) { return at.second > 1; })) return true;
    }
  }
  return false;
}

namespace detail {

CirclePlace ViewBuilder::place(const RationalVector& circle, const RationalVector& direction) const {
  const Rational height = dot(normal_, direction);
  const Rational along = dot(cross(circle, normal_), direction);
  if (height == 0) return {along < 0 ? -1 : 1, 0};
  return {0, along / height};
}

void ViewBuilder::addArc(const RationalVector& begin, const RationalVector& end, ArcSidesInView sides) {
  if (sides.left == sides.right) return;
  const RationalVector plane = cross(begin, end);
  if (isZero(plane)) {
    view.contradictions.push_back("an arc without length at " + textOf(begin));
    return;
  }
  const RationalVector circle = withoutScale(plane);
  const RationalVector edge = end - begin;
  // The moment for the edge as scaled.
  ArcInView arc{place(circle, begin), place(circle, end), sides, {withoutScale(edge), {}}};
  arc.line.second = (1 / leading(edge)) * plane;
  if (arc.to < arc.from) {
    std::swap(arc.from, arc.to);
    std::swap(arc.sides.left, arc.sides.right);
  }
  view.arcs[circle].push_back(arc);
}

void ViewBuilder::addHorizon(const RationalVector& begin, const RationalVector& end, std::size_t polygon) {
  if (polygon != kNone) horizon_.push_back({withoutLength(begin), withoutLength(end), group(polygon)});
}

void ViewBuilder::join() {
  for (auto& [circle, arcs] : view.arcs) {
    std::ranges::sort(arcs, {}, [](const ArcInView& arc) { return std::tie(arc.from, arc.to); });
    std::vector<ArcInView> joined;
    for (const ArcInView& arc : arcs) {
      if (!joined.empty() && arc.from < joined.back().to) {
        view.contradictions.push_back("two arcs over each other on circle " + textOf(circle));
      }
      if (!joined.empty() && joined.back().to == arc.from && joined.back().sides == arc.sides &&
          joined.back().line == arc.line) {
        joined.back().to = arc.to;
      } else {
        joined.push_back(arc);
      }
    }
    arcs = joined;
  }
  for (std::size_t i = 0; i < horizon_.size();) {
    const auto next = std::ranges::find_if(horizon_, [&](const HorizonInView& other) {
      return &other != &horizon_[i] && other.begin == horizon_[i].end && other.polygon == horizon_[i].polygon;
    });
    if (next == horizon_.end()) {
      ++i;
    } else {
      horizon_[i].end = next->end;
      horizon_.erase(next);
      i = 0;
    }
  }
  view.horizon.insert(horizon_.begin(), horizon_.end());
}

}  // namespace detail

}  // namespace irradiff
