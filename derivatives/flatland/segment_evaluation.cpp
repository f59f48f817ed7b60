#include "derivatives/flatland/segment_evaluation.h"

#include "derivatives/boundary/small_source.h"
#include "derivatives/flatland/segment_form.h"
#include "derivatives/scene/coordinate_range.h"
#include "derivatives/scene/invalid_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace irradiff {
namespace {

using WideVector2 = Vector2<DoubleWord<double>>;

/// Roundings in the terms of one end, in units of u times their size (docs/derivations/error_bounds.md, section 4).
constexpr double kEndError = 24.0;
/// The same in those of the tangential Hessian and of the rotational gradient.
constexpr double kTangentialEndError = 40.0;
/// As for polygons: what rounding of coordinates may leave of a receiver that lies on its own surface.
constexpr double kCollinearTolerance = 0x1p-50;
constexpr double kParallelTolerance = 1e-8;

std::string describe(const Segment& segment, std::size_t index) {
  std::ostringstream text;
  text << "segments[" << index << "] \"" << segment.name << '"';
  return text.str();
}

[[noreturn]] void reject(const Segment& segment, std::size_t index, const FlatlandReceiver& receiver,
                         const std::string& rule) {
  std::ostringstream text;
  text.precision(17);
  text << describe(segment, index) << ": the receiver at [" << receiver.position(0) << ", " << receiver.position(1)
       << "] " << rule;
  throw InvalidScene(text.str());
}

SegmentEvaluation nothing(SegmentRule rule, bool crosses_horizon) {
  SegmentEvaluation evaluation;
  evaluation.rule = rule;
  evaluation.derivatives.irradiance.value = 0.0;
  evaluation.derivatives.gradient.value.setZero();
  evaluation.derivatives.hessian.value.setZero();
  evaluation.derivatives.tangential_hessian.value.setZero();
  evaluation.derivatives.rotational_gradient.value.setZero();
  evaluation.crosses_horizon = crosses_horizon;
  return evaluation;
}

/// The defining integral along the segment, and minus what a cut at the horizon would add if it were a fixed end.
SmallSourceSums<2> lengthRule(const ClippedSegment<double>& segment, const Vector2<double>& normal,
                              const GaussLegendreRule& rule) {
  const WideVector2 wide_edge = difference(segment.last, segment.first);
  const Vector2<double> edge = narrow<double>(wide_edge);
  const Vector2<double> r = narrow<double>(segment.first);
  const Vector2<double> element(edge(1), -edge(0));
  const auto offset = static_cast<double>(cross(segment.first, wide_edge));
  using Tangential = SmallSourceSums<2>::Tangential;
  using InTangentPlane = SmallSourceSums<2>::InTangentPlane;
  const double inverse_length = 1.0 / norm(normal);
  const double r_tangential = alongTangent<double>(segment.first, normal);
  const double edge_tangential = alongTangent<double>(wide_edge, normal);
  const double r_size = std::abs(r_tangential) + kWideSlack * norm(r);
  const double edge_size = std::abs(edge_tangential) + kWideSlack * norm(edge);
  // (J n).(-J e) = -n.e
  const auto element_tangential = -static_cast<double>(dot(widen<DoubleWord<double>>(normal), wide_edge));
  const double element_size = std::abs(element_tangential) + kWideSlack * norm(edge);
  SmallSourceSums<2> sums;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double t = rule.nodes[i];
    const double weight = rule.weights[i];
    const double height = (1.0 - t) * segment.first_height + t * segment.last_height;
    const InTangentPlane p_tangential{Tangential((r_tangential + t * edge_tangential) * inverse_length),
                                      r_size + t * edge_size};
    const InTangentPlane weighted_element{Tangential(weight * element_tangential * inverse_length),
                                          weight * element_size};
    sums.add(r + t * edge, p_tangential, height, weight * offset, weight * element, weighted_element,
             weight * element.norm(), 0.0, normal);
  }
  for (const auto& [position, height, sign] :
       {std::tuple{&segment.first, segment.first_height, -1.0}, std::tuple{&segment.last, segment.last_height, 1.0}}) {
    if (height == 0.0) {
      const Vector2<double> p = narrow<double>(*position);
      const Matrix2<double> motion = quarterTurn(p) * normal.transpose() / (p.squaredNorm() * p.norm());
      sums.hessian -= 0.5 * sign * (motion + motion.transpose());
      sums.hessian_size += 1.0 / p.squaredNorm();
    }
  }
  return sums;
}

