// The rules that evaluatePolygon chooses from with a tolerance: their bounds hold against 200 digits, on all families
// and next to the thresholds where the choice changes; what is chosen keeps the tolerance that it says it keeps.
// docs/derivations/rule_choice.md.

#include "derivatives/form_factor/rule_choice.h"

#include "derivatives/form_factor/pi.h"
#include "derivatives/scene/invalid_scene.h"
#include "verification/checks/input_families.h"
#include "verification/checks/oracle.h"
#include "verification/checks/random.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t kSeed = 20120806;
constexpr std::array<double, 4> kTolerances = {1e-3, 1e-6, 1e-9, 1e-12};

std::vector<RuleChoice> plainRules() {
  std::vector<RuleChoice> rules;
  for (std::size_t nodes = 1; nodes <= kMostPlainNodes; ++nodes) rules.push_back({EvaluationRule::kPlainArea, nodes});
  for (std::size_t level = 0; level < kSeriesTruncations.size(); ++level) {
    rules.push_back({EvaluationRule::kPlainBoundary, 0, level});
  }
  return rules;
}

/// |error| over what is allowed for each quantity; the error of a truth to 200 digits is far below.
struct Ratios {
  double irradiance = 0.0, gradient = 0.0, hessian = 0.0, tangential_hessian = 0.0, rotational_gradient = 0.0;

  double largest() const { return std::max({irradiance, gradient, hessian, tangential_hessian, rotational_gradient}); }
  /// Of those that a tolerance is about.
  double largestOfTolerance() const { return std::max({irradiance, gradient, hessian}); }
};

const Multiprecision& multiprecisionPi() {
  static const Multiprecision value = pi<Multiprecision>();
  return value;
}

/// max|value - pi truth| over `allowed`, a multiple of max|pi truth| if `is_relative`.
template <class Values, class Truths>
double ratioOf(const Values& values, const Truths& truths, double sign, double allowed, bool is_relative) {
  Multiprecision difference = 0;
  Multiprecision size = 0;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const Multiprecision truth = multiprecisionPi() * truths(i) * Multiprecision(sign);
    difference = std::max<Multiprecision>(difference, abs(truth - Multiprecision(values(i))));
    size = std::max<Multiprecision>(size, abs(truth));
  }
  if (difference == 0) return 0.0;
  return Multiprecision(difference / (Multiprecision(allowed) * (is_relative ? size : Multiprecision(1))))
      .convert_to<double>();
}

Ratios ratiosOf(const PolygonEvaluation& evaluation, const OracleValue& truth, const DerivativeBounds& allowed,
                bool is_relative) {
  const IrradianceDerivatives<double>& d = evaluation.derivatives;
  const double sign = truth.form_factor < 0 ? -1.0 : 1.0;
  using One = Eigen::Matrix<double, 1, 1>;
  using WideOne = Eigen::Matrix<Multiprecision, 1, 1>;
  return {
      ratioOf(One(d.irradiance.value), WideOne(truth.form_factor), sign, allowed.irradiance, is_relative),
      ratioOf(d.gradient.value, truth.gradient, sign, allowed.gradient, is_relative),
      ratioOf(d.hessian.value, truth.hessian, sign, allowed.hessian, is_relative),
      ratioOf(d.tangential_hessian.value, truth.tangential_hessian, sign, allowed.tangential_hessian, is_relative),
      ratioOf(d.rotational_gradient.value, truth.rotational_gradient, sign, allowed.rotational_gradient, is_relative)};
}

double ratioToBounds(const PolygonEvaluation& evaluation, const OracleValue& truth) {
  return ratiosOf(evaluation, truth, evaluation.bounds, false).largest();
}

double ratioToTolerance(const PolygonEvaluation& evaluation, const OracleValue& truth, double tolerance) {
  return ratiosOf(evaluation, truth, {tolerance, tolerance, tolerance, tolerance, tolerance}, true)
      .largestOfTolerance();
}

OracleValue truthOf(const Configuration& input) { return multiprecisionOracle().evaluate(input).value(); }

bool hasBounds(const TolerantEvaluation& result) { return std::isfinite(result.evaluation.bounds.hessian); }

