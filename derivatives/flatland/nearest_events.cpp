#include "derivatives/flatland/nearest_events.h"

#include "derivatives/flatland/segment_evaluation.h"
#include "derivatives/flatland/segment_form.h"
#include "derivatives/flatland/segment_visibility.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace irradiff {
namespace {

constexpr double kUnitRoundoff = 0x1p-53;

/// An end, or where two segments pass through each other.
struct FixedPoint {
  Vector2<double> position;  ///< relative to the receiver
  std::size_t segment;
  std::size_t other;  ///< of a crossing; that of `segment` for an end
  bool is_seen = false;

  bool isOn(std::size_t index) const { return segment == index || other == index; }
};

struct Candidate {
  double distance;
  double rounding;
  Vector2<double> displacement;
  std::size_t first, second;  ///< points, or a segment
};

class EventSearch {
 public:
  EventSearch(std::span<const Segment> segments, const FlatlandReceiver& receiver);

  Nearest<Candidate> pointsInLine(std::size_t count) const;
  Nearest<Candidate> endOn(std::size_t count) const;
  Nearest<Candidate> onHorizon(std::size_t count) const;

  std::string describePoint(std::size_t point) const;
  std::string describeSegment(std::size_t segment) const {
    return "segments[" + std::to_string(segment) + "] \"" + segments_[segment].name + '"';
  }

 private:
  void addCrossing(std::size_t a, std::size_t b);
  void markSeen(const BoundaryPoint& point);

  std::span<const Segment> segments_;
  Vector2<double> normal_;
  double rounding_ = 0.0;  ///< by how far a point may be off for the rounding of its coordinates
  std::vector<std::size_t> considered_;
  std::vector<FixedPoint> points_;
  std::vector<bool> is_seen_;  ///< of each segment
};

EventSearch::EventSearch(std::span<const Segment> segments, const FlatlandReceiver& receiver)
    : segments_(segments), normal_(receiver.normal), is_seen_(segments.size(), false) {
  double largest = receiver.position.cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < segments.size(); ++i) {
    for (const Eigen::Vector2d& end : segments[i].vertices) largest = std::max(largest, end.cwiseAbs().maxCoeff());
    if (evaluateSegment(segments[i], i, receiver).rule != SegmentRule::kOwnSurface) considered_.push_back(i);
  }
  rounding_ = std::sqrt(2.0) * kUnitRoundoff * largest;
  for (const std::size_t i : considered_) {
    for (const Eigen::Vector2d& end : segments[i].vertices) points_.push_back({end - receiver.position, i, i});
  }
  for (std::size_t a = 0; a < considered_.size(); ++a) {
    for (std::size_t b = a + 1; b < considered_.size(); ++b) addCrossing(a, b);
  }
  const SegmentVisibility visibility = visibleParts(segments, considered_, receiver);
  for (const VisiblePart& part : visibility.parts) {
    is_seen_[part.segment] = true;
    markSeen(part.first);
    markSeen(part.last);
  }
  // What is not above the horizon may be seen once it rises.
  for (FixedPoint& point : points_) point.is_seen = point.is_seen || normal_.dot(point.position) <= 0.0;
}

/// Of the segments considered.
void EventSearch::addCrossing(std::size_t a, std::size_t b) {
  const Vector2<double> start = points_[2 * a].position;
  const Vector2<double> edge = points_[2 * a + 1].position - start;
  const Vector2<double> other_start = points_[2 * b].position;
  const Vector2<double> other_edge = points_[2 * b + 1].position - other_start;
  const double turn = cross(edge, other_edge);
  if (turn == 0.0) return;
  const Vector2<double> between = other_start - start;
  const double along = cross(between, other_edge) / turn;
  const double along_other = cross(between, edge) / turn;
  // Where an end lies on the other, the end will do.
  if (!(along > 0.0 && along < 1.0 && along_other > 0.0 && along_other < 1.0)) return;
  points_.push_back({start + along * edge, considered_[a], considered_[b]});
}

