#include "tests/cache_2d/room_integral.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace irradiff {
namespace {

using Real = RoomIntegral::Real;
using Point = RoomIntegral::Point;

constexpr Real kOnLine = 1e-13L;
/// Between rules of 15 and 31 points: the latter is then off by far less.
constexpr Real kDifference = 1e-11L;

Real cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

template <class Integrand>
Real integral(const Integrand& integrand, Real from, Real to) {
  Real difference = 0.0L;
  const Real whole =
      boost::math::quadrature::gauss_kronrod<Real, 31>::integrate(integrand, from, to, 0, Real(0.0L), &difference);
  const Real middle = 0.5L * (from + to);
  if (difference <= kDifference || middle == from || middle == to) return whole;
  return integral(integrand, from, middle) + integral(integrand, middle, to);
}

}  // namespace

RoomIntegral::RoomIntegral(const FlatlandRoom& room) : room_(room) {
  const auto add = [this](const Point& point) {
    if (std::ranges::find(corners_, point) == corners_.end()) corners_.push_back(point);
  };
  for (std::size_t i = 0; i < room.segments.size(); ++i) {
    add(vertex(i, 0));
    add(vertex(i, 1));
    for (std::size_t j = 0; j < i; ++j) {
      const Point edge = vertex(i, 1) - vertex(i, 0);
      const Point other = vertex(j, 1) - vertex(j, 0);
      const Real turn = cross(edge, other);
      const Real share = cross(vertex(j, 0) - vertex(i, 0), other) / turn;
      const Real other_share = cross(vertex(j, 0) - vertex(i, 0), edge) / turn;
      if (share > 0.0L && share < 1.0L && other_share > 0.0L && other_share < 1.0L) add(vertex(i, 0) + share * edge);
    }
  }
}

Point RoomIntegral::towards(const Point& normal, Real angle) const {
  const Point tangent(normal.y(), -normal.x());
  return std::cos(angle) * normal + std::sin(angle) * tangent;
}

Real RoomIntegral::distance(std::size_t segment, const Point& position, const Point& direction) const {
  const Point start = vertex(segment, 0) - position;
  const Point edge = vertex(segment, 1) - vertex(segment, 0);
  const Real turn = cross(direction, edge);
  const Real share = cross(start, direction) / turn;
  const Real distance = cross(start, edge) / turn;
  const bool is_hit = turn != 0.0L && share >= 0.0L && share <= 1.0L && distance > 0.0L;
  return is_hit ? distance : std::numeric_limits<Real>::infinity();
}

std::vector<std::size_t> RoomIntegral::onLine(const Point& position, const Point& normal) const {
  std::vector<std::size_t> segments;
  for (std::size_t i = 0; i < room_.segments.size(); ++i) {
    const Real heights[2] = {(vertex(i, 0) - position).dot(normal), (vertex(i, 1) - position).dot(normal)};
    if (std::abs(heights[0]) < kOnLine && std::abs(heights[1]) < kOnLine) segments.push_back(i);
  }
  return segments;
}

std::vector<RoomIntegral::Window> RoomIntegral::windows(const Point& position, const Point& normal,
                                                        const std::vector<std::size_t>& behind) const {
  const Real quarter = std::numbers::pi_v<Real> / 2.0L;
  const Point tangent(normal.y(), -normal.x());
  std::vector<std::size_t> others;
  std::vector<Real> angles{-quarter, quarter};
  for (std::size_t i = 0; i < room_.segments.size(); ++i) {
    if (std::ranges::find(behind, i) == behind.end()) others.push_back(i);
  }
  for (const Point& corner : corners_) {
    const Point end = corner - position;
    if (end.dot(normal) > 0.0L) angles.push_back(std::atan2(end.dot(tangent), end.dot(normal)));
  }
  std::ranges::sort(angles);
  std::vector<Window> result;
  for (std::size_t k = 0; k + 1 < angles.size(); ++k) {
    if (angles[k + 1] - angles[k] < 1e-17L) continue;
    const Point middle = towards(normal, 0.5L * (angles[k] + angles[k + 1]));
    Real nearest = std::numeric_limits<Real>::infinity();
    std::size_t hit = 0;
    for (const std::size_t i : others) {
      const Real there = distance(i, position, middle);
      if (there >= nearest) continue;
      nearest = there;
      hit = i;
    }
    if (std::isfinite(nearest)) result.push_back({angles[k], angles[k + 1], hit});
  }
  return result;
}

Real RoomIntegral::direct(const Point& position, const Point& normal) const {
  Real sum = 0.0L;
  for (const Window& window : windows(position, normal, onLine(position, normal))) {
    sum += Real(room_.segments[window.segment].radiance) * (std::sin(window.to) - std::sin(window.from));
  }
  return sum;
}

std::vector<Real> RoomIntegral::breaks(const Window& window, const Point& position, const Point& normal) const {
  const Point tangent(normal.y(), -normal.x());
  std::vector<Real> angles{window.from, window.to};
  const Point start = vertex(window.segment, 0);
  const Point edge = vertex(window.segment, 1) - start;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Point line = corners_[j] - corners_[i];
      const Real turn = cross(edge, line);
      if (turn == 0.0L) continue;
      const Real share = cross(corners_[i] - start, line) / turn;
      if (!(share > 0.0L && share < 1.0L)) continue;
      const Point place = start + share * edge - position;
      const Real angle = std::atan2(place.dot(tangent), place.dot(normal));
      if (angle > window.from && angle < window.to) angles.push_back(angle);
    }
  }
  std::ranges::sort(angles);
  return angles;
}

Real RoomIntegral::indirect(const Point& position, const Point& normal, const std::vector<std::size_t>& behind) const {
  Real sum = 0.0L;
  for (const Window& window : windows(position, normal, behind)) {
    const Real share = Real(room_.reflectances[window.segment]) / 2.0L;
    if (share == 0.0L) continue;
    const Point edge = vertex(window.segment, 1) - vertex(window.segment, 0);
    Point wall_normal = Point(-edge.y(), edge.x()).normalized();
    if (wall_normal.dot(position - vertex(window.segment, 0)) < 0.0L) wall_normal = -wall_normal;
    const auto integrand = [&](Real angle) {
      const Point direction = towards(normal, angle);
      const Point hit = position + distance(window.segment, position, direction) * direction;
      return share * direct(hit, wall_normal) * std::cos(angle);
    };
    const std::vector<Real> angles = breaks(window, position, normal);
    for (std::size_t k = 0; k + 1 < angles.size(); ++k) {
      if (angles[k + 1] - angles[k] > 1e-17L) sum += integral(integrand, angles[k], angles[k + 1]);
    }
  }
  return sum;
}

Real RoomIntegral::inverseDistance(const Point& position, const Point& normal) const {
  Real sum = 0.0L;
  for (const Window& window : windows(position, normal, onLine(position, normal))) {
    const auto integrand = [&](Real angle) {
      return std::cos(angle) / distance(window.segment, position, towards(normal, angle));
    };
    sum += integral(integrand, window.from, window.to) / 2.0L;
  }
  return sum;
}

}  // namespace irradiff