TolerantEvaluation evaluateBy(const RuleChoice& choice, const Configuration& input, double tolerance) {
  return evaluatePolygonBy(choice, input.polygon, 0, input.receiver, EvaluationTolerance(tolerance));
}

TEST(RuleChoice, BoundsOfEveryRuleHoldOnAllFamilies) {
  for (const InputFamily& family : inputFamilies()) {
    double worst = 0.0;
    std::size_t compared = 0;
    for (const Configuration& input : drawInputs(family, lengthened(40), kSeed)) {
      const OracleValue truth = truthOf(input);
      for (const double tolerance : kTolerances) {
        for (const RuleChoice& choice : plainRules()) {
          const TolerantEvaluation result = evaluateBy(choice, input, tolerance);
          if (!hasBounds(result)) continue;
          ++compared;
          const double ratio = ratioToBounds(result.evaluation, truth);
          EXPECT_LE(ratio, 1.0) << nameOf(choice) << " to " << tolerance << ": " << sceneLine(input);
          worst = std::max(worst, ratio);
        }
      }
    }
    std::cout << family.name << ", seed " << kSeed << ": error at most " << worst << " of its bound in " << compared
              << " comparisons\n";
  }
}

TEST(RuleChoice, WhatIsChosenKeepsItsPromises) {
  for (const InputFamily& family : inputFamilies()) {
    std::size_t met = 0;
    std::size_t plain = 0;
    for (const Configuration& input : drawInputs(family, lengthened(60), kSeed + 1)) {
      const OracleValue truth = truthOf(input);
      const PolygonEvaluation full = evaluatePolygon(input.polygon, 0, input.receiver);
      for (const double tolerance : kTolerances) {
        const TolerantEvaluation result =
            evaluatePolygon(input.polygon, 0, input.receiver, EvaluationTolerance(tolerance));
        EXPECT_LE(ratioToBounds(result.evaluation, truth), 1.0) << sceneLine(input);
        EXPECT_EQ(result.evaluation.crosses_horizon, full.crosses_horizon) << sceneLine(input);
        EXPECT_EQ(result.evaluation.no_hessian, full.no_hessian);
        if (result.meets_tolerance) {
          ++met;
          EXPECT_LE(ratioToTolerance(result.evaluation, truth, tolerance), 1.0)
              << nameOf(result.choice) << ": " << sceneLine(input);
          EXPECT_EQ(result.evaluation.is_clockwise, full.is_clockwise) << sceneLine(input);
        } else {
          EXPECT_FALSE(evaluateBy({EvaluationRule::kFull}, input, tolerance).meets_tolerance)
              << "it gave up where evaluatePolygon meets " << tolerance << ": " << sceneLine(input);
        }
        plain += result.choice.rule == EvaluationRule::kFull ? 0 : 1;
      }
    }
    std::cout << family.name << ": tolerance met in " << met << ", plain rule in " << plain << " of "
              << 4 * lengthened(60) << '\n';
  }
}

/// A polygon of `extent` (PlainView::extent), scaled about the mean of its vertices.
Configuration withExtent(Configuration input, double extent) {
  PlainView view;
  lookPlainly(input.polygon, input.receiver, 0.25, view);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& v : input.polygon.vertices) {
    mean += v / static_cast<double>(input.polygon.vertices.size());
  }
  for (Eigen::Vector3d& v : input.polygon.vertices) v = mean + extent / view.extent * (v - mean);
  return input;
}

/// The extent up to which the tolerance takes `nodes` nodes.
double thresholdOf(const EvaluationTolerance& tolerance, std::size_t nodes) {
  double low = 0.0;
  double high = kLargestPlainExtent;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (tolerance.nodesFor(middle, false) <= nodes ? low : high) = middle;
  }
  return low;
}

std::vector<Configuration> aboveHorizon(std::size_t count, std::string_view stream) {
  const InputFamily& family = inputFamily("well-conditioned");
  std::vector<Configuration> inputs;
  for (std::size_t i = 0; inputs.size() < count; ++i) {
    KeyedRandom random(kSeed, stream, i);
    inputs.push_back(family.draw(random));
  }
  return inputs;
}

