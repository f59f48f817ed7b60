#include "derivatives/form_factor/rule_choice.h"

#include "derivatives/boundary/tangent_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace irradiff {
namespace {

constexpr double kUnitRoundoff = 0x1p-53;

// Costs in the same unit, about a nanosecond on the machine where they were measured: they decide which of two rules
// that both meet the tolerance is taken, nothing else (docs/pareto.md).
constexpr double kCostOfTriangle = 25.0;
constexpr double kCostOfNode = 12.0;
constexpr double kCostOfEdge = 90.0;
constexpr double kCostOfCuts = 300.0;

/// Bounds are relative to sizes, which are that much larger than results usually are; those of the area rule's
/// truncation are larger still, and fall so fast with the number of nodes that a miss costs more than a node.
constexpr double kUsualSize = 32.0;
constexpr double kUsualTruncation = 128.0;
/// The same for irradiance of a polygon below this sine, after its truncation is divided by the extent.
constexpr double kUsualLowTruncation = 4.0;
constexpr double kLowCosine = 0.1;
/// Errors of irradiance along the boundary in units of u, before they are divided by what the polygon's arcs leave of
/// each other: those that it surely meets, and those that are worth an attempt, which costs a fraction of
/// evaluatePolygon.
constexpr double kSureAngleError = 256.0;
constexpr double kSureArcError = 100.0;
constexpr double kHopefulAngleError = 16.0;
/// Of a polygon this large, relative to its distance, the mean of the vertices says little.
constexpr double kWideExtent = 0.5;
/// The share of the tolerance for one kind of error.
constexpr double kShare = 0.125;

double areaCost(const PlainView& view, std::size_t nodes) {
  const double cuts = view.horizon == PlainView::Horizon::kCrosses ? kCostOfCuts : 0.0;
  return cuts + static_cast<double>(view.visible_count - 2) *
                    (kCostOfTriangle + kCostOfNode * static_cast<double>(nodes * nodes));
}

/// What is left of the derivatives of second order, and of irradiance, when the arcs of the boundary are added up, by
/// order of magnitude.
struct LeftOfSums {
  double hessian;
  double irradiance;
};

LeftOfSums leftOfSums(const PlainView& view) {
  const double hessian = std::min(1.0, view.thinness * view.extent);
  // Where the horizon is cut, what the ends of its edges are off by does not shrink with the polygon.
  const double cut = view.horizon == PlainView::Horizon::kCrosses ? std::min(1.0, view.extent) : 1.0;
  return {hessian, cut * hessian * view.sine_to_plane * view.highest_cosine};
}

/// The rule to begin with, and the one to go on with where its bounds miss the tolerance; evaluatePolygon is last.
struct Attempts {
  RuleChoice first;
  RuleChoice second;
};

Attempts choose(const PlainView& view, const EvaluationTolerance& tolerance) {
  switch (view.horizon) {
    case PlainView::Horizon::kUndecided:
      return {{EvaluationRule::kFull}, {EvaluationRule::kFull}};
    case PlainView::Horizon::kBelow:
      return {{EvaluationRule::kNothing}, {EvaluationRule::kNothing}};
    default:
      break;
  }
  const LeftOfSums left = leftOfSums(view);
  const double units = tolerance.relative() / kUnitRoundoff;
  const bool is_sure = kSureAngleError <= units * left.irradiance && kSureArcError * kUsualSize <= units * left.hessian;
  std::size_t level = 0;
  while (level + 1 < kSeriesTruncations.size() &&
         kSeriesTruncations[level] * 0.25 * kUsualSize > tolerance.relative() * left.hessian) {
    ++level;
  }
  const RuleChoice full{EvaluationRule::kFull};
  const bool is_worthwhile = view.extent > kWideExtent || kHopefulAngleError <= units * left.irradiance;
  const RuleChoice boundary = is_worthwhile ? RuleChoice{EvaluationRule::kPlainBoundary, 0, level} : full;
  const std::size_t nodes = tolerance.nodesFor(view.extent, view.highest_cosine < kLowCosine);
  if (nodes > kMostPlainNodes) {
    return {boundary, full};
  }
  const RuleChoice area{EvaluationRule::kPlainArea, nodes, 0};
  const bool area_is_cheaper = areaCost(view, nodes) <= kCostOfEdge * static_cast<double>(view.visible_count);
  return area_is_cheaper || !is_sure ? Attempts{area, boundary} : Attempts{boundary, area};
}

PlainAreaSettings areaSettingsFor(std::size_t nodes, const PlainView& view, const EvaluationTolerance& tolerance) {
  // Of A.p, whose terms cancel to the sine and to the thinness.
  constexpr double kOffsetErrors = kUsualSize * (kPlainMomentError + 5.0) * kUnitRoundoff;
  return {nodes, !(kOffsetErrors <= kShare * tolerance.relative() * view.sine_to_plane * view.thinness)};
}

PlainBoundarySettings settingsFor(std::size_t series_level, const PlainView& view,
                                  const EvaluationTolerance& tolerance) {
  static constexpr std::array<std::array<std::size_t, kAngleBins>, kSeriesTruncations.size()> kLengths = [] {
    std::array<std::array<std::size_t, kAngleBins>, kSeriesTruncations.size()> lengths{};
    for (std::size_t level = 0; level < lengths.size(); ++level) {
      lengths[level] = seriesLengthsFor(kSeriesTruncations[level]);
    }
    return lengths;
  }();
  const LeftOfSums left = leftOfSums(view);
  const double share = kShare * tolerance.relative();
  // What the other errors of irradiance leave of the tolerance, for r x e.
  const double for_moments =
      kShare * std::max(0.0, tolerance.relative() * left.irradiance - 2.0 * kPlainAngleError * kUnitRoundoff);
  constexpr double kAngleErrors = 2.0 * kMomentToAngle * kPlainMomentError * kUnitRoundoff;
  constexpr double kArcErrors = kUsualSize * kMomentToArc * kPlainMomentError * kUnitRoundoff;
  return {kLengths[series_level], std::min(for_moments / kAngleErrors, share * left.hessian / kArcErrors),
          std::min(for_moments, share * left.hessian / (2.0 * kUsualSize))};
}

/// Fills in results in metres, of either side, and what follows from them.
void finish(const PlainView& view, const PlainResult& plain, const Vector3<double>& normal,
            PolygonEvaluation& evaluation) {
  const double scale = view.scale;
  const double square = scale * scale;
  evaluation.is_clockwise = plain.irradiance > 0.0;
  const double sign = evaluation.is_clockwise ? 1.0 : -1.0;
  evaluation.crosses_horizon = view.horizon == PlainView::Horizon::kCrosses;
  IrradianceDerivatives<double>& d = evaluation.derivatives;
  d.irradiance.value = sign * plain.irradiance;
  d.gradient.value = (sign * scale) * plain.gradient;
  d.hessian.value = (sign * square) * plain.hessian;
  d.rotational_gradient.value = sign * cross<double>(normal, plain.vector_irradiance);
  d.tangential_hessian = tangentialHessian(d.hessian.value, normal);
  // What underflows in these units, and 40 u for turning a matrix, whose 2-norm is at most 3 times its largest entry.
  constexpr double kUnderflow = 0x1p-900;
  DerivativeBounds& bounds = evaluation.bounds;
  bounds.irradiance = plain.bounds.irradiance + kUnderflow;
  bounds.gradient = scale * (plain.bounds.gradient + kUnderflow);
  bounds.hessian = square * (plain.bounds.hessian + kUnderflow);
  bounds.tangential_hessian = 3.0 * (bounds.hessian + 40.0 * kUnitRoundoff * d.hessian.value.cwiseAbs().maxCoeff());
  bounds.rotational_gradient =
      2.0 * (plain.bounds.rotational_gradient + 8.0 * kUnitRoundoff * norm(plain.vector_irradiance)) + kUnderflow;
}

bool meets(const PolygonEvaluation& evaluation, double tolerance) {
  const IrradianceDerivatives<double>& d = evaluation.derivatives;
  const double hessian = d.hessian.value.cwiseAbs().maxCoeff();
  // Numbers near the ends of double's range are evaluatePolygon's business.
  return evaluation.bounds.irradiance <= tolerance * d.irradiance.value &&
         evaluation.bounds.gradient <= tolerance * d.gradient.value.cwiseAbs().maxCoeff() &&
         evaluation.bounds.hessian <= tolerance * hessian && hessian >= std::numeric_limits<double>::min() &&
         hessian <= std::numeric_limits<double>::max();
}

/// Whether evaluatePolygon's bounds miss the tolerance whatever its results, which these are within their bounds.
bool missesSurely(const PlainResult& plain, double tolerance) {
  const auto misses = [tolerance](double least_bound, double size, double bound) {
    return least_bound > tolerance * (size + bound);
  };
  const DerivativeBounds& least = plain.least_bounds;
  return misses(least.irradiance, std::abs(plain.irradiance), plain.bounds.irradiance) ||
         misses(least.gradient, plain.gradient.cwiseAbs().maxCoeff(), plain.bounds.gradient) ||
         misses(least.hessian, plain.hessian.cwiseAbs().maxCoeff(), plain.bounds.hessian);
}

void makeNothing(PolygonEvaluation& evaluation, const PlainView& view) {
  evaluation.derivatives = {{0.0},
                            {Vector3<double>::Zero()},
                            {Matrix3<double>::Zero()},
                            {Matrix2<double>::Zero()},
                            {Vector3<double>::Zero()}};
  evaluation.rule = PolygonRule::kBelowHorizon;
  evaluation.crosses_horizon = view.horizon == PlainView::Horizon::kBelow;
}

void evaluateFully(const Polygon& polygon, std::size_t index, const Receiver& receiver,
                   const EvaluationTolerance& tolerance, TolerantEvaluation& result) {
  result.choice = {EvaluationRule::kFull};
  result.evaluation = evaluatePolygon(polygon, index, receiver);
  result.meets_tolerance = meets(result.evaluation, tolerance.relative());
}

/// By a plain rule. Requires a view that is decided. Returns whether evaluatePolygon might meet the tolerance where
/// this rule did not.
bool evaluatePlainly(const RuleChoice& choice, const PlainView& view, const Polygon& polygon, const Receiver& receiver,
                     const EvaluationTolerance& tolerance, TolerantEvaluation& result) {
  result.choice = choice;
  if (choice.rule == EvaluationRule::kNothing) {
    makeNothing(result.evaluation, view);
    result.meets_tolerance = true;
    return false;
  }
  const bool by_area = choice.rule == EvaluationRule::kPlainArea;
  PlainResult plain = by_area
                          ? plainArea(view, polygon, receiver, areaSettingsFor(choice.nodes, view, tolerance))
                          : plainBoundary(view, polygon, receiver, settingsFor(choice.series_level, view, tolerance));
  // The side that the receiver sees, and with it every sign, is that of irradiance, where its bound tells.
  if (!(std::abs(plain.irradiance) > plain.bounds.irradiance)) {
    plain = withoutBounds();
  }
  finish(view, plain, receiver.normal, result.evaluation);
  result.evaluation.rule = by_area ? PolygonRule::kArea : PolygonRule::kBoundary;
  result.meets_tolerance = meets(result.evaluation, tolerance.relative());
  return !missesSurely(plain, tolerance.relative());
}

}  // namespace

