#include "tests/visibility/slice_integral.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// What a half plane cuts out of a polygon, as (distance from the axis, height), both >= 0; the lower zenith first.
struct Segment {
  Vector2d from;
  Vector2d to;
  std::size_t polygon;
  std::array<std::size_t, 2> edges;  ///< that are cut
};

/// A piece that is seen in a half plane, and how it ends at both sides: with its segment or before.
struct SeenPiece {
  std::size_t polygon;
  std::array<std::size_t, 2> edges;
  bool begins_at_end;
  bool ends_at_end;
  bool is_cut_off;  ///< by the horizon

  bool operator==(const SeenPiece&) const = default;
};

/// The integral of L sin cos over the zenith angle in one half plane, and what is seen in it.
struct Slice {
  double value = 0.0;
  std::vector<SeenPiece> seen;
};

struct Panel {
  double integral;
  bool is_smooth;  ///< the same is seen in all its slices
};

double zenith(const Vector2d& p) { return std::atan2(p(0), p(1)); }

double cross(const Vector2d& a, const Vector2d& b) { return a(0) * b(1) - a(1) * b(0); }

/// The part of a segment at which the coordinate `axis` is >= 0.
std::optional<Segment> clipped(Segment s, int axis) {
  if (s.from(axis) < 0.0 && s.to(axis) < 0.0) return std::nullopt;
  const auto clip = [axis](Vector2d& end, const Vector2d& other) {
    if (end(axis) >= 0.0) return;
    end += end(axis) / (end(axis) - other(axis)) * (other - end);
    end(axis) = 0.0;
  };
  clip(s.from, s.to);
  clip(s.to, s.from);
  return s;
}

/// Wider ones may hide between their slices what is seen in a narrow range of azimuths.
constexpr double kWidestPanel = 0.03;
constexpr double kNarrowestPanel = 1e-11;
/// Polygons that lie over each other flicker in every panel.
constexpr int kMostBisections = 20000;
/// Rounding of zenith angles.
constexpr double kNarrowestGap = 1e-13;

class SliceIntegrator {
 public:
  SliceIntegrator(std::span<const Polygon> scene, const Receiver& receiver, double tolerance) : tolerance_(tolerance) {
    const Vector3d& normal = receiver.normal;
    const Vector3d first = normal.unitOrthogonal();
    const Vector3d second = normal.cross(first);
    for (const Polygon& polygon : scene) {
      std::vector<Vector3d>& loop = loops_.emplace_back();
      for (const Vector3d& vertex : polygon.vertices) {
        const Vector3d r = vertex - receiver.position;
        loop.emplace_back(first.dot(r), second.dot(r), normal.dot(r));
        // What is seen changes at vertices, if not only there.
        azimuths_.push_back(std::atan2(loop.back()(1), loop.back()(0)));
      }
      radiances_.push_back(polygon.radiance);
    }
    azimuths_.push_back(-std::numbers::pi);
    azimuths_.push_back(std::numbers::pi);
    std::ranges::sort(azimuths_);
  }

  SliceIntegral integrate() {
    for (std::size_t i = 0; i + 1 < azimuths_.size(); ++i) {
      const double from = azimuths_[i];
      const double to = azimuths_[i + 1];
      if (to > from) bisect(from, to, panel(from, to));
    }
    return result_;
  }

 private:
  void bisect(double from, double to, const Panel& whole) {
    const double middle = 0.5 * (from + to);
    const Panel lower = panel(from, middle);
    const Panel upper = panel(middle, to);
    const double difference = std::abs(lower.integral + upper.integral - whole.integral);
    const bool is_smooth = whole.is_smooth && lower.is_smooth && upper.is_smooth;
    if (is_smooth && to - from < kWidestPanel && difference < tolerance_ * (to - from)) {
      result_.irradiance += lower.integral + upper.integral;
      result_.error += difference;
    } else if (to - from < kNarrowestPanel || ++bisections_ > kMostBisections) {
      // Whatever is seen, a slice is at most half the radiance.
      result_.irradiance += lower.integral + upper.integral;
      result_.error += 0.5 * (to - from) * std::ranges::max(radiances_);
    } else {
      bisect(from, middle, lower);
      bisect(middle, to, upper);
    }
  }