/// Next to each extent at which one more node is taken, the larger one included.
std::vector<std::pair<Configuration, std::size_t>> inputsAtNodeThresholds(double relative, std::size_t count) {
  std::vector<std::pair<Configuration, std::size_t>> inputs;
  const EvaluationTolerance tolerance(relative);
  for (std::size_t nodes = 1; nodes <= kMostPlainNodes; ++nodes) {
    for (const Configuration& input : aboveHorizon(count, "nodes")) {
      inputs.emplace_back(withExtent(input, 0.999 * thresholdOf(tolerance, nodes)), nodes);
      inputs.emplace_back(withExtent(input, 1.001 * thresholdOf(tolerance, nodes)), nodes);
    }
  }
  return inputs;
}

TEST(RuleChoice, HoldsNextToThresholdsOfTheNumberOfNodes) {
  for (const double relative : kTolerances) {
    for (const auto& [input, nodes] : inputsAtNodeThresholds(relative, lengthened(10))) {
      const OracleValue truth = truthOf(input);
      const TolerantEvaluation by_area = evaluateBy({EvaluationRule::kPlainArea, nodes}, input, relative);
      EXPECT_LE(ratioToBounds(by_area.evaluation, truth), 1.0) << sceneLine(input);
      const TolerantEvaluation chosen =
          evaluatePolygon(input.polygon, 0, input.receiver, EvaluationTolerance(relative));
      // Not even evaluatePolygon meets 1e-12 on all of these.
      EXPECT_TRUE(chosen.meets_tolerance || relative < 1e-9) << relative << ": " << sceneLine(input);
      EXPECT_LE(ratioToTolerance(chosen.evaluation, truth, relative), 1.0);
    }
  }
}

// A rule with a node less than its bound is for is wrong by more than the bound says: what bounds the error is the
// truncation, with the right exponent.
TEST(RuleChoice, BoundsOfOneNodeMoreDoNotHold) {
  std::size_t broken = 0;
  for (const auto& [input, nodes] : inputsAtNodeThresholds(1e-9, 4)) {
    if (nodes == 1) continue;
    PolygonEvaluation twin = evaluateBy({EvaluationRule::kPlainArea, nodes - 1}, input, 1e-9).evaluation;
    twin.bounds = evaluateBy({EvaluationRule::kPlainArea, nodes}, input, 1e-9).evaluation.bounds;
    broken += ratioToBounds(twin, truthOf(input)) > 1.0 ? 1 : 0;
  }
  EXPECT_GT(broken, 10U);
}

// Arcs of a definite angle: a triangle whose first edge subtends it, the receiver at a distance of 1 from that edge's
// line. Next to bins of the series' lengths, to the doubling at one radian and to the cut at two.
Configuration withArc(KeyedRandom& random, double angle) {
  const double to_first = random.between(0.1, 0.9) * angle;
  const Eigen::Vector3d foot(0.0, 0.0, 1.0);
  const Eigen::Vector3d along(1.0, 0.0, 0.0);
  const Eigen::Vector3d first = foot - std::tan(std::min(to_first, 1.5)) * along;
  const Eigen::Vector3d last = foot + std::tan(std::min(angle - to_first, 1.5)) * along;
  const Eigen::Vector3d third =
      foot + random.between(-1.0, 1.0) * along + Eigen::Vector3d(0.0, random.between(0.3, 2.0), 0.2);
  return {{"triangle", {first, last, third}, 1.0}, {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()}};
}