SegmentEvaluation integrate(const ClippedSegment<double>& clipped, const Vector2<double>& normal, double sine_to_line) {
  constexpr double kUnitRoundoff = 0x1p-53;
  SegmentEvaluation evaluation;
  evaluation.crosses_horizon = clipped.crosses_horizon;
  const SegmentSums<double> boundary = segmentBoundaryForm(clipped, normal);
  evaluation.derivatives = boundary.derivatives;
  // The height over the segment's line is right in double words only as far as it is not grazing
  // (docs/derivations/error_bounds.md, section 1).
  constexpr double kWideError = 16.0 * kUnitRoundoff * kUnitRoundoff;
  const double length = norm(narrow<double>(difference(clipped.last, clipped.first)));
  // A cut is right to 16 u^2 of the farther end's distance, about 1, which turns a short visible part by that over its
  // length.
  const double visible = clipped.crosses_horizon ? std::min(length, 1.0) : 1.0;
  const double grazing = kWideError / std::max(sine_to_line * visible, kWideError);
  const double relative_error = kEndError * kUnitRoundoff + grazing;
  const double tangential_error = kTangentialEndError * kUnitRoundoff + grazing;
  evaluation.bounds = {relative_error * boundary.irradiance_size, relative_error * boundary.gradient_size,
                       relative_error * boundary.hessian_size, tangential_error * boundary.tangential_size,
                       tangential_error * boundary.rotational_size};
  const double extent = length / norm(narrow<double>(clipped.first));
  if (extent <= kSmallSourceExtent) {
    evaluation.rule = SegmentRule::kLength;
    const SmallSourceRule rule = smallSourceRule(extent);
    const SmallSourceSums<2> sums = lengthRule(clipped, normal, *rule.rule);
    evaluation.derivatives.gradient.value = sums.gradient;
    evaluation.derivatives.hessian.value = sums.hessian;
    evaluation.derivatives.tangential_hessian.value = sums.tangential_hessian;
    const auto nodes = static_cast<double>(rule.rule->nodes.size());
    const auto relative_length_error = [&](double constant) {
      return (constant + nodes) * kUnitRoundoff + rule.truncation + grazing;
    };
    const double relative = relative_length_error(kSmallSourceError);
    evaluation.bounds.gradient = relative * sums.gradient_size;
    evaluation.bounds.hessian = relative * sums.hessian_size;
    evaluation.bounds.tangential_hessian =
        relative_length_error(kSmallSourceTangentialError) * sums.tangential_hessian_size;
  }
  return evaluation;
}

}  // namespace

SegmentEvaluation evaluateClipped(const ClippedSegment<double>& clipped, const Vector2<double>& normal,
                                  double sine_to_line, int exponent) {
  SegmentEvaluation evaluation = integrate(clipped, normal, sine_to_line);
  // Results below the normal range lose digits; the smallest subnormal numbers cover that.
  constexpr double kUnderflow = 4.0 * std::numeric_limits<double>::denorm_min();
  IrradianceDerivatives<double, 2>& d = evaluation.derivatives;
  for (int i = 0; i < 2; ++i) {
    d.gradient.value(i) = std::ldexp(d.gradient.value(i), -exponent);
    for (int j = 0; j < 2; ++j) {
      d.hessian.value(i, j) = std::ldexp(d.hessian.value(i, j), -2 * exponent);
    }
  }
  d.tangential_hessian.value(0) = std::ldexp(d.tangential_hessian.value(0), -2 * exponent);
  evaluation.bounds.gradient = std::ldexp(evaluation.bounds.gradient, -exponent) + kUnderflow;
  evaluation.bounds.hessian = std::ldexp(evaluation.bounds.hessian, -2 * exponent) + kUnderflow;
  evaluation.bounds.tangential_hessian = std::ldexp(evaluation.bounds.tangential_hessian, -2 * exponent) + kUnderflow;
  return evaluation;
}

