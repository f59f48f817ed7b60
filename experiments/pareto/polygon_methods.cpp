#include "experiments/pareto/polygon_methods.h"

#include "derivatives/form_factor/pi.h"
#include "derivatives/scene/invalid_scene.h"
#include "verification/certified/certified_polygon.h"
#include "verification/variants/formula_variants.h"

#include <cmath>
#include <cstdio>
#include <limits>

namespace irradiff {

namespace {

FormFactor<long double> noValue() {
  constexpr long double kNone = std::numeric_limits<long double>::quiet_NaN();
  return {kNone, Vector3<long double>::Constant(kNone), Matrix3<long double>::Constant(kNone)};
}

MethodGroup groupOf(const std::string& formula) {
  if (formula.starts_with("appendix")) return MethodGroup::kAppendix;
  if (formula.starts_with("boundary")) return MethodGroup::kBoundary;
  if (formula.starts_with("area")) return MethodGroup::kArea;
  return formula == "certified" ? MethodGroup::kCertified : MethodGroup::kEvaluatePolygon;
}

/// The tolerance that a rule is meant for; it decides what of its geometry is compensated.
EvaluationTolerance toleranceOf(const RuleChoice& choice) {
  if (choice.rule == EvaluationRule::kPlainBoundary && choice.series_level < kChoiceTolerances.size()) {
    return EvaluationTolerance(kChoiceTolerances[choice.series_level]);
  }
  return EvaluationTolerance(kChoiceTolerances.back());
}

void addRules(std::vector<PolygonMethod>& methods) {
  for (const RuleChoice& choice : allRules()) {
    if (choice.rule == EvaluationRule::kFull || choice.rule == EvaluationRule::kNothing) continue;
    methods.push_back({nameOf(choice), MethodGroup::kPlainRule, choice.rule == EvaluationRule::kPlainBoundary, false,
                       [choice, tolerance = toleranceOf(choice)](const Polygon& polygon, const Receiver& receiver) {
                         return formFactorOf(evaluatePolygonBy(choice, polygon, 0, receiver, tolerance).evaluation);
                       }});
  }
}

void addTolerances(std::vector<PolygonMethod>& methods) {
  for (const double tolerance : kChoiceTolerances) {
    char name[64];
    std::snprintf(name, sizeof name, "evaluatePolygon to %.0e", tolerance);
    methods.push_back({name, MethodGroup::kTolerance, true, false,
                       [tolerance = EvaluationTolerance(tolerance)](const Polygon& polygon, const Receiver& receiver) {
                         try {
                           return formFactorOf(evaluatePolygon(polygon, 0, receiver, tolerance).evaluation);
                         } catch (const InvalidScene&) {
                           return noValue();
                         }
                       }});
  }
}

void addRungs(std::vector<PolygonMethod>& methods) {
  for (const Rung rung : kRungs) {
    methods.push_back({std::string("rung of ") + nameOf(rung) + " alone", MethodGroup::kCertified, true, true,
                       [rung](const Polygon& polygon, const Receiver& receiver) {
                         try {
                           PolygonEvaluation evaluation =
                               certifyPolygonAt(rung, polygon, 0, receiver, kDefaultTolerance).evaluation;
                           evaluation.is_clockwise = true;
                           return formFactorOf(evaluation);
                         } catch (const InvalidScene&) {
                           return noValue();
                         }
                       }});
  }
}

}  // namespace

const char* nameOf(MethodGroup group) {
  switch (group) {
    case MethodGroup::kAppendix:
      return "appendix form";
    case MethodGroup::kBoundary:
      return "boundary form";
    case MethodGroup::kArea:
      return "area rule";
    case MethodGroup::kEvaluatePolygon:
      return "evaluatePolygon";
    case MethodGroup::kPlainRule:
      return "plain rules";
    case MethodGroup::kTolerance:
      return "evaluatePolygon to a tolerance";
    default:
      return "certified precision";
  }
}

const std::vector<PolygonMethod>& polygonMethods() {
  static const std::vector<PolygonMethod> methods = [] {
    std::vector<PolygonMethod> all;
    for (const FormulaVariant& variant : formulaVariants()) {
      const MethodGroup group = groupOf(variant.formula);
      const bool knows_horizon = group == MethodGroup::kEvaluatePolygon || group == MethodGroup::kCertified;
      all.push_back({variant.name(), group, knows_horizon, false, variant.evaluate});
    }
    addRules(all);
    addTolerances(all);
    addRungs(all);
    return all;
  }();
  return methods;
}

std::vector<RuleChoice> allRules() {
  std::vector<RuleChoice> rules{{EvaluationRule::kNothing}};
  for (std::size_t nodes = 1; nodes <= kMostPlainNodes; ++nodes) rules.push_back({EvaluationRule::kPlainArea, nodes});
  for (std::size_t level = 0; level < kSeriesTruncations.size(); ++level) {
    rules.push_back({EvaluationRule::kPlainBoundary, 0, level});
  }
  rules.push_back({EvaluationRule::kFull});
  return rules;
}

FormFactor<long double> formFactorOf(const PolygonEvaluation& evaluation) {
  if (!std::isfinite(evaluation.bounds.hessian)) return noValue();
  const IrradianceDerivatives<double>& d = evaluation.derivatives;
  const long double unit = (evaluation.is_clockwise ? 1.0L : -1.0L) / pi<long double>();
  return {unit * static_cast<long double>(d.irradiance.value), unit * d.gradient.value.cast<long double>(),
          unit * d.hessian.value.cast<long double>()};
}

}  // namespace irradiff
