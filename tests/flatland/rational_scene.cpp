#include "tests/flatland/rational_scene.h"

#include <algorithm>
#include <cmath>

namespace irradiff {
namespace {

RationalPoint operator-(const RationalPoint& a, const RationalPoint& b) { return {a.x - b.x, a.y - b.y}; }
RationalPoint operator+(const RationalPoint& a, const RationalPoint& b) { return {a.x + b.x, a.y + b.y}; }
RationalPoint operator*(const Rational& factor, const RationalPoint& a) { return {factor * a.x, factor * a.y}; }

Rational cross(const RationalPoint& a, const RationalPoint& b) { return a.x * b.y - a.y * b.x; }
Rational dot(const RationalPoint& a, const RationalPoint& b) { return a.x * b.x + a.y * b.y; }

bool isInside(const Rational& along) { return along > 0 && along < 1; }

/// A vector of about length 1 in the same direction, so that middles are not all in the direction of the farther end.
RationalPoint evened(const RationalPoint& v) {
  const Rational size = abs(v.x) > abs(v.y) ? abs(v.x) : abs(v.y);
  return {v.x / size, v.y / size};
}

}  // namespace

RationalPoint exactly(const Eigen::Vector2d& p) { return {Rational(p(0)), Rational(p(1))}; }

RationalScene::RationalScene(std::span<const Segment> segments, const FlatlandReceiver& receiver,
                             std::span<const std::size_t> own)
    : position_(exactly(receiver.position)), normal_(exactly(receiver.normal)) {
  for (std::size_t i = 0; i < segments.size(); ++i) {
    radiances_.push_back(segments[i].radiance);
    if (std::find(own.begin(), own.end(), i) == own.end()) {
      lines_.push_back({i, exactly(segments[i].vertices[0]), exactly(segments[i].vertices[1]), segments[i].radiance});
    }
  }
  addScenePoints();
}

void RationalScene::addScenePoints() {
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    points_.push_back(lines_[i].a);
    points_.push_back(lines_[i].b);
    for (std::size_t j = 0; j < i; ++j) {
      const RationalPoint e = lines_[i].b - lines_[i].a;
      const RationalPoint f = lines_[j].b - lines_[j].a;
      const Rational denominator = cross(e, f);
      if (denominator == 0) continue;
      const RationalPoint between = lines_[j].a - lines_[i].a;
      const Rational t = cross(between, f) / denominator;
      const Rational s = cross(between, e) / denominator;
      if (isInside(t) && isInside(s)) points_.push_back(lines_[i].a + t * e);
    }
  }
}

std::size_t RationalScene::nearestAlong(const RationalPoint& position, const RationalPoint& direction,
                                        bool& has_tie) const {
  std::size_t nearest = kNothing;
  double radiance = 0.0;
  Rational distance;
  for (const Line& line : lines_) {
    const RationalPoint e = line.b - line.a;
    const RationalPoint r = line.a - position;
    const Rational denominator = cross(direction, e);
    if (denominator == 0) continue;
    const Rational along = cross(r, e) / denominator;
    const Rational t = cross(r, direction) / denominator;
    if (along <= 0 || t < 0 || t > 1) continue;
    if (nearest == kNothing || along < distance) {
      nearest = line.index;
      distance = along;
      radiance = line.radiance;
      has_tie = false;
    } else if (along == distance && line.radiance != radiance) {
      has_tie = true;
    }
  }
  return nearest;
}

std::vector<RationalInterval> RationalScene::pieces(const RationalPoint& position, bool& has_tie) const {
  const RationalPoint start{normal_.y, -normal_.x};
  const RationalPoint stop{-normal_.y, normal_.x};
  std::vector<RationalPoint> directions;
  for (const RationalPoint& point : points_) {
    const RationalPoint r = point - position;
    if (dot(normal_, r) > 0) directions.push_back(evened(r));
  }
  std::sort(directions.begin(), directions.end(),
            [](const RationalPoint& a, const RationalPoint& b) { return cross(a, b) > 0; });
  directions.insert(directions.begin(), start);
  directions.push_back(stop);
  std::vector<RationalInterval> result;
  for (std::size_t k = 0; k + 1 < directions.size(); ++k) {
    const RationalPoint& from = directions[k];
    const RationalPoint& to = directions[k + 1];
    const bool is_half_circle = directions.size() == 2;
    if (!is_half_circle && cross(from, to) == 0) continue;
    bool is_tied = false;
    result.push_back({nearestAlong(position, is_half_circle ? normal_ : from + to, is_tied), from, to});
    has_tie = has_tie || is_tied;
  }
  return result;
}

RationalScene::Sight RationalScene::visible(const RationalPoint& step) const {
  Sight sight{{}, false, this};
  for (const RationalInterval& piece : pieces(position_ + step, sight.has_tie)) {
    if (!sight.intervals.empty() && sight.intervals.back().segment == piece.segment) {
      sight.intervals.back().to = piece.to;
    } else {
      sight.intervals.push_back(piece);
    }
  }
  return sight;
}

ManyDigits RationalScene::Sight::irradiance() const {
  ManyDigits sum = 0;
  const ManyDigits nx(scene->normal_.x);
  const ManyDigits ny(scene->normal_.y);
  for (const RationalInterval& interval : intervals) {
    if (interval.segment == kNothing) continue;
    const auto unit = [](const RationalPoint& v) {
      const ManyDigits x(v.x);
      const ManyDigits y(v.y);
      const ManyDigits length = sqrt(ManyDigits(x * x + y * y));
      return std::array<ManyDigits, 2>{ManyDigits(x / length), ManyDigits(y / length)};
    };
    const std::array<ManyDigits, 2> from = unit(interval.from);
    const std::array<ManyDigits, 2> to = unit(interval.to);
    sum += ManyDigits(scene->radiances_[interval.segment]) * (nx * (to[1] - from[1]) - ny * (to[0] - from[0]));
  }
  return sum;
}

ManyDigits RationalScene::rotationalGradient() const {
  const Rational angle(std::ldexp(1.0, -130));
  const auto turned = [&](const Rational& by) {
    RationalScene scene = *this;
    // Longer than 1 by half the square of the angle, which the difference of two sides does not see.
    scene.normal_ = {normal_.x - by * normal_.y, normal_.y + by * normal_.x};
    return scene.visible().irradiance();
  };
  return (turned(angle) - turned(-angle)) / ManyDigits(2 * angle);
}

double RationalScene::distanceFromEvents() const {
  double smallest = 1e300;
  std::vector<Eigen::Vector2d> points;
  for (const RationalPoint& point : points_) {
    const RationalPoint r = point - position_;
    points.emplace_back(r.x.convert_to<double>(), r.y.convert_to<double>());
    smallest = std::min(smallest, std::abs(dot(normal_, r).convert_to<double>()));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Eigen::Vector2d e = points[i] - points[j];
      if (e.norm() == 0.0) continue;
      smallest = std::min(smallest, std::abs(e(0) * points[j](1) - e(1) * points[j](0)) / e.norm());
    }
  }
  return smallest;
}

}  // namespace irradiff