SegmentEvaluation evaluateSegment(const Segment& segment, std::size_t index, const FlatlandReceiver& receiver) {
  // Scaled by a power of two so that the farther end is about 1 away: exact, and squares stay in range.
  const Eigen::Vector2d& a = segment.vertices[0];
  const Eigen::Vector2d& b = segment.vertices[1];
  CoordinateRange coordinates;
  coordinates.include(a);
  coordinates.include(b);
  coordinates.include(receiver.position);
  if (const std::string violation = rangeViolation(coordinates, "an end", receiver.normal); !violation.empty()) {
    reject(segment, index, receiver, violation);
  }
  const double largest = coordinates.largest();
  const int coarse = std::ilogb(largest) + 2;
  const auto shrink = [](const Eigen::Vector2d& p, int exponent) {
    return Vector2<double>(std::ldexp(p(0), -exponent), std::ldexp(p(1), -exponent));
  };
  const Vector2<double> coarse_position = shrink(receiver.position, coarse);
  const double farthest = std::max((shrink(a, coarse) - coarse_position).cwiseAbs().maxCoeff(),
                                   (shrink(b, coarse) - coarse_position).cwiseAbs().maxCoeff());
  const int exponent = coarse + std::ilogb(farthest) + 1;
  const Vector2<double> position = shrink(receiver.position, exponent);
  const Vector2<double> va = shrink(a, exponent);
  const Vector2<double> vb = shrink(b, exponent);

  const WideVector2 r0 = wideDifference<DoubleWord<double>>(va, position);
  const WideVector2 r1 = wideDifference<DoubleWord<double>>(vb, position);
  if (narrow<double>(r0).isZero(0.0) || narrow<double>(r1).isZero(0.0)) {
    reject(segment, index, receiver, "is on one of its ends; irradiance is not defined there");
  }
  const WideVector2 wide_edge = difference(r1, r0);
  const Vector2<double> edge = narrow<double>(wide_edge);
  const double length = edge.stableNorm();
  const auto side = static_cast<double>(crossFromNearer<double>(r0, r1));
  const bool between = narrow<double>(r0).dot(edge) < 0.0 && narrow<double>(r1).dot(edge) > 0.0;
  // What the rounding of coordinates may make of the height over the segment's line.
  const Eigen::Vector2d largest_coordinates =
      shrink(receiver.position.cwiseAbs().cwiseMax(a.cwiseAbs()).cwiseMax(b.cwiseAbs()), exponent);
  const double rounding = kCollinearTolerance * quarterTurn(edge).cwiseAbs().dot(largest_coordinates);
  if (between && std::abs(side) <= rounding) {
    if (std::abs(receiver.normal.dot(edge)) / length > kParallelTolerance) {
      reject(segment, index, receiver,
             "is inside it, but its normal is not the segment's; a receiver on a surface must face away from it");
    }
    return nothing(SegmentRule::kOwnSurface, false);
  }
  const ClippedSegment<double> clipped = clipSegment<double>(va, vb, position, receiver.normal);
  if (!clipped.is_visible) {
    const bool is_end_on = side == 0.0 && (clipped.first_height > 0.0 || clipped.last_height > 0.0);
    SegmentEvaluation evaluation =
        nothing(is_end_on ? SegmentRule::kEndOn : SegmentRule::kBelowHorizon, clipped.crosses_horizon);
    if (is_end_on) {
      evaluation.no_gradient = describe(segment, index) + " is seen end-on: the receiver lies on its line";
      evaluation.no_hessian = evaluation.no_gradient;
    }
    return evaluation;
  }
  SegmentEvaluation evaluation = evaluateClipped(
      clipped, receiver.normal, std::abs(side) / (length * norm(narrow<double>(clipped.first))), exponent);
  const IrradianceDerivatives<double, 2>& d = evaluation.derivatives;
  if (!clipped.crosses_horizon && (clipped.first_height == 0.0 || clipped.last_height == 0.0)) {
    evaluation.no_hessian =
        describe(segment, index) +
        " has an end on the receiver's horizon: the second derivative along the normal is one-sided";
  }
  if (!std::isfinite(d.irradiance.value) || !d.gradient.value.allFinite() || !d.hessian.value.allFinite() ||
      !d.tangential_hessian.value.allFinite() || !d.rotational_gradient.value.allFinite() ||
      !std::isfinite(evaluation.bounds.hessian) || !std::isfinite(evaluation.bounds.tangential_hessian)) {
    reject(segment, index, receiver,
           "is so close, or the segment so small, that a derivative exceeds the range of double");
  }
  return evaluation;
}

}  // namespace irradiff