TEST(RuleChoice, BoundsHoldNextToThresholdsOfTheAngle) {
  std::vector<double> angles{1.0, 2.0, 2.6};
  for (std::size_t bin = 1; bin < kAngleBins; ++bin) {
    angles.push_back(static_cast<double>(bin) / kAngleBins);
    angles.push_back(2.0 * static_cast<double>(bin) / kAngleBins);
  }
  double worst = 0.0;
  for (const double angle : angles) {
    for (const double factor : {1.0 - 1e-12, 1.0 - 1e-15, 1.0, 1.0 + 1e-15, 1.0 + 1e-12}) {
      for (std::size_t i = 0; i < lengthened(4); ++i) {
        KeyedRandom random(kSeed, "angles", i);
        const Configuration input = withArc(random, factor * angle);
        const OracleValue truth = truthOf(input);
        for (std::size_t level = 0; level < kSeriesTruncations.size(); ++level) {
          const TolerantEvaluation result = evaluateBy({EvaluationRule::kPlainBoundary, 0, level}, input, 1e-6);
          ASSERT_TRUE(hasBounds(result));
          const double ratio = ratioToBounds(result.evaluation, truth);
          EXPECT_LE(ratio, 1.0) << nameOf(result.choice) << ": " << sceneLine(input);
          worst = std::max(worst, ratio);
        }
      }
    }
  }
  std::cout << "next to thresholds of the angle: error at most " << worst << " of its bound\n";
}

// The series of the next level down with this level's bounds.
TEST(RuleChoice, BoundsOfALongerSeriesDoNotHold) {
  std::size_t broken = 0;
  for (std::size_t i = 0; i < 20; ++i) {
    KeyedRandom random(kSeed, "short series", i);
    const Configuration input = withArc(random, 0.99);
    PolygonEvaluation twin = evaluateBy({EvaluationRule::kPlainBoundary, 0, 0}, input, 1e-6).evaluation;
    twin.bounds = evaluateBy({EvaluationRule::kPlainBoundary, 0, 1}, input, 1e-6).evaluation.bounds;
    broken += ratioToBounds(twin, truthOf(input)) > 1.0 ? 1 : 0;
  }
  EXPECT_GT(broken, 10U);
}

/// Heights just above and below a sine, moments that cancel to about a fraction: near the horizon and along an edge.
Configuration grazing(KeyedRandom& random, double sine) {
  const Eigen::Vector3d along = random.direction();
  Eigen::Vector3d across = along.cross(random.direction()).normalized();
  const Eigen::Vector3d start = along * random.between(0.5, 2.0) + across * sine * random.between(0.9, 1.1);
  const Eigen::Vector3d end = start + along * random.between(0.3, 3.0);
  const Eigen::Vector3d third = start + random.direction() * random.between(0.3, 1.0);
  Eigen::Vector3d normal = (across * random.between(0.9, 1.1) + along * (0.3 * sine) + 0.2 * random.direction());
  if (random.below(2) == 0) normal = third.cross(start) + sine * start;
  normal.normalize();
  return {{"triangle", {start, end, third}, 1.0}, {Eigen::Vector3d::Zero(), normal}};
}

TEST(RuleChoice, BoundsHoldNextToThresholdsOfCancellation) {
  double worst = 0.0;
  std::size_t compared = 0;
  for (std::size_t i = 0; i < lengthened(300); ++i) {
    KeyedRandom random(kSeed, "grazing", i);
    const Configuration input = grazing(random, random.decade(-13.0, 0.0));
    const OracleValue truth = truthOf(input);
    if (truth.form_factor == 0) continue;
    for (const double tolerance : kTolerances) {
      for (const std::size_t level : {std::size_t{0}, kSeriesTruncations.size() - 1}) {
        const TolerantEvaluation result = evaluateBy({EvaluationRule::kPlainBoundary, 0, level}, input, tolerance);
        if (!hasBounds(result)) continue;
        ++compared;
        const double ratio = ratioToBounds(result.evaluation, truth);
        EXPECT_LE(ratio, 1.0) << tolerance << ": " << sceneLine(input);
        worst = std::max(worst, ratio);
      }
    }
  }
  EXPECT_GT(compared, 4 * lengthened(300));
  std::cout << "next to thresholds of cancellation: error at most " << worst << " of its bound in " << compared
            << " comparisons\n";
}

