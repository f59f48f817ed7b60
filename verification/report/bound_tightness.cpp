#include "verification/report/bound_tightness.h"

#include "derivatives/flatland/segment_evaluation.h"
#include "derivatives/flatland/segment_form.h"
#include "derivatives/form_factor/boundary_form.h"
#include "derivatives/form_factor/pi.h"
#include "derivatives/scene/invalid_scene.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "verification/certified/certified_polygon.h"
#include "verification/certified/certified_scene.h"
#include "verification/checks/input_families.h"
#include "verification/checks/oracle.h"
#include "verification/multiprecision/multiprecision.h"
#include "verification/occlusion/frozen_view.h"
#include "verification/occlusion/scene_families.h"
#include "verification/report/figure_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace irradiff {
namespace {

using Pairs = std::array<std::vector<BoundAndError>, kQuantities.size()>;

template <class Exact, class Values>
Multiprecision errorOf(const Exact& expected, const Values& actual) {
  Multiprecision largest = 0;
  for (Eigen::Index i = 0; i < actual.size(); ++i) {
    largest = std::max<Multiprecision>(largest, abs(Multiprecision(actual(i)) - expected(i)));
  }
  return largest;
}

/// Errors in the order of kQuantities.
template <int Dimension>
std::array<Multiprecision, kQuantities.size()> errorsOf(
    const IrradianceDerivatives<Multiprecision, Dimension>& expected,
    const IrradianceDerivatives<double, Dimension>& actual) {
  return {Multiprecision(abs(expected.irradiance.value - actual.irradiance.value)),
          errorOf(expected.gradient.value, actual.gradient.value),
          errorOf(expected.hessian.value, actual.hessian.value),
          errorOf(expected.tangential_hessian.value, actual.tangential_hessian.value),
          errorOf(expected.rotational_gradient.value, actual.rotational_gradient.value)};
}

/// `reasons` why a quantity does not exist, in the order of kQuantities.
template <int Dimension>
void addPairs(const IrradianceDerivatives<Multiprecision, Dimension>& expected,
              const IrradianceDerivatives<double, Dimension>& actual, const DerivativeBounds& bounds,
              const std::array<const std::string*, kQuantities.size()>& reasons, Pairs& pairs) {
  const auto errors = errorsOf(expected, actual);
  for (std::size_t i = 0; i < kQuantities.size(); ++i) {
    if (reasons[i]->empty())
      pairs[i].push_back({boundOf(bounds, kQuantities[i]), errors[i].template convert_to<double>()});
  }
}

template <int Dimension>
std::array<const std::string*, kQuantities.size()> reasonsOf(const SceneEvaluation<Dimension>& e) {
  return {&e.no_irradiance, &e.no_gradient, &e.no_hessian, &e.no_tangential_hessian, &e.no_irradiance};
}

/// Of the light that arrives: with the sign of a form factor whose vertices run clockwise.
IrradianceDerivatives<Multiprecision> irradianceOf(const OracleValue& value, int sign) {
  const Multiprecision factor = sign * pi<Multiprecision>();
  return {{factor * value.form_factor},
          {factor * value.gradient},
          {factor * value.hessian},
          {Matrix2<Multiprecision>(factor * value.tangential_hessian)},
          {factor * value.rotational_gradient}};
}

void addPolygon(const BoundedEvaluator& evaluator, const Oracle& oracle, const Configuration& c, Pairs& pairs) {
  const PolygonEvaluation actual = evaluator.polygon(c);
  const std::optional<OracleValue> value = oracle.evaluate(c);
  if (!value) return;
  const Multiprecision irradiance = pi<Multiprecision>() * value->form_factor;
  int sign = irradiance < 0 ? -1 : 1;
  if (abs(irradiance) <= actual.bounds.irradiance) {
    // Which side is seen is then not to be told from irradiance, and either is right.
    const auto gradientError = [&](int s) {
      return errorOf(irradianceOf(*value, s).gradient.value, actual.derivatives.gradient.value);
    };
    sign = gradientError(1) <= gradientError(-1) ? 1 : -1;
  }
  static const std::string exists;
  addPairs<3>(irradianceOf(*value, sign), actual.derivatives, actual.bounds,
              {&exists, &actual.no_gradient, &actual.no_hessian, &actual.no_gradient, &exists}, pairs);
}

void addScene(const BoundedEvaluator& evaluator, const OccludedScene& scene, Pairs& pairs) {
  const SceneEvaluation<3> actual = evaluator.scene(scene);
  addPairs<3>(FrozenView(scene).formulas(), actual.derivatives, actual.bounds, reasonsOf(actual), pairs);
}

void addSegment(const BoundedEvaluator& evaluator, const FlatlandConfiguration& c, Pairs& pairs) {
  const auto exactly = [](const Eigen::Vector2d& v) {
    return Vector2<Multiprecision>(Multiprecision(v(0)), Multiprecision(v(1)));
  };
  const SceneEvaluation<2> actual = evaluator.segment(c);
  const Vector2<Multiprecision> normal = exactly(c.receiver.normal);
  const ClippedSegment<Multiprecision> clipped = clipSegment<Multiprecision>(
      exactly(c.segment.vertices[0]), exactly(c.segment.vertices[1]), exactly(c.receiver.position), normal);
  if (!clipped.is_visible) return;
  addPairs<2>(segmentBoundaryForm<Multiprecision>(clipped, normal).derivatives, actual.derivatives, actual.bounds,
              reasonsOf(actual), pairs);
}

void append(const BoundedEvaluator& evaluator, TightnessInputs inputs, std::string_view family, const Pairs& pairs,
            std::vector<BoundTightness>& all) {
  for (std::size_t i = 0; i < kQuantities.size(); ++i) {
    BoundTightness tightness = tightnessOf(pairs[i]);
    tightness.evaluator = evaluator.name;
    tightness.inputs = inputs;
    tightness.family = family;
    tightness.quantity = kQuantities[i];
    all.push_back(std::move(tightness));
  }
}

SceneEvaluation<3> sceneByLibrary(const OccludedScene& scene) {
  return SceneEvaluator(scene.polygons).evaluate(scene.receiver);
}

SceneEvaluation<2> segmentByLibrary(const FlatlandConfiguration& c) {
  const SegmentEvaluation evaluation = evaluateSegment(c.segment, 0, c.receiver);
  SceneEvaluation<2> result = darkScene<2>();
  result.derivatives = evaluation.derivatives;
  result.bounds = evaluation.bounds;
  result.no_gradient = evaluation.no_gradient;
  result.no_hessian = evaluation.no_hessian;
  result.no_tangential_hessian = evaluation.no_gradient;
  return result;
}

}  // namespace

