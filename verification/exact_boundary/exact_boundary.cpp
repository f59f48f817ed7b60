#include "verification/exact_boundary/exact_boundary.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace irradiff {

namespace {

Rational rationalOf(const ExactRational& number) { return Rational(number.numerator) / Rational(number.denominator); }
RationalVector rationalOf(const ExactVector& v) { return {rationalOf(v[0]), rationalOf(v[1]), rationalOf(v[2])}; }

/// r' + t e', relative to the receiver.
struct Line {
  RationalVector start;
  RationalVector along;
};

class ExactLines {
 public:
  ExactLines(const std::vector<Polygon>& polygons, const RationalVector& position)
      : polygons_(polygons), position_(position) {}

  Line line(const ExactLine& line) const {
    const std::vector<Eigen::Vector3d>& vertices = polygons_[line.polygon].vertices;
    if (line.kind == ExactLine::Kind::kEdge) {
      const RationalVector start = vertex(vertices[line.edge_or_partner]);
      return {start, vertex(vertices[(line.edge_or_partner + 1) % vertices.size()]) - start};
    }
    // In which the planes A.p = a and B.p = b meet: along D = A x B, through (a B x D + b D x A)/D.D.
    const auto [first, first_offset] = plane(line.polygon);
    const auto [second, second_offset] = plane(line.edge_or_partner);
    const RationalVector along = cross(first, second);
    const RationalVector point = first_offset * cross(second, along) + second_offset * cross(along, first);
    return {1 / dot(along, along) * point, along};
  }

  std::string describe(const ExactLine& line) const {
    const std::string polygon = describe(line.polygon);
    if (line.kind == ExactLine::Kind::kEdge) return "an edge of " + polygon;
    return "the line in which " + polygon + " and " + describe(line.edge_or_partner) + " pass through each other";
  }

 private:
  RationalVector vertex(const Eigen::Vector3d& v) const { return rational(v) - position_; }

  std::pair<RationalVector, Rational> plane(std::size_t polygon) const {
    const std::vector<Eigen::Vector3d>& vertices = polygons_[polygon].vertices;
    const RationalVector origin = vertex(vertices[0]);
    RationalVector area{};
    for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
      area = area + cross(vertex(vertices[i]) - origin, vertex(vertices[i + 1]) - origin);
    }
    return {area, dot(area, origin)};
  }

  std::string describe(std::size_t polygon) const {
    return "polygons[" + std::to_string(polygon) + "] \"" + polygons_[polygon].name + '"';
  }

  const std::vector<Polygon>& polygons_;
  RationalVector position_;
};

bool isOn(const RationalArc& arc, const RationalVector& direction) {
  const RationalVector plane = cross(arc.begin, arc.end);
  return dot(plane, direction) == 0 && dot(plane, cross(arc.begin, direction)) >= 0 &&
         dot(plane, cross(direction, arc.end)) >= 0;
}

}  // namespace

ExactBoundary exactBoundary(const ExactVisibility& seen, const std::vector<Polygon>& polygons,
                            std::span<const double> radiances, const Receiver& receiver) {
  const RationalVector position = rational(receiver.position);
  const RationalVector normal = rational(receiver.normal);
  const ExactLines lines(polygons, position);
  const auto radiance = [&radiances](const FrontPolygon& polygon) { return polygon ? radiances[*polygon] : 0.0; };
  ExactBoundary boundary{};
  std::set<RationalVector> moving;
  // What ends of arcs add up to that nothing in view cuts, by great circle and direction. An arc ends so where a
  // polygon in the plane of the one beside it, of the same radiance, takes its place.
  std::map<std::pair<RationalVector, RationalVector>, Rational> uncut;
  for (const ExactArc& seen_arc : seen.arcs) {
    const Rational jump = Rational(radiance(seen_arc.right)) - Rational(radiance(seen_arc.left));
    if (jump == 0) continue;
    RationalArc arc{rationalOf(seen_arc.begin.point) - position, rationalOf(seen_arc.end.point) - position, 0, 0, jump};
    if (seen_arc.begin.kind != ExactLimitKind::kHorizon) arc.begin_height = dot(normal, arc.begin);
    if (seen_arc.end.kind != ExactLimitKind::kHorizon) arc.end_height = dot(normal, arc.end);
    if (!seen_arc.aligned.empty() && boundary.no_gradient.empty()) {
      boundary.no_gradient = lines.describe(seen_arc.line) + " and " + lines.describe(seen_arc.aligned.front()) +
                             " lie over each other as seen from the receiver: one may hide the other or not";
    }
    const RationalVector along = arc.end - arc.begin;
    const RationalVector moment = cross(arc.begin, along);
    for (const bool is_upper : {false, true}) {
      const ExactArcLimit& limit = is_upper ? seen_arc.end : seen_arc.begin;
      if (limit.kind != ExactLimitKind::kCrossing) continue;
      const RationalVector& point = is_upper ? arc.end : arc.begin;
      std::vector<RationalVector> motions;
      for (const ExactLine& crossing : limit.crossing) {
        const Line cutting = lines.line(crossing);
        const RationalVector plane = cross(cutting.start, cutting.along);
        const Rational across = dot(along, plane);
        if (across != 0) motions.push_back(1 / across * (plane - cross(point, cutting.along)));
      }
      const Rational height = dot(normal, point);
      const RationalVector direction = 1 / height * point;
      if (motions.empty()) {
        uncut[{withoutScale(moment), direction}] += (is_upper == (leading(moment) > 0) ? 1 : -1) * jump;
        continue;
      }
      // Where several lines meet at different depths there is no Hessian, which is found below.
      const RationalVector& motion = motions.front();
      if (isZero(motion)) continue;
      const Rational square = dot(point, point);
      moving.insert(direction);
      const Rational factor = (is_upper ? 1 : -1) * jump * height / (square * square);
      for (std::size_t i = 0; i < 3; ++i) {
        boundary.vertex_hessian[i] = boundary.vertex_hessian[i] + factor * moment[i] * motion;
      }
    }
    boundary.arcs.push_back(std::move(arc));
  }
  boundary.apparent_vertices = moving.size();
  for (const ExactHorizonArc& arc : seen.horizon) {
    if (radiances[arc.polygon] == 0.0) continue;
    boundary.horizon.push_back({rationalOf(arc.begin), rationalOf(arc.end), radiances[arc.polygon]});
  }
  for (const ExactApparentVertex& vertex : seen.apparent_vertices) {
    if (!vertex.degenerate || !boundary.no_hessian.empty()) continue;
    std::set<double> about;
    for (const ExactLine& line : vertex.lines) {
      about.insert(radiances[line.polygon]);
      if (line.kind == ExactLine::Kind::kCrease) about.insert(radiances[line.edge_or_partner]);
    }
    const RationalVector direction = rationalOf(vertex.direction);
    if (about.size() > 1 ||
        std::ranges::any_of(boundary.arcs, [&](const RationalArc& arc) { return isOn(arc, direction); })) {
      boundary.no_hessian = lines.describe(vertex.lines.front()) + " and " + lines.describe(vertex.lines.back()) +
                            " meet with a third line in one direction from the receiver";
    }
  }
  if (boundary.no_hessian.empty()) boundary.no_hessian = boundary.no_gradient;
  if (boundary.no_hessian.empty() && std::ranges::any_of(uncut, [](const auto& end) { return end.second != 0; })) {
    throw std::logic_error("exactBoundary: an arc ends in view, and nothing cuts it");
  }
  return boundary;
}

}  // namespace irradiff