  /// Gauss-Legendre with five nodes, and a look at both ends.
  Panel panel(double from, double to) const {
    constexpr std::array<double, 5> kNodes{-0.90617984593866399, -0.53846931010568309, 0.0, 0.53846931010568309,
                                           0.90617984593866399};
    constexpr std::array<double, 5> kWeights{0.23692688505618909, 0.47862867049936647, 0.56888888888888889,
                                             0.47862867049936647, 0.23692688505618909};
    constexpr double kInside = 1.0 - 1e-9;
    const double middle = 0.5 * (from + to);
    const double half = 0.5 * (to - from);
    const Slice first = slice(middle - kInside * half);
    Panel result{0.0, first.seen == slice(middle + kInside * half).seen};
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
      const Slice at_node = slice(middle + half * kNodes[i]);
      result.integral += half * kWeights[i] * at_node.value;
      result.is_smooth = result.is_smooth && at_node.seen == first.seen;
    }
    return result;
  }

  Slice slice(double azimuth) const {
    const std::vector<Segment> segments = segmentsAt(azimuth);
    std::vector<double> angles;
    for (const Segment& s : segments) {
      angles.push_back(zenith(s.from));
      angles.push_back(zenith(s.to));
      for (const Segment& other : segments) {
        const Vector2d along = s.to - s.from;
        const double determinant = cross(along, other.to - other.from);
        if (determinant == 0.0) continue;
        const Vector2d meeting = s.from + cross(other.from - s.from, other.to - other.from) / determinant * along;
        if (meeting(0) >= 0.0 && meeting(1) >= 0.0) angles.push_back(zenith(meeting));
      }
    }
    std::ranges::sort(angles);
    Slice result;
    const Segment* previous = nullptr;
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
      if (angles[i + 1] - angles[i] < kNarrowestGap) continue;
      const Segment* nearest = nearestAt(segments, 0.5 * (angles[i] + angles[i + 1]));
      if (nearest == nullptr) {
        previous = nullptr;
        continue;
      }
      const double low = std::sin(angles[i]);
      const double high = std::sin(angles[i + 1]);
      result.value += 0.5 * (high - low) * (high + low) * radiances_[nearest->polygon];
      const bool ends_at_end = angles[i + 1] > zenith(nearest->to) - kNarrowestGap;
      if (nearest == previous) {
        result.seen.back().ends_at_end = ends_at_end;
      } else {
        const bool begins_at_end = angles[i] < zenith(nearest->from) + kNarrowestGap;
        result.seen.push_back({nearest->polygon, nearest->edges, begins_at_end, ends_at_end, nearest->to(1) == 0.0});
      }
      previous = nearest;
    }
    return result;
  }

  static const Segment* nearestAt(const std::vector<Segment>& segments, double angle) {
    const Vector2d direction(std::sin(angle), std::cos(angle));
    double least = std::numeric_limits<double>::infinity();
    const Segment* nearest = nullptr;
    for (const Segment& s : segments) {
      if (angle < zenith(s.from) || angle > zenith(s.to)) continue;
      const Vector2d along = s.to - s.from;
      const double distance = cross(s.from, along) / cross(direction, along);
      if (distance < least) {
        least = distance;
        nearest = &s;
      }
    }
    return nearest;
  }

  /// Where the half plane's whole plane cuts an edge.
  struct Cut {
    Vector2d place;
    std::size_t edge;
  };

  std::vector<Segment> segmentsAt(double azimuth) const {
    const Vector3d out(std::cos(azimuth), std::sin(azimuth), 0.0);
    const Vector3d across(-out(1), out(0), 0.0);
    std::vector<Segment> segments;
    for (std::size_t p = 0; p < loops_.size(); ++p) {
      const std::vector<Vector3d>& loop = loops_[p];
      std::vector<Cut> cuts;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vector3d& a = loop[i];
        const Vector3d& b = loop[(i + 1) % loop.size()];
        const double side_a = across.dot(a);
        const double side_b = across.dot(b);
        if ((side_a < 0.0) == (side_b < 0.0)) continue;
        const Vector3d cut = a + side_a / (side_a - side_b) * (b - a);
        cuts.push_back({{out.dot(cut), cut(2)}, i});
      }
      if (cuts.empty()) continue;
      // Along the line in which the half plane meets the polygon's; every second piece of it is inside.
      const Vector2d origin = cuts.front().place;
      const auto farthest = std::ranges::max_element(cuts, {}, [&](const Cut& c) { return (c.place - origin).norm(); });
      const Vector2d along = farthest->place - origin;
      std::ranges::sort(cuts, {}, [&](const Cut& c) { return along.dot(c.place); });
      for (std::size_t i = 0; i + 1 < cuts.size(); i += 2) {
        const auto [first_edge, last_edge] = std::minmax(cuts[i].edge, cuts[i + 1].edge);
        std::optional<Segment> s = clipped({cuts[i].place, cuts[i + 1].place, p, {first_edge, last_edge}}, 0);
        if (s) s = clipped(*s, 1);
        if (!s) continue;
        if (zenith(s->from) > zenith(s->to)) std::swap(s->from, s->to);
        if (zenith(s->from) < zenith(s->to)) segments.push_back(*s);
      }
    }
    return segments;
  }

  double tolerance_;
  std::vector<std::vector<Vector3d>> loops_;  ///< relative to the receiver, heights along its normal
  std::vector<double> radiances_;
  std::vector<double> azimuths_;
  SliceIntegral result_{0.0, 0.0};
  int bisections_ = 0;
};

}  // namespace

SliceIntegral irradianceBySlices(std::span<const Polygon> scene, const Receiver& receiver, double tolerance) {
  return SliceIntegrator(scene, receiver, tolerance).integrate();
}

}  // namespace irradiff