/// Steps uphill in the ratio of error to bound, from random inputs.
double climb(const RuleChoice& choice, double tolerance, std::string_view family, std::size_t start) {
  KeyedRandom random(kSeed, nameOf(choice), start);
  const auto ratioAt = [&](const Configuration& input) {
    const TolerantEvaluation result = evaluateBy(choice, input, tolerance);
    return hasBounds(result) ? ratioToBounds(result.evaluation, truthOf(input)) : 0.0;
  };
  Configuration best = inputFamily(family).draw(random);
  double largest = ratioAt(best);
  double step = 0.3;
  for (int i = 0; i < 80; ++i) {
    Configuration next = best;
    for (Eigen::Vector3d& v : next.polygon.vertices) {
      if (random.below(3) == 0) v += step * random.unit() * (v - next.receiver.position).norm() * random.direction();
    }
    // What is no longer planar is another surface with the same boundary: only triangles stay what they are.
    next.polygon.vertices.resize(3);
    if (random.below(3) == 0) {
      next.receiver.normal = (next.receiver.normal + step * random.unit() * random.direction()).normalized();
    }
    const double ratio = ratioAt(next);
    if (ratio > largest) {
      largest = ratio;
      best = next;
    } else {
      step = step < 1e-3 ? 0.3 : 0.95 * step;
    }
  }
  return largest;
}

TEST(RuleChoice, BoundsHoldWhereErrorsAreSoughtOut) {
  for (const RuleChoice& choice :
       {RuleChoice{EvaluationRule::kPlainArea, 1}, RuleChoice{EvaluationRule::kPlainArea, 3},
        RuleChoice{EvaluationRule::kPlainArea, 8}, RuleChoice{EvaluationRule::kPlainBoundary, 0, 0},
        RuleChoice{EvaluationRule::kPlainBoundary, 0, 4}}) {
    double worst = 0.0;
    for (std::size_t start = 0; start < lengthened(6); ++start) {
      const char* family = start % 2 == 0 ? "generic" : "well-conditioned";
      worst = std::max(worst, climb(choice, start % 3 == 0 ? 1e-12 : 1e-3, family, start));
    }
    EXPECT_LE(worst, 1.0) << nameOf(choice);
    std::cout << nameOf(choice) << ", climbed to: error " << worst << " of its bound\n";
  }
}

// Bounds that are a thousandth of what they are do not hold: the comparisons above can fail.
TEST(RuleChoice, SmallerBoundsDoNotHold) {
  for (const RuleChoice& choice : plainRules()) {
    std::size_t broken = 0;
    std::size_t compared = 0;
    for (const InputFamily& family : inputFamilies()) {
      for (const Configuration& input : drawInputs(family, 10, kSeed)) {
        TolerantEvaluation result = evaluateBy(choice, input, 1e-12);
        if (!hasBounds(result)) continue;
        ++compared;
        DerivativeBounds& bounds = result.evaluation.bounds;
        bounds = {1e-3 * bounds.irradiance, 1e-3 * bounds.gradient, 1e-3 * bounds.hessian,
                  1e-3 * bounds.tangential_hessian, 1e-3 * bounds.rotational_gradient};
        broken += ratioToBounds(result.evaluation, truthOf(input)) > 1.0 ? 1 : 0;
      }
    }
    EXPECT_GT(broken, compared / 20) << nameOf(choice);
  }
}

TEST(RuleChoice, TheRuleWithoutAToleranceIsEvaluatePolygonToTheBit) {
  for (const InputFamily& family : inputFamilies()) {
    for (const Configuration& input : drawInputs(family, 20, kSeed)) {
      const PolygonEvaluation full = evaluatePolygon(input.polygon, 0, input.receiver);
      const PolygonEvaluation by_choice = evaluateBy({EvaluationRule::kFull}, input, 1e-12).evaluation;
      EXPECT_EQ(by_choice.derivatives.irradiance.value, full.derivatives.irradiance.value);
      EXPECT_EQ(by_choice.derivatives.gradient.value, full.derivatives.gradient.value);
      EXPECT_EQ(by_choice.derivatives.hessian.value, full.derivatives.hessian.value);
      EXPECT_EQ(by_choice.bounds.hessian, full.bounds.hessian);
    }
  }
}

