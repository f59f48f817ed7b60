#include "derivatives/form_factor/prepared_polygon.h"

#include "derivatives/boundary/horizon_height.h"
#include "derivatives/scene/coordinate_range.h"
#include "derivatives/scene/exact_number.h"
#include "derivatives/scene/invalid_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <sstream>
#include <utility>

namespace irradiff {
namespace {

using WideScalar = DoubleWord<double>;
using WideVector = Vector3<WideScalar>;

/// A receiver this close to a polygon's plane, relative to the coordinates along its normal, may lie in it but for
/// their rounding.
constexpr double kCoplanarTolerance = 0x1p-50;
/// The least distance from a vertex or an edge and the least area vector, the farthest vertex being about 1 away: below
/// them products of coordinates in doubled precision leave the range of double.
constexpr double kSmallestDistance = 0x1p-250;
constexpr double kSmallestArea = 0x1p-600;
/// Sine of the angle between the receiver's normal and that of the surface it lies on.
constexpr double kParallelTolerance = 1e-8;

std::string describe(const Polygon& polygon, std::size_t index) {
  std::ostringstream text;
  text << "polygons[" << index << "] \"" << polygon.name << '"';
  return text.str();
}

/// The largest coordinate along each axis, if all of them and the normal's components can be computed with.
Vector3<double> largestCoordinates(const Polygon& polygon, std::size_t index, const Receiver& receiver) {
  CoordinateRange coordinates;
  coordinates.include(receiver.position);
  for (const Eigen::Vector3d& vertex : polygon.vertices) {
    coordinates.include(vertex);
  }
  if (const std::string violation = rangeViolation(coordinates, "a vertex", receiver.normal); !violation.empty()) {
    rejectReceiver(polygon, index, receiver, violation);
  }
  Vector3<double> largest = receiver.position.cwiseAbs();
  for (const Eigen::Vector3d& vertex : polygon.vertices) {
    largest = largest.cwiseMax(vertex.cwiseAbs());
  }
  return largest;
}

ScaledPolygon scaleToUnit(const Polygon& polygon, std::size_t index, const Receiver& receiver) {
  const Vector3<double> largest_coordinates = largestCoordinates(polygon, index, receiver);
  const double largest = largest_coordinates.maxCoeff();
  const int coarse = largest > 0.0 ? std::ilogb(largest) + 2 : 0;
  double farthest = 0.0;
  for (const Eigen::Vector3d& vertex : polygon.vertices) {
    for (int i = 0; i < 3; ++i) {
      farthest =
          std::max(farthest, std::abs(std::ldexp(vertex(i), -coarse) - std::ldexp(receiver.position(i), -coarse)));
    }
  }
  if (farthest == 0.0) {
    rejectReceiver(polygon, index, receiver, "coincides with all of its vertices");
  }
  ScaledPolygon scaled{{}, {}, coarse + std::ilogb(farthest) + 1, {}};
  const auto shrink = [&scaled](const Eigen::Vector3d& point) {
    return Vector3<double>(std::ldexp(point(0), -scaled.exponent), std::ldexp(point(1), -scaled.exponent),
                           std::ldexp(point(2), -scaled.exponent));
  };
  for (const Eigen::Vector3d& vertex : polygon.vertices) {
    scaled.vertices.push_back(shrink(vertex));
  }
  scaled.position = shrink(receiver.position);
  scaled.largest_coordinates = shrink(largest_coordinates);
  return scaled;
}

void rejectReceiverOnBoundary(const std::vector<WideVector>& relative, const Polygon& polygon, std::size_t index,
                              const Receiver& receiver) {
  for (std::size_t i = 0; i < relative.size(); ++i) {
    const std::size_t next = (i + 1) % relative.size();
    const Vector3<double> r0 = narrow<double>(relative[i]);
    const Vector3<double> r1 = narrow<double>(relative[next]);
    if (r0.norm() <= kSmallestDistance) {
      rejectReceiver(polygon, index, receiver,
                     "is at vertices[" + std::to_string(i) + "]; irradiance is not defined on a vertex");
    }
    const WideVector edge = difference(relative[next], relative[i]);
    const Vector3<double> moment = narrow<double>(cross(r0.norm() <= r1.norm() ? relative[i] : relative[next], edge));
    if (moment.norm() <= kSmallestDistance * narrow<double>(edge).norm() && r0.dot(r1) < 0.0) {
      rejectReceiver(polygon, index, receiver,
                     "is on the edge from vertices[" + std::to_string(i) + "]; irradiance is not defined on an edge");
    }
  }
}

/// Twice the polygon's area times its normal, by the fan at its first vertex.
WideVector areaVector(const std::vector<WideVector>& relative) {
  WideVector sum = WideVector::Constant(WideScalar(0.0));
  for (std::size_t i = 1; i + 1 < relative.size(); ++i) {
    const WideVector part = cross(difference(relative[i], relative[0]), difference(relative[i + 1], relative[0]));
    for (int k = 0; k < 3; ++k) {
      sum(k) = sum(k) + part(k);
    }
  }
  return sum;
}

/// What the rounding of coordinates may make of a height along `normal`, times the normal's length.
double roundingOfHeight(const ScaledPolygon& scaled, const Vector3<double>& normal) {
  return kCoplanarTolerance * normal.cwiseAbs().dot(scaled.largest_coordinates);
}

/// Whether the receiver lies within `limit`, a distance times the area, of the polygon's plane or, where its vertices
/// leave that plane, between them.
bool isCoplanar(const std::vector<WideVector>& relative, const WideVector& area, double limit) {
  bool any_below = false;
  bool any_above = false;
  for (const WideVector& vertex : relative) {
    const auto height = static_cast<double>(dot(area, vertex));
    any_below = any_below || height <= limit;
    any_above = any_above || height >= -limit;
  }
  return any_below && any_above;
}

/// Whether every vertex is on the horizon to within kParallelTolerance (a sine) and `tolerance` (a height).
bool liesOnHorizon(const std::vector<WideVector>& relative, const Vector3<double>& normal, double tolerance) {
  const WideVector wide_normal = widen<WideScalar>(normal);
  return std::all_of(relative.begin(), relative.end(), [&](const WideVector& vertex) {
    const auto height = static_cast<double>(dot(wide_normal, vertex));
    return std::abs(height) <= kParallelTolerance * norm(narrow<double>(vertex)) + tolerance;
  });
}

/// Whether the receiver, taken to lie in the polygon's plane with this unit normal, is inside the polygon: its winding
/// number is not 0.
bool isInside(const std::vector<WideVector>& relative, const Vector3<double>& plane_normal) {
  double turn = 0.0;
  for (std::size_t i = 0; i < relative.size(); ++i) {
    const Vector3<double> r0 = narrow<double>(relative[i]);
    const Vector3<double> r1 = narrow<double>(relative[(i + 1) % relative.size()]);
    turn += std::atan2(plane_normal.dot(r0.cross(r1)), r0.dot(r1));
  }
  return std::abs(turn) > std::numbers::pi;
}

PolygonEvaluation nothing(PolygonRule rule, bool crosses_horizon) {
  PolygonEvaluation evaluation;
  evaluation.derivatives = {{0.0},
                            {Vector3<double>::Zero()},
                            {Matrix3<double>::Zero()},
                            {Matrix2<double>::Zero()},
                            {Vector3<double>::Zero()}};
  evaluation.rule = rule;
  evaluation.crosses_horizon = crosses_horizon;
  return evaluation;
}

/// Whether the receiver lies in the plane of every triangle of the fan at the first vertex, to the last bit: then
/// nothing of the polygon is seen, whatever its normal.
bool isSeenEdgeOn(const ScaledPolygon& scaled) {
  using ExactVector = std::array<ExactNumber, 3>;
  const auto relative = [&scaled](std::size_t vertex) {
    ExactVector r;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      r[i] = ExactNumber(scaled.vertices[vertex](axis)) - ExactNumber(scaled.position(axis));
    }
    return r;
  };
  const ExactVector a = relative(0);
  for (std::size_t k = 1; k + 1 < scaled.vertices.size(); ++k) {
    const ExactVector b = relative(k);
    const ExactVector c = relative(k + 1);
    const ExactNumber volume =
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    if (volume.sign() != 0) return false;
  }
  return true;
}

/// Whether an edge lies on the receiver's horizon to the last bit. What it bounds appears or disappears as the receiver
/// crosses that plane.
bool hasEdgeOnHorizon(const ScaledPolygon& scaled, const Vector3<double>& normal) {
  const std::vector<Vector3<double>>& vertices = scaled.vertices;
  const auto is_on_horizon = [&](const Vector3<double>& vertex) {
    return horizonHeight<WideScalar>(vertex, scaled.position, normal).hi == 0.0;
  };
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (is_on_horizon(vertices[i]) && is_on_horizon(vertices[(i + 1) % vertices.size()])) {
      return true;
    }
  }
  return false;
}

}  // namespace