std::vector<BoundedEvaluator> boundedEvaluators() {
  std::vector<BoundedEvaluator> evaluators;
  evaluators.push_back({"production", [](const Configuration& c) { return evaluatePolygon(c.polygon, 0, c.receiver); },
                        sceneByLibrary, segmentByLibrary});
  for (const Rung rung : kRungs) {
    evaluators.push_back({std::string("certified, ") + nameOf(rung),
                          [rung](const Configuration& c) {
                            return certifyPolygonAt(rung, c.polygon, 0, c.receiver, kDefaultTolerance).evaluation;
                          },
                          {},
                          {}});
  }
  evaluators.push_back(
      {"certified to 1e-12",
       [](const Configuration& c) { return certifyPolygon(c.polygon, 0, c.receiver, kDefaultTolerance).evaluation; },
       [](const OccludedScene& scene) {
         return certifyScene(SceneEvaluator(scene.polygons), scene.receiver, kDefaultTolerance).evaluation;
       },
       {}});
  return evaluators;
}

const char* nameOf(TightnessInputs inputs) {
  switch (inputs) {
    case TightnessInputs::kPolygons:
      return "polygons";
    case TightnessInputs::kScenes:
      return "scenes";
    case TightnessInputs::kSegments:
      return "segments";
  }
  return "";
}

