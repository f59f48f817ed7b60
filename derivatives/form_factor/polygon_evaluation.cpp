#include "derivatives/form_factor/polygon_evaluation.h"

#include "derivatives/boundary/boundary_sums.h"
#include "derivatives/boundary/edge_arcs.h"
#include "derivatives/boundary/tangent_plane.h"
#include "derivatives/form_factor/area_rule.h"
#include "derivatives/form_factor/prepared_polygon.h"
#include "derivatives/scene/triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
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

}  // namespace

PolygonEvaluation classifyPolygon(const Polygon& polygon, std::size_t index, const Receiver& receiver) {
  return preparePolygon(polygon, index, receiver).evaluation;
}

PolygonEvaluation evaluatePolygon(const Polygon& polygon, std::size_t index, const Receiver& receiver) {
  const PreparedPolygon prepared = preparePolygon(polygon, index, receiver);
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
    rejectReceiver(polygon, index, receiver,
                   "is so close, or the polygon so small, that a derivative exceeds the range of double");
  }
  return evaluation;
}

}  // namespace irradiff