void rejectReceiver(const Polygon& polygon, std::size_t index, const Receiver& receiver, const std::string& rule) {
  std::ostringstream text;
  text.precision(17);
  text << describe(polygon, index) << ": the receiver at [" << receiver.position(0) << ", " << receiver.position(1)
       << ", " << receiver.position(2) << "] " << rule;
  throw InvalidScene(text.str());
}

PreparedPolygon preparePolygon(const Polygon& polygon, std::size_t index, const Receiver& receiver) {
  PreparedPolygon prepared;
  prepared.scaled = scaleToUnit(polygon, index, receiver);
  const ScaledPolygon& scaled = prepared.scaled;
  std::vector<WideVector> relative;
  for (const Vector3<double>& vertex : scaled.vertices) {
    relative.push_back(wideDifference<WideScalar>(vertex, scaled.position));
  }
  rejectReceiverOnBoundary(relative, polygon, index, receiver);

  const WideVector area = areaVector(relative);
  const Vector3<double> plane_normal = narrow<double>(area).stableNormalized();
  // By the nearest vertex: the area, rounded, may have nothing left of it, and the others' products are lost in it.
  const WideVector& nearest = *std::min_element(
      relative.begin(), relative.end(),
      [](const WideVector& a, const WideVector& b) { return norm(narrow<double>(a)) < norm(narrow<double>(b)); });
  const auto orientation = static_cast<double>(dot(area, nearest));
  const double area_size = narrow<double>(area).stableNorm();
  if (!(area_size >= kSmallestArea)) {
    rejectReceiver(polygon, index, receiver,
                   "is so far that the polygon's area, in units of that distance, vanishes in double");
  }
  if (isCoplanar(relative, area, roundingOfHeight(scaled, narrow<double>(area)))) {
    if (isInside(relative, plane_normal)) {
      if (plane_normal.cross(receiver.normal).norm() > kParallelTolerance) {
        rejectReceiver(
            polygon, index, receiver,
            "is inside it, but its normal is not the polygon's; a receiver on a surface must face away from it");
      }
      prepared.evaluation = nothing(PolygonRule::kOwnSurface, false);
      return prepared;
    }
    // A neighbour in the receiver's own surface: rounding decides which of its vertices rise above the horizon, and the
    // cuts between them might surround the receiver.
    if (liesOnHorizon(relative, receiver.normal, roundingOfHeight(scaled, receiver.normal))) {
      prepared.evaluation = nothing(PolygonRule::kBelowHorizon, false);
      prepared.evaluation.no_hessian =
          describe(polygon, index) +
          " lies on the receiver's horizon: the second derivative along the normal is one-sided";
      return prepared;
    }
  }

  prepared.clipped =
      clipAtHorizon<double>(std::span<const Vector3<double>>(scaled.vertices), scaled.position, receiver.normal);
  const bool is_seen = !prepared.clipped.vertices.empty();
  prepared.evaluation =
      nothing(is_seen ? PolygonRule::kBoundary : PolygonRule::kBelowHorizon, prepared.clipped.crosses_horizon);
  // Beyond, the sign of the doubled product is certain.
  constexpr double kUncertainSine = 0x1p-90;
  const double orientation_size = area_size * norm(narrow<double>(nearest));
  if (is_seen && std::abs(orientation) <= kUncertainSine * orientation_size && isSeenEdgeOn(scaled)) {
    prepared.evaluation.rule = PolygonRule::kEdgeOn;
    prepared.evaluation.no_gradient = describe(polygon, index) + " is seen edge-on: the receiver lies in its plane";
    prepared.evaluation.no_hessian = prepared.evaluation.no_gradient;
  } else if (hasEdgeOnHorizon(scaled, receiver.normal)) {
    prepared.evaluation.no_hessian =
        describe(polygon, index) +
        " has an edge on the receiver's horizon: the second derivative along the normal is one-sided";
  }
  if (is_seen) {
    prepared.orientation = orientation;
    prepared.sine_to_plane =
        std::abs(orientation) / (area_size * norm(narrow<double>(prepared.clipped.vertices.front().position)));
  }
  return prepared;
}

}  // namespace irradiff