std::string figuresOf(const BoundTightness& t) {
  if (t.values == 0) return "-";
  std::string text;
  if (t.compared() > 0) {
    text = figureText(t.least) + ", " + figureText(t.median) + ", " + figureText(t.percentile_99) + ", " +
           figureText(t.largest);
  }
  if (t.exact > 0) text += (text.empty() ? "" : "; ") + std::to_string(t.exact) + " exact";
  if (t.unbounded > 0) text += (text.empty() ? "" : "; ") + std::to_string(t.unbounded) + " without a bound";
  return text;
}

std::vector<TightnessTable> tightnessTables(const std::vector<BoundTightness>& tightness) {
  std::vector<TightnessTable> tables;
  for (const BoundTightness& t : tightness) {
    if (tables.empty() || tables.back().evaluator != t.evaluator || tables.back().inputs != t.inputs) {
      tables.push_back({t.evaluator, t.inputs, {}});
    }
    std::vector<std::vector<BoundTightness>>& families = tables.back().families;
    if (families.empty() || families.back().front().family != t.family) families.emplace_back();
    families.back().push_back(t);
  }
  return tables;
}

BoundTightness tightnessOf(const std::vector<BoundAndError>& values) {
  BoundTightness tightness;
  tightness.values = values.size();
  std::vector<double> ratios;
  for (const auto& [bound, error] : values) {
    if (error == 0.0 && bound >= 0.0) {
      ++tightness.exact;
    } else if (std::isinf(bound)) {
      ++tightness.unbounded;
    } else {
      // What is not a number holds nothing.
      ratios.push_back(std::isnan(bound) || std::isnan(error) ? 0.0 : bound / error);
    }
  }
  if (ratios.empty()) return tightness;
  std::ranges::sort(ratios);
  const auto reachedBy = [&](std::size_t percent) { return ratios[(ratios.size() * percent + 99) / 100 - 1]; };
  tightness.least = ratios.front();
  tightness.median = reachedBy(50);
  tightness.percentile_99 = reachedBy(99);
  tightness.largest = ratios.back();
  return tightness;
}

std::vector<BoundTightness> measureTightness(const BoundedEvaluator& evaluator, std::size_t count, std::uint64_t seed) {
  std::vector<BoundTightness> all;
  const auto unlessRefused = [](const auto& work) {
    try {
      work();
    } catch (const InvalidScene&) {
      // No number, no bound.
    }
  };
  if (evaluator.polygon) {
    const Oracle oracle = multiprecisionOracle();
    for (const InputFamily& family : inputFamilies()) {
      Pairs pairs;
      for (const Configuration& c : drawInputs(family, count, seed)) {
        unlessRefused([&] { addPolygon(evaluator, oracle, c, pairs); });
      }
      append(evaluator, TightnessInputs::kPolygons, family.name, pairs, all);
    }
  }
  if (evaluator.scene) {
    for (const SceneFamily& family : sceneFamilies()) {
      Pairs pairs;
      for (std::size_t k = 0; k < count; ++k) {
        const OccludedScene scene = drawScene(family, seed, k);
        unlessRefused([&] { addScene(evaluator, scene, pairs); });
      }
      append(evaluator, TightnessInputs::kScenes, family.name, pairs, all);
    }
  }
  if (evaluator.segment) {
    for (const FlatlandFamily& family : flatlandFamilies()) {
      Pairs pairs;
      for (std::size_t k = 0; k < count; ++k) {
        KeyedRandom random(seed, family.name, k);
        const FlatlandConfiguration c = family.draw(random);
        unlessRefused([&] { addSegment(evaluator, c, pairs); });
      }
      append(evaluator, TightnessInputs::kSegments, family.name, pairs, all);
    }
  }
  return all;
}

}  // namespace irradiff
