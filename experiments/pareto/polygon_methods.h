#pragma once

#include "derivatives/form_factor/form_factor.h"
#include "derivatives/form_factor/rule_choice.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "verification/certified/rung.h"

#include <functional>
#include <string>
#include <vector>

namespace irradiff {

/// What a method is, for tables and colours.
enum class MethodGroup {
  kAppendix,         ///< the appendix form of the 2012 paper
  kBoundary,         ///< the boundary form
  kArea,             ///< the area rule
  kEvaluatePolygon,  ///< the library without a tolerance
  kPlainRule,        ///< one of the rules that the library chooses from
  kTolerance,        ///< the library with a tolerance
  kCertified,        ///< one rung of certified precision
};
inline constexpr std::size_t kMethodGroups = 7;

const char* nameOf(MethodGroup group);

/// A way to get F, gradient and Hessian of a polygon from one receiver.
struct PolygonMethod {
  std::string name;
  MethodGroup group = MethodGroup::kAppendix;
  bool knows_horizon = false;   ///< it cuts polygons at the horizon
  bool of_either_side = false;  ///< it does not tell the side: F >= 0 whatever the order of the vertices
  /// NaN where it has no value.
  std::function<FormFactor<long double>(const Polygon&, const Receiver&)> evaluate;
};

/// All formulas at all scalars, the rules of the library one by one, and the library to several tolerances. The first
/// is the appendix form with acos in double.
const std::vector<PolygonMethod>& polygonMethods();

/// The tolerances of the library in polygonMethods() and of regrets.
inline constexpr std::array<double, 4> kChoiceTolerances = {1e-3, 1e-6, 1e-9, 1e-12};

/// Every rule that evaluatePolygon with a tolerance may take.
std::vector<RuleChoice> allRules();

/// The form factor of an evaluation, with the sign that the order of vertices gives it; NaN where it has no bounds.
FormFactor<long double> formFactorOf(const PolygonEvaluation& evaluation);

}  // namespace irradiff
