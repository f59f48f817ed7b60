#pragma once

#include "derivatives/form_factor/plain_rules.h"
#include "derivatives/form_factor/polygon_evaluation.h"

#include <array>
#include <cstddef>
#include <string>

namespace irradiff {

/// How a polygon may be evaluated where less than all digits of a double are asked for, cheapest set-up first.
enum class EvaluationRule {
  kNothing,        ///< all of it is below the horizon, as plain double can tell
  kPlainArea,      ///< Gauss nodes over the area, in plain double
  kPlainBoundary,  ///< the sum over the boundary in plain double, r x e compensated where it cancels
  kFull,           ///< evaluatePolygon without a tolerance
};

/// A rule with what it leaves open.
struct RuleChoice {
  EvaluationRule rule = EvaluationRule::kFull;
  std::size_t nodes = 0;         ///< in each direction of a triangle; of kPlainArea
  std::size_t series_level = 0;  ///< of kPlainBoundary, into kSeriesTruncations

  bool operator==(const RuleChoice&) const = default;
};

/// What the moments' series may lose; the last one is below rounding.
inline constexpr std::array<double, 5> kSeriesTruncations = {0x1p-16, 0x1p-26, 0x1p-36, 0x1p-47, 0x1p-54};

/// "plain area, 2 x 2 nodes", "plain boundary, series to 2^-16", "evaluatePolygon", "nothing".
std::string nameOf(const RuleChoice& choice);

/// A relative tolerance with what the choice of rules needs of it; made once for many polygons.
class EvaluationTolerance {
 public:
  /// Throws std::invalid_argument unless 1e-15 <= relative <= 1.
  explicit EvaluationTolerance(double relative);

  double relative() const { return relative_; }
  /// The sine below which heights over the horizon are taken from doubled precision.
  double lowSine() const;
  /// The fewest nodes whose truncation is likely to be within the tolerance; kMostPlainNodes + 1 if none is. Of a
  /// polygon whose heights over the horizon are small, irradiance needs an order more.
  std::size_t nodesFor(double extent, bool is_low) const;

 private:
  double relative_;
  std::array<double, kMostPlainNodes + 1> largest_extents_{};
  std::array<double, kMostPlainNodes + 1> largest_low_extents_{};
};

/// What a polygon of radiance 1 adds, and the rule that found it.
struct TolerantEvaluation {
  PolygonEvaluation evaluation;
  RuleChoice choice;
  /// Whether the bounds of irradiance, gradient and Hessian are within the tolerance, relative to the max norm of each.
  bool meets_tolerance = false;
};

/// The cheapest rule that is likely to meet the tolerance for this polygon. Requires validated arguments.
RuleChoice chooseRule(const Polygon& polygon, const Receiver& receiver, const EvaluationTolerance& tolerance);

// evaluatePolygon to a relative tolerance: by the rule that chooseRule names, by another one where the bounds of
// irradiance, gradient and Hessian turn out to miss it, and at last by that of no tolerance. Bounds hold always, those
// of the tangential Hessian and the rotational gradient too, which the tolerance is not about. Where no rule of double
// can meet the tolerance the result is that of the rule that found it out, which may have larger bounds than
// evaluatePolygon without a tolerance. Throws as that does, but for coordinates that its rules refuse and the cheaper
// ones can do with. docs/derivations/rule_choice.md.
TolerantEvaluation evaluatePolygon(const Polygon& polygon, std::size_t index, const Receiver& receiver,
                                   const EvaluationTolerance& tolerance);

/// The same by a given rule, whether it meets the tolerance or not. Bounds of the plain rules are infinite where they
/// do not apply. For comparisons.
TolerantEvaluation evaluatePolygonBy(const RuleChoice& choice, const Polygon& polygon, std::size_t index,
                                     const Receiver& receiver, const EvaluationTolerance& tolerance);

}  // namespace irradiff
