#include "derivatives/form_factor/polygon_evaluation.h"

#include "derivatives/boundary/boundary_sums.h"
#include "derivatives/boundary/edge_arcs.h"
#include "derivatives/boundary/tangent_plane.h"
#include "derivatives/form_factor/area_rule.h"
#include "derivatives/scene/coordinate_range.h"
#include "derivatives/scene/invalid_scene.h"
#include "derivatives/scene/triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <sstream>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

using WideScalar = DoubleWord<double>;
using WideVector = Vector3<WideScalar>;

constexpr double kUnitRoundoff = 0x1p-53;
/// Relative error of a double-word sum of products per unit of the fraction that it cancels to
/// (docs/derivations/error_bounds.md, section 1).
constexpr double kWideError = 16.0 * kUnitRoundoff * kUnitRoundoff;
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

[[noreturn]] void reject(const Polygon& polygon, std::size_t index, const Receiver& receiver, const std::string& rule) {
  std::ostringstream text;
  text.precision(17);
  text << describe(polygon, index) << ": the receiver at [" << receiver.position(0) << ", " << receiver.position(1)
       << ", " << receiver.position(2) << "] " << rule;
  throw InvalidScene(text.str());
}

/// The largest coordinate along each axis, if all of them and the normal's components can be computed with.
Vector3<double> largestCoordinates(const Polygon& polygon, std::size_t index, const Receiver& receiver) {
  CoordinateRange coordinates;
  coordinates.include(receiver.position);
  for (const Eigen::Vector3d& vertex : polygon.vertices) {
    coordinates.include(vertex);
  }
  if (const std::string violation = rangeViolation(coordinates, "a vertex", receiver.normal); !violation.empty()) {
    reject(polygon, index, receiver, violation);
  }
  Vector3<double> largest = receiver.position.cwiseAbs();
  for (const Eigen::Vector3d& vertex : polygon.vertices) {
    largest = largest.cwiseMax(vertex.cwiseAbs());
  }
  return largest;
}

