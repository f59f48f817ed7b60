#include "derivatives/form_factor/plain_view.h"

#include "derivatives/boundary/horizon_height.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace irradiff {
namespace {

/// A polygon this far below the horizon is not what the receiver stands on.
constexpr double kClearlyBelow = 0x1p-6;
/// Scales beyond 2^(+-kLargestExponent) are left to evaluatePolygon: their squares must stay normal numbers.
constexpr int kLargestExponent = 500;

int exponentOf(double positive) {
  return static_cast<int>((std::bit_cast<std::uint64_t>(positive) >> 52U) & 0x7FFU) - 1022;
}

/// 2^exponent, |exponent| <= kLargestExponent.
double powerOfTwo(int exponent) { return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52U); }

using VisiblePoints = std::array<Vector3<double>, 2 * kMostPlainVertices>;

/// The vertices of what is above the horizon, cuts to plain double.
std::size_t visiblePoints(const PlainView& view, VisiblePoints& points) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < view.count; ++i) {
    const PlainVertex& a = view.vertices[i];
    const PlainVertex& b = view.vertices[view.next(i)];
    if (a.height > 0.0) {
      points[count++] = a.position;
    }
    if ((a.height > 0.0) != (b.height > 0.0)) {
      const double fraction = a.height / (a.height - b.height);
      points[count++] = a.position + fraction * (b.position - a.position);
    }
  }
  return count;
}

void measure(PlainView& view) {
  VisiblePoints points;
  view.visible_count = visiblePoints(view, points);
  Vector3<double> mean = Vector3<double>::Zero();
  view.highest_cosine = 0.0;
  for (std::size_t i = 0; i < view.visible_count; ++i) {
    mean += points[i];
  }
  for (std::size_t i = 0; i < view.count; ++i) {
    view.highest_cosine = std::max(view.highest_cosine, view.vertices[i].cosine);
  }
  mean *= 1.0 / static_cast<double>(view.visible_count);
  double farthest = 0.0;
  Vector3<double> area = Vector3<double>::Zero();
  Vector3<double> previous = points[view.visible_count - 1] - mean;
  for (std::size_t i = 0; i < view.visible_count; ++i) {
    const Vector3<double> from_mean = points[i] - mean;
    farthest = std::max(farthest, dot(from_mean, from_mean));
    area += cross<double>(previous, from_mean);
    previous = from_mean;
  }
  const double mean_square = dot(mean, mean);
  const double area_size = norm(area);
  // Positions and mean are rounded, and cuts moved by at most 2^-30 of what is seen of their edges.
  constexpr double kSlack = 1.001;
  constexpr double kRounding = 0x1p-48;
  view.extent = kSlack * std::sqrt(farthest / mean_square) + kRounding;
  view.thinness = area_size / farthest;
  view.sine_to_plane = std::abs(dot(area, mean)) / (area_size * std::sqrt(mean_square));
}

}  // namespace

void lookPlainly(const Polygon& polygon, const Receiver& receiver, double low_sine, PlainView& view) {
  view.horizon = PlainView::Horizon::kUndecided;
  view.count = polygon.vertices.size();
  if (view.count > kMostPlainVertices) {
    return;
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < view.count; ++i) {
    view.vertices[i].position = polygon.vertices[i] - receiver.position;
    for (int k = 0; k < 3; ++k) {
      largest = std::max(largest, std::abs(view.vertices[i].position(k)));
    }
  }
  view.exponent = exponentOf(largest);
  if (!(std::abs(view.exponent) <= kLargestExponent)) {
    return;
  }
  view.scale = powerOfTwo(-view.exponent);
  const Vector3<double>& normal = receiver.normal;
  std::size_t above = 0;
  double least_sine = 1.0;
  for (std::size_t i = 0; i < view.count; ++i) {
    PlainVertex& vertex = view.vertices[i];
    vertex.position *= view.scale;
    const double distance = norm(vertex.position);
    if (!(distance > 0.0)) {
      return;
    }
    vertex.inverse_distance = 1.0 / distance;
    vertex.height = dot(normal, vertex.position);
    vertex.cosine = vertex.height * vertex.inverse_distance;
    if (std::abs(vertex.cosine) < low_sine) {
      vertex.height = view.scale * horizonHeight<DoubleWord<double>>(polygon.vertices[i], receiver.position, normal).hi;
      vertex.cosine = vertex.height * vertex.inverse_distance;
      if (vertex.height == 0.0) {
        return;
      }
    } else {
      least_sine = std::min(least_sine, std::abs(vertex.cosine));
    }
    above += vertex.height > 0.0 ? 1 : 0;
  }
  view.height_error = 5.0 / least_sine;
  view.horizon = above == view.count ? PlainView::Horizon::kAbove : PlainView::Horizon::kCrosses;
  if (above == 0) {
    // Where the receiver is in the polygon's own plane, what it sees is decided by evaluatePolygon.
    const bool is_clear = std::all_of(view.vertices.begin(), view.vertices.begin() + static_cast<long>(view.count),
                                      [](const PlainVertex& vertex) { return vertex.cosine <= -kClearlyBelow; });
    view.horizon = is_clear ? PlainView::Horizon::kBelow : PlainView::Horizon::kUndecided;
    return;
  }
  measure(view);
}

}  // namespace irradiff
