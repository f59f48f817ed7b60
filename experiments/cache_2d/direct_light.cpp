#include "experiments/cache_2d/direct_light.h"

#include "derivatives/flatland/segment_visibility.h"
#include "experiments/cache_2d/seen_piece.h"
#include "experiments/cache_2d/sight_terms.h"

#include <algorithm>
#include <cmath>

namespace irradiff {
namespace {

/// Events closer than this, as a share of the wall's length, are one.
constexpr double kEventSpacing = 1e-13;

/// Ends of segments and where segments cross, each once, in the frame of a side.
std::vector<Eigen::Vector2d> fixedPoints(std::span<const Segment> segments, const WallSide& side) {
  std::vector<Eigen::Vector2d> points;
  const auto add = [&](const Eigen::Vector2d& position) {
    const Eigen::Vector2d local = side.local(position);
    if (std::ranges::find(points, local) == points.end()) points.push_back(local);
  };
  const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const std::array<Eigen::Vector2d, 2>& a = segments[i].vertices;
    add(a[0]);
    add(a[1]);
    for (std::size_t j = 0; j < i; ++j) {
      const std::array<Eigen::Vector2d, 2>& b = segments[j].vertices;
      const double turn = cross(a[1] - a[0], b[1] - b[0]);
      if (turn == 0.0) continue;
      const double along_a = cross(b[0] - a[0], b[1] - b[0]) / turn;
      const double along_b = cross(b[0] - a[0], a[1] - a[0]) / turn;
      const bool meet = along_a > 0.0 && along_a < 1.0 && along_b > 0.0 && along_b < 1.0;
      if (meet) add(boundaryPosition({BoundaryPoint::Kind::kCrossing, i, 0, j}, segments));
    }
  }
  return points;
}

/// All places inside the wall that are in line with two points before it, and the ends of the wall.
std::vector<double> candidateEvents(std::span<const Segment> segments, const WallSide& side) {
  std::vector<double> events{0.0, side.length};
  const double on_line = kOwnLineTolerance * side.length;
  std::vector<Eigen::Vector2d> points = fixedPoints(segments, side);
  std::erase_if(points, [&](const Eigen::Vector2d& p) { return p.y() < -on_line; });
  const auto add = [&](double along) {
    if (along > 0.0 && along < side.length) events.push_back(along);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].y() <= on_line) add(points[i].x());
    for (std::size_t j = 0; j < i; ++j) {
      const double rise = points[j].y() - points[i].y();
      if (rise != 0.0) add((points[i].x() * points[j].y() - points[j].x() * points[i].y()) / rise);
    }
  }
  std::ranges::sort(events);
  std::vector<double> apart{0.0};
  for (const double event : events) {
    if (event - apart.back() > kEventSpacing * side.length) apart.push_back(event);
  }
  apart.back() = side.length;
  return apart;
}

}  // namespace

DirectLight::DirectLight(std::span<const Segment> segments, std::span<const double> emissions, const WallSide& side) {
  const std::vector<std::size_t> considered = segmentsOffLine(segments, side);
  const std::vector<double> events = candidateEvents(segments, side);
  const double on_line = kOwnLineTolerance * side.length;
  for (std::size_t i = 0; i + 1 < events.size(); ++i) {
    const double middle = 0.5 * (events[i] + events[i + 1]);
    const FlatlandReceiver receiver{side.point(middle), side.normal};
    Piece piece;
    for (const VisiblePart& part : visibleParts(segments, considered, receiver).parts) {
      const double emission = emissions[part.segment];
      if (emission == 0.0) continue;
      for (const bool is_last : {false, true}) {
        const BoundaryPoint& point = is_last ? part.last : part.first;
        if (point.kind == BoundaryPoint::Kind::kHorizon) {
          piece.constant += emission;
        } else {
          const Eigen::Vector2d local = side.local(boundaryPosition(point, segments));
          const double weight = is_last ? emission : -emission;
          if (std::abs(local.y()) <= on_line) {
            // On the wall's own line S is -1 or 1, up to the point itself.
            piece.constant += local.x() < middle ? weight : -weight;
          } else {
            piece.points.push_back({weight, local.x(), local.y()});
          }
        }
      }
    }
    if (!pieces_.empty() && pieces_.back() == piece) continue;
    borders_.push_back(events[i]);
    pieces_.push_back(std::move(piece));
  }
  borders_.push_back(side.length);
}

DirectLight::Value DirectLight::at(std::size_t piece, double along) const {
  Value value{pieces_[piece].constant, 0.0};
  for (const LightPoint& point : pieces_[piece].points) {
    const double x = point.along - along;
    const double square = x * x + point.height * point.height;
    const double inverse = 1.0 / std::sqrt(square);
    value.irradiance -= point.weight * x * inverse;
    value.slope += point.weight * point.height * point.height / square * inverse;
  }
  return value;
}

std::size_t DirectLight::pieceAt(double along) const {
  const auto after = std::upper_bound(borders_.begin() + 1, borders_.end() - 1, along);
  return static_cast<std::size_t>(after - borders_.begin()) - 1;
}

double DirectLight::brightest() const {
  double most = 0.0;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    most = std::max(most, at(i, 0.5 * (borders_[i] + borders_[i + 1])).irradiance);
  }
  return most;
}

}  // namespace irradiff