/// The polygon and the receiver in units of 2^exponent metres, in which the farthest vertex is between 1/2 and 2 away.
struct ScaledPolygon {
  std::vector<Vector3<double>> vertices;
  Vector3<double> position;
  int exponent;
  Vector3<double> largest_coordinates;  ///< along each axis
};

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
    reject(polygon, index, receiver, "coincides with all of its vertices");
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
      reject(polygon, index, receiver,
             "is at vertices[" + std::to_string(i) + "]; irradiance is not defined on a vertex");
    }
    const WideVector edge = difference(relative[next], relative[i]);
    const Vector3<double> moment = narrow<double>(cross(r0.norm() <= r1.norm() ? relative[i] : relative[next], edge));
    if (moment.norm() <= kSmallestDistance * narrow<double>(edge).norm() && r0.dot(r1) < 0.0) {
      reject(polygon, index, receiver,
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

/// Turns results in scaled units into metres and applies the sign that makes irradiance positive.
void unscale(PolygonEvaluation& evaluation, double sign, int exponent) {
  IrradianceDerivatives<double>& d = evaluation.derivatives;
  d.irradiance.value *= sign;
  if (d.irradiance.value < 0.0) {
    // Irradiance is not negative; setting it to 0 moves it by as much.
    evaluation.bounds.irradiance -= d.irradiance.value;
    d.irradiance.value = 0.0;
  }
  d.rotational_gradient.value *= sign;
  for (int i = 0; i < 3; ++i) {
    d.gradient.value(i) = std::ldexp(sign * d.gradient.value(i), -exponent);
    for (int j = 0; j < 3; ++j) {
      d.hessian.value(i, j) = std::ldexp(sign * d.hessian.value(i, j), -2 * exponent);
    }
  }
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < 2; ++b) {
      d.tangential_hessian.value(a, b) = std::ldexp(sign * d.tangential_hessian.value(a, b), -2 * exponent);
    }
  }
  // Results below the normal range lose digits, and so do terms in scaled units; the smallest subnormal numbers and a
  // number far below every result of ordinary scenes cover that.
  constexpr double kUnderflow = 4.0 * std::numeric_limits<double>::denorm_min();
  constexpr double kScaledUnderflow = 0x1p-1000;
  evaluation.bounds.irradiance += kScaledUnderflow;
  evaluation.bounds.gradient = std::ldexp(evaluation.bounds.gradient + kScaledUnderflow, -exponent) + kUnderflow;
  evaluation.bounds.hessian = std::ldexp(evaluation.bounds.hessian + kScaledUnderflow, -2 * exponent) + kUnderflow;
  evaluation.bounds.tangential_hessian =
      std::ldexp(evaluation.bounds.tangential_hessian + kScaledUnderflow, -2 * exponent) + kUnderflow;
  evaluation.bounds.rotational_gradient += kScaledUnderflow;
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

/// Relative error of what is right in double words only as far as it is not grazing: the height over the polygon's
/// plane, a sine that the whole result may be proportional to, and the direction of a cut, which is right to the
/// farthest vertex's distance only.
double grazingError(const ClippedPolygon<double>& clipped, double sine_to_plane) {
  double nearest_cut = 1.0;
  for (const ClippedVertex<double>& vertex : clipped.vertices) {
    if (clipped.crosses_horizon && vertex.height == 0.0) {
      nearest_cut = std::min(nearest_cut, norm(narrow<double>(vertex.position)));
    }
  }
  return kWideError / std::max(sine_to_plane, kWideError) + kWideError / nearest_cut;
}

/// Triangles for the area rule where the fan would cancel, each cut at the horizon; none where the fan serves: it does
/// too where a triangle is not small itself, which only few and wide ones are not.
std::vector<ClippedPolygon<double>> trianglesInsteadOfFan(const Polygon& polygon, const ScaledPolygon& scaled,
                                                          const ClippedPolygon<double>& clipped,
                                                          const Vector3<double>& normal) {
  if (!isSmallSource(clipped) || !fanOverlaps(clipped)) {
    return {};
  }
  std::vector<ClippedPolygon<double>> pieces;
  for (const auto& [a, b, c] : triangulate(polygon)) {
    const std::array<Vector3<double>, 3> corners{scaled.vertices[a], scaled.vertices[b], scaled.vertices[c]};
    ClippedPolygon<double> piece =
        clipAtHorizon<double>(std::span<const Vector3<double>>(corners), scaled.position, normal);
    if (piece.vertices.empty()) {
      continue;
    }
    if (!isSmallSource(piece)) {
      return {};
    }
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

PolygonEvaluation integrate(const ClippedPolygon<double>& clipped, std::span<const ClippedPolygon<double>> triangles,
                            const Vector3<double>& normal, double sine_to_plane) {
  PolygonEvaluation evaluation;
  evaluation.crosses_horizon = clipped.crosses_horizon;
  const double grazing = grazingError(clipped, sine_to_plane);
  if (const std::optional<AreaRuleSums> area = areaRule(clipped, triangles, normal)) {
    const SmallSourceSums<3>& sums = area->sums;
    const Matrix3<double> symmetric = 0.5 * (sums.hessian + sums.hessian.transpose());
    evaluation.rule = PolygonRule::kArea;
    evaluation.derivatives = {{sums.irradiance},
                              {sums.gradient},
                              {symmetric},
                              {sums.tangential_hessian},
                              {TangentPlane<double>(normal).turned(sums.tangential_irradiance)}};
    const auto relative_error = [&](double constant) {
      return (constant + area->terms) * kUnitRoundoff + area->truncation + grazing;
    };
    const double relative = relative_error(kSmallSourceError);
    const double tangential = relative_error(kSmallSourceTangentialError);
    evaluation.bounds = {relative * sums.irradiance_size, relative * sums.gradient_size, relative * sums.hessian_size,
                         tangential * sums.tangential_hessian_size, tangential * sums.tangential_irradiance_size};
    return evaluation;
  }
  const RadianceBoundary<double> boundary = polygonBoundary(clipped, normal);
  const BoundarySums<double> sums = boundarySums(boundary, normal);
  // Every arc's term rounds the partial sum once more.
  const auto arcs = static_cast<double>(clipped.vertices.size() + boundary.arcs.size());
  const double irradiance_error = (kAngleError + arcs) * kUnitRoundoff + grazing;
  const double derivative_error = (kArcError + arcs) * kUnitRoundoff + grazing;
  evaluation.rule = PolygonRule::kBoundary;
  evaluation.derivatives = sums.derivatives;
  // n x (r x e) has errors of doubled precision that nothing grazing need enlarge (section 2.9 there).
  constexpr double kTurnedWideError = 4.0 * kWideError;
  evaluation.bounds = {irradiance_error * sums.irradiance_size, derivative_error * sums.gradient_size,
                       derivative_error * sums.hessian_size,
                       ((kTangentialError + arcs) * kUnitRoundoff + grazing) * sums.tangential_size +
                           kTurnedWideError * sums.tangential_wide_size,
                       irradiance_error * sums.rotational_size + kTurnedWideError * sums.rotational_wide_size};
  return evaluation;
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

/// A polygon and a receiver, made ready for integration where anything is seen.
struct PreparedPolygon {
  PolygonEvaluation evaluation;  ///< without derivatives
  ScaledPolygon scaled;
  ClippedPolygon<double> clipped;  ///< empty if there is nothing to integrate
  double orientation = 0.0;        ///< > 0 where the vertices run clockwise
  double sine_to_plane = 0.0;
};

PreparedPolygon prepare(const Polygon& polygon, std::size_t index, const Receiver& receiver) {
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
  const auto orientation = static_cast<double>(dot(area, relative[0]));
  const double area_size = narrow<double>(area).stableNorm();
  if (!(area_size >= kSmallestArea)) {
    reject(polygon, index, receiver,
           "is so far that the polygon's area, in units of that distance, vanishes in double");
  }
  if (isCoplanar(relative, area, roundingOfHeight(scaled, narrow<double>(area)))) {
    if (isInside(relative, plane_normal)) {
      if (plane_normal.cross(receiver.normal).norm() > kParallelTolerance) {
        reject(polygon, index, receiver,
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
  if (is_seen && orientation == 0.0) {
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

}  // namespace

PolygonEvaluation classifyPolygon(const Polygon& polygon, std::size_t index, const Receiver& receiver) {
  return prepare(polygon, index, receiver).evaluation;
}

PolygonEvaluation evaluatePolygon(const Polygon& polygon, std::size_t index, const Receiver& receiver) {
  const PreparedPolygon prepared = prepare(polygon, index, receiver);
  const ClippedPolygon<double>& clipped = prepared.clipped;
  if (clipped.vertices.empty()) {
    return prepared.evaluation;
  }
  PolygonEvaluation evaluation =
      integrate(clipped, trianglesInsteadOfFan(polygon, prepared.scaled, clipped, receiver.normal), receiver.normal,
                prepared.sine_to_plane);
  // Near a plane that its vertices leave by rounding, a polygon may show the receiver the other side.
  const double irradiance = evaluation.derivatives.irradiance.value;
  evaluation.is_clockwise =
      std::abs(irradiance) > evaluation.bounds.irradiance ? irradiance > 0.0 : prepared.orientation >= 0.0;
  unscale(evaluation, evaluation.is_clockwise ? 1.0 : -1.0, prepared.scaled.exponent);
  evaluation.no_gradient = prepared.evaluation.no_gradient;
  evaluation.no_hessian = prepared.evaluation.no_hessian;
  if (prepared.evaluation.rule == PolygonRule::kEdgeOn) {
    // What is left in the derivatives are those of the signed form factor, which is smooth here; irradiance is its
    // absolute value.
    evaluation.rule = PolygonRule::kEdgeOn;
    evaluation.derivatives.irradiance.value = 0.0;
    evaluation.bounds.irradiance = 0.0;
    // Whatever its normal, the receiver sees nothing.
    evaluation.derivatives.rotational_gradient.value.setZero();
    evaluation.bounds.rotational_gradient = 0.0;
  }
  const IrradianceDerivatives<double>& d = evaluation.derivatives;
  if (!std::isfinite(d.irradiance.value) || !d.gradient.value.allFinite() || !d.hessian.value.allFinite() ||
      !d.tangential_hessian.value.allFinite() || !d.rotational_gradient.value.allFinite() ||
      !std::isfinite(evaluation.bounds.hessian) || !std::isfinite(evaluation.bounds.tangential_hessian)) {
    reject(polygon, index, receiver,
           "is so close, or the polygon so small, that a derivative exceeds the range of double");
  }
  return evaluation;
}

}  // namespace irradiff