TEST(RuleChoice, ChoosesTheCheapRulesWhereTheyServe) {
  const Configuration large = aboveHorizon(1, "choices")[0];
  const auto ruleFor = [](const Configuration& input, double tolerance) {
    return chooseRule(input.polygon, input.receiver, EvaluationTolerance(tolerance));
  };
  EXPECT_EQ(ruleFor(withExtent(large, 1e-4), 1e-3), (RuleChoice{EvaluationRule::kPlainArea, 1}));
  EXPECT_EQ(ruleFor(withExtent(large, 1e-2), 1e-12).rule, EvaluationRule::kPlainArea);
  EXPECT_GT(ruleFor(withExtent(large, 1e-2), 1e-12).nodes, 2U);
  EXPECT_EQ(ruleFor(withExtent(large, 0.4), 1e-6).rule, EvaluationRule::kPlainBoundary);
  EXPECT_LT(ruleFor(withExtent(large, 0.4), 1e-3).series_level, ruleFor(withExtent(large, 0.4), 1e-9).series_level);
  EXPECT_EQ(ruleFor(withExtent(large, 0.4), 1e-15).rule, EvaluationRule::kFull);
  Configuration below = large;
  below.receiver.normal = -below.receiver.normal;
  EXPECT_EQ(ruleFor(below, 1e-3).rule, EvaluationRule::kNothing);
}

TEST(RuleChoice, SeesNothingBelowTheHorizon) {
  Configuration below = aboveHorizon(1, "below")[0];
  below.receiver.normal = -below.receiver.normal;
  const TolerantEvaluation result = evaluatePolygon(below.polygon, 0, below.receiver, EvaluationTolerance(1e-3));
  EXPECT_TRUE(result.meets_tolerance);
  EXPECT_EQ(result.evaluation.rule, PolygonRule::kBelowHorizon);
  EXPECT_EQ(result.evaluation.derivatives.irradiance.value, 0.0);
  EXPECT_EQ(result.evaluation.derivatives.hessian.value.norm(), 0.0);
  EXPECT_EQ(result.evaluation.bounds.hessian, 0.0);
}

const Polygon& unitSquare() {
  static const Polygon square{"square", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 1.0};
  return square;
}

std::string refusalOf(const Receiver& receiver) {
  try {
    evaluatePolygon(unitSquare(), 3, receiver, EvaluationTolerance(1e-3));
  } catch (const InvalidScene& error) {
    return error.what();
  }
  return "";
}

TEST(RuleChoice, LeavesWhatPlainDoubleCannotDecideToEvaluatePolygon) {
  const EvaluationTolerance tolerance(1e-3);
  EXPECT_THAT(refusalOf({{0.5, 0, 0}, {0, 0, 1}}), HasSubstr("polygons[3] \"square\""));
  EXPECT_THAT(refusalOf({{0.5, 0, 0}, {0, 0.6, 0.8}}), HasSubstr("on the edge from vertices[0]"));
  EXPECT_THAT(refusalOf({{1, 1, 0}, {0.6, 0, 0.8}}), HasSubstr("at vertices[2]"));
  EXPECT_THAT(refusalOf({{0.5, 0.5, 0}, {0, 0.6, 0.8}}), HasSubstr("its normal is not the polygon's"));
  // Its own surface, its own plane, and a horizon along an edge.
  EXPECT_EQ(evaluatePolygon(unitSquare(), 0, {{0.5, 0.5, 0}, {0, 0, 1}}, tolerance).evaluation.rule,
            PolygonRule::kOwnSurface);
  EXPECT_EQ(evaluatePolygon(unitSquare(), 0, {{2, 0.5, 0}, {-1, 0, 0}}, tolerance).evaluation.rule,
            PolygonRule::kEdgeOn);
  EXPECT_FALSE(evaluatePolygon(unitSquare(), 0, {{0, 0.5, -1}, {1, 0, 0}}, tolerance).evaluation.no_hessian.empty());
}

TEST(EvaluationTolerance, RefusesWhatNoDoubleCanKeep) {
  for (const double wrong : {0.0, 1e-16, 1.5, -1e-3, std::nan("")}) {
    EXPECT_THROW(EvaluationTolerance{wrong}, std::invalid_argument) << wrong;
  }
  try {
    EvaluationTolerance{2.0};
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "EvaluationTolerance: 2, must be from 1e-15 to 1");
  }
}

}  // namespace
}  // namespace irradiff