std::string nameOf(const RuleChoice& choice) {
  std::ostringstream text;
  switch (choice.rule) {
    case EvaluationRule::kNothing:
      return "nothing";
    case EvaluationRule::kPlainArea:
      text << "plain area, " << choice.nodes << " x " << choice.nodes << " nodes";
      return text.str();
    case EvaluationRule::kPlainBoundary:
      text << "plain boundary, series to 2^" << std::ilogb(kSeriesTruncations[choice.series_level]);
      return text.str();
    default:
      return "evaluatePolygon";
  }
}

EvaluationTolerance::EvaluationTolerance(double relative) : relative_(relative) {
  if (!(relative >= 1e-15) || !(relative <= 1.0)) {
    std::ostringstream text;
    text << "EvaluationTolerance: " << relative << ", must be from 1e-15 to 1";
    throw std::invalid_argument(text.str());
  }
  // The largest extent at which what `truncation` makes of it is within the tolerance.
  const auto largestExtent = [relative](const auto& truncation) {
    double low = 0.0;
    double high = kLargestPlainExtent;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (low + high);
      (truncation(middle) <= relative ? low : high) = middle;
    }
    return low;
  };
  for (std::size_t nodes = 1; nodes <= kMostPlainNodes; ++nodes) {
    largest_extents_[nodes] =
        largestExtent([nodes](double extent) { return kUsualTruncation * plainAreaTruncation(nodes, extent); });
    largest_low_extents_[nodes] = std::min(largest_extents_[nodes], largestExtent([nodes](double extent) {
                                             return kUsualLowTruncation * plainAreaTruncation(nodes, extent) / extent;
                                           }));
  }
}

