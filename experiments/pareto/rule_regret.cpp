#include "experiments/pareto/rule_regret.h"

#include "derivatives/scene/invalid_scene.h"
#include "experiments/pareto/polygon_methods.h"
#include "experiments/pareto/stopwatch.h"
#include "verification/variants/formula_variants.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <utility>

namespace irradiff {

namespace {

/// A turn takes at least as long, so that the clock's own steps do not count.
constexpr double kTurn = 3e3;

/// A rule on one input.
struct Turn {
  std::size_t input;
  std::function<void()> work;
  std::size_t calls;
  std::vector<double>* nanoseconds;
};

class RegretMeasurement {
 public:
  RegretMeasurement(const FamilyInputs& inputs, double relative) : inputs_(inputs), tolerance_(relative) {
    const std::size_t count = inputs.inputs.size();
    chooser_.resize(count);
    guaranteed_.assign(count, false);
    for (const RuleChoice& choice : allRules()) addRule(choice);
    rules_in_set_ = rules_.size();
    for (const FormulaVariant& variant : formulaVariants()) {
      // What the library does without a tolerance is among its rules already, and certified values have bounds.
      if (variant.formula != "evaluatePolygon" && variant.formula != "certified") addFormula(variant);
    }
    for (std::size_t i = 0; i < count; ++i) addChooser(i);
    // What is compared is measured one soon after the other.
    std::ranges::stable_sort(turns_, {}, &Turn::input);
  }

  RuleRegret measure(std::size_t rounds) {
    for (std::size_t round = 0; round < rounds; ++round) {
      for (const Turn& turn : turns_) turn.nanoseconds->push_back(nanosecondsOf(turn.work, turn.calls));
    }
    // Rules without a value somewhere were not timed there.
    for (MeasuredRule& rule : rules_) {
      for (std::vector<double>& times : rule.nanoseconds) times.resize(rounds, 0.0);
    }
    for (std::vector<double>& times : chooser_) times.resize(rounds, 0.0);
    RuleRegret result;
    result.family = inputs_.family->name;
    result.tolerance = tolerance_.relative();
    result.inputs = inputs_.inputs.size();
    const std::vector<MeasuredRule> in_set(rules_.begin(), rules_.begin() + static_cast<long>(rules_in_set_));
    result.in_set = regretOf(chooser_, in_set, guaranteed_);
    result.of_all = regretOf(chooser_, {rules_.begin(), rules_.end()}, guaranteed_);
    result.guaranteed = static_cast<std::size_t>(std::ranges::count(guaranteed_, true));
    for (std::size_t i = 0; i < inputs_.inputs.size(); ++i) {
      const Configuration& input = inputs_.inputs[i];
      const TolerantEvaluation chosen = evaluateToTolerance(input);
      result.broken += chosen.meets_tolerance && !meets(formFactorOf(chosen.evaluation), i) ? 1 : 0;
      if (!guaranteed_[i]) continue;
      result.missed += chosen.meets_tolerance ? 0 : 1;
      result.fell_back += chosen.choice.rule == EvaluationRule::kFull ? 1 : 0;
      result.without_tolerance +=
          spreadOf(in_set.back().nanoseconds[i]).median / static_cast<double>(result.guaranteed);
    }
    return result;
  }

 private:
  bool meets(const FormFactor<long double>& value, std::size_t input) const {
    return relativeErrors(value, inputs_.truths[input])[kLargestError] <= tolerance_.relative();
  }

  /// One that does not meet the tolerance where the input is refused.
  TolerantEvaluation evaluateToTolerance(const Configuration& input) const {
    try {
      return evaluatePolygon(input.polygon, 0, input.receiver, tolerance_);
    } catch (const InvalidScene&) {
      return {};
    }
  }

  void addTurn(std::size_t input, std::function<void()> work, std::vector<double>& nanoseconds) {
    const std::size_t calls = callsFor(work, kTurn);
    turns_.push_back({input, std::move(work), calls, &nanoseconds});
  }

  MeasuredRule& addEmptyRule() {
    const std::size_t count = inputs_.inputs.size();
    rules_.push_back({std::vector<bool>(count, false), std::vector<std::vector<double>>(count)});
    return rules_.back();
  }

  void addRule(const RuleChoice& choice) {
    MeasuredRule& rule = addEmptyRule();
    for (std::size_t i = 0; i < inputs_.inputs.size(); ++i) {
      const Configuration& input = inputs_.inputs[i];
      const auto evaluate = [this, &input, choice] {
        return evaluatePolygonBy(choice, input.polygon, 0, input.receiver, tolerance_);
      };
      try {
        const TolerantEvaluation result = evaluate();
        guaranteed_[i] = guaranteed_[i] || result.meets_tolerance;
        rule.meets[i] = meets(formFactorOf(result.evaluation), i);
      } catch (const InvalidScene&) {
        continue;
      }
      if (rule.meets[i] || choice.rule == EvaluationRule::kFull) {
        addTurn(
            i, [evaluate] { keep(evaluate()); }, rule.nanoseconds[i]);
      }
    }
  }

  void addFormula(const FormulaVariant& variant) {
    MeasuredRule& rule = addEmptyRule();
    for (std::size_t i = 0; i < inputs_.inputs.size(); ++i) {
      if (!inputs_.above_horizon[i]) continue;
      const Configuration& input = inputs_.inputs[i];
      rule.meets[i] = meets(variant.evaluate(input.polygon, input.receiver), i);
      if (rule.meets[i]) {
        addTurn(
            i, [&input, &variant] { keep(variant.evaluate(input.polygon, input.receiver)); }, rule.nanoseconds[i]);
      }
    }
  }

  void addChooser(std::size_t i) {
    if (!guaranteed_[i]) return;
    const Configuration& input = inputs_.inputs[i];
    addTurn(
        i, [this, &input] { keep(evaluatePolygon(input.polygon, 0, input.receiver, tolerance_)); }, chooser_[i]);
  }

  const FamilyInputs& inputs_;
  EvaluationTolerance tolerance_;
  // Turns point into these: a list whose elements stay where they are.
  std::deque<MeasuredRule> rules_;
  std::vector<std::vector<double>> chooser_;
  std::vector<bool> guaranteed_;
  std::size_t rules_in_set_ = 0;
  std::vector<Turn> turns_;
};

}  // namespace

std::vector<RuleRegret> regretsOf(const FamilyInputs& inputs, std::size_t rounds) {
  std::vector<RuleRegret> regrets;
  for (const double tolerance : kChoiceTolerances) {
    regrets.push_back(RegretMeasurement(inputs, tolerance).measure(rounds));
  }
  return regrets;
}

}  // namespace irradiff