void EventSearch::markSeen(const BoundaryPoint& point) {
  for (std::size_t p = 0; p < points_.size(); ++p) {
    FixedPoint& fixed = points_[p];
    if (point.kind == BoundaryPoint::Kind::kEnd) {
      const bool is_end = p < 2 * considered_.size() && fixed.segment == point.segment && p % 2 == point.end;
      if (is_end) fixed.is_seen = true;
    } else if (point.kind == BoundaryPoint::Kind::kCrossing) {
      if (fixed.segment != fixed.other && fixed.isOn(point.segment) && fixed.isOn(point.other)) fixed.is_seen = true;
    }
  }
}

Nearest<Candidate> EventSearch::pointsInLine(std::size_t count) const {
  Nearest<Candidate> nearest(count);
  for (std::size_t n = 0; n < points_.size(); ++n) {
    const FixedPoint& near = points_[n];
    if (!near.is_seen) continue;
    for (std::size_t f = 0; f < points_.size(); ++f) {
      const FixedPoint& far = points_[f];
      // On one segment they are in line where it is seen end-on.
      if (n == f || far.isOn(near.segment) || far.isOn(near.other)) continue;
      const Vector2<double> outward = near.position - far.position;
      const double square = outward.squaredNorm();
      if (square == 0.0) continue;
      // The receiver may move to near + t outward, t >= 0.
      const double t = std::max(0.0, -near.position.dot(outward) / square);
      const double from_line = cross(near.position, outward) / std::sqrt(square);
      const Vector2<double> place =
          t > 0.0 ? Vector2<double>(quarterTurn(outward) * (-from_line / std::sqrt(square))) : near.position;
      nearest.add({t > 0.0 ? std::abs(from_line) : near.position.norm(), 2.0 * (1.0 + t) * rounding_, place, n, f});
    }
  }
  return nearest;
}

Nearest<Candidate> EventSearch::endOn(std::size_t count) const {
  Nearest<Candidate> nearest(count);
  for (std::size_t i = 0; i < considered_.size(); ++i) {
    const Vector2<double>& start = points_[2 * i].position;
    const Vector2<double> edge = points_[2 * i + 1].position - start;
    const double from_line = cross(start, edge) / edge.norm();
    // Exactly end-on it is not seen: the segments before it have been.
    if (!is_seen_[considered_[i]] && from_line != 0.0) continue;
    const double along = -start.dot(edge) / edge.squaredNorm();
    nearest.add({std::abs(from_line), (1.0 + std::abs(along) + std::abs(1.0 - along)) * rounding_,
                 Vector2<double>(quarterTurn(edge) * (-from_line / edge.norm())), considered_[i], 0});
  }
  return nearest;
}

Nearest<Candidate> EventSearch::onHorizon(std::size_t count) const {
  Nearest<Candidate> nearest(count);
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const double height = normal_.dot(points_[p].position) / normal_.norm();
    nearest.add({std::abs(height), 2.0 * rounding_ + 2.0 * kUnitRoundoff * points_[p].position.norm(),
                 Vector2<double>(height * normal_.normalized()), p, 0});
  }
  return nearest;
}

std::string EventSearch::describePoint(std::size_t point) const {
  const FixedPoint& p = points_[point];
  return p.segment == p.other ? "an end of " + describeSegment(p.segment)
                              : "the crossing of " + describeSegment(p.segment) + " and " + describeSegment(p.other);
}

}  // namespace

VisibilityEvents<2> nearestEvents(std::span<const Segment> segments, const FlatlandReceiver& receiver,
                                  std::size_t count) {
  const EventSearch search(segments, receiver);
  VisibilityEvents<2> events;
  const auto addAll = [&](EventKind kind, const Nearest<Candidate>& candidates, const auto& describe) {
    for (const Candidate& c : candidates.items()) {
      events.push_back({kind, true, c.distance, c.rounding, c.displacement, describe(c)});
    }
  };
  addAll(EventKind::kVertexOnEdge, search.pointsInLine(count), [&](const Candidate& c) {
    return search.describePoint(c.first) + " and " + search.describePoint(c.second) + " come into line";
  });
  addAll(EventKind::kEdgeOn, search.endOn(count),
         [&](const Candidate& c) { return search.describeSegment(c.first) + " is seen end-on"; });
  addAll(EventKind::kHorizon, search.onHorizon(count),
         [&](const Candidate& c) { return search.describePoint(c.first) + " reaches the horizon"; });
  std::ranges::stable_sort(events, {}, &VisibilityEvent<2>::distance);
  return events;
}

}  // namespace irradiff