std::size_t EvaluationTolerance::nodesFor(double extent, bool is_low) const {
  const std::array<double, kMostPlainNodes + 1>& largest = is_low ? largest_low_extents_ : largest_extents_;
  std::size_t nodes = 1;
  while (nodes <= kMostPlainNodes && !(extent <= largest[nodes])) {
    ++nodes;
  }
  return nodes;
}

double EvaluationTolerance::lowSine() const {
  return std::clamp(5.0 * kUsualSize * kUnitRoundoff / (kShare * relative_), 0x1p-20, 0x1p-2);
}

RuleChoice chooseRule(const Polygon& polygon, const Receiver& receiver, const EvaluationTolerance& tolerance) {
  PlainView view;
  lookPlainly(polygon, receiver, tolerance.lowSine(), view);
  return choose(view, tolerance).first;
}

TolerantEvaluation evaluatePolygon(const Polygon& polygon, std::size_t index, const Receiver& receiver,
                                   const EvaluationTolerance& tolerance) {
  TolerantEvaluation result;
  PlainView view;
  lookPlainly(polygon, receiver, tolerance.lowSine(), view);
  const Attempts attempts = choose(view, tolerance);
  for (const RuleChoice& choice : {attempts.first, attempts.second}) {
    if (choice.rule == EvaluationRule::kFull) {
      break;
    }
    const bool full_may_meet = evaluatePlainly(choice, view, polygon, receiver, tolerance, result);
    if (result.meets_tolerance || !full_may_meet) {
      return result;
    }
  }
  evaluateFully(polygon, index, receiver, tolerance, result);
  return result;
}

TolerantEvaluation evaluatePolygonBy(const RuleChoice& choice, const Polygon& polygon, std::size_t index,
                                     const Receiver& receiver, const EvaluationTolerance& tolerance) {
  TolerantEvaluation result;
  if (choice.rule == EvaluationRule::kFull) {
    evaluateFully(polygon, index, receiver, tolerance, result);
    return result;
  }
  PlainView view;
  lookPlainly(polygon, receiver, tolerance.lowSine(), view);
  const bool is_seen = view.horizon == PlainView::Horizon::kAbove || view.horizon == PlainView::Horizon::kCrosses;
  const bool applies = choice.rule == EvaluationRule::kNothing     ? view.horizon == PlainView::Horizon::kBelow
                       : choice.rule == EvaluationRule::kPlainArea ? is_seen && view.extent <= kLargestPlainExtent
                                                                   : is_seen;
  if (applies) {
    evaluatePlainly(choice, view, polygon, receiver, tolerance, result);
    return result;
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  result.choice = choice;
  makeNothing(result.evaluation, view);
  result.evaluation.bounds = {kInfinity, kInfinity, kInfinity, kInfinity, kInfinity};
  return result;
}

}  // namespace irradiff
