#include "tests/flatland/flatland_scene_check.h"

#include "derivatives/flatland/flatland_scene.h"
#include "tests/flatland/rational_scene.h"

#include <algorithm>
#include <array>
#include <sstream>

namespace irradiff {
namespace {

constexpr int kStepExponent = -130;

Rational step() { return Rational(std::ldexp(1.0, kStepExponent)); }

ManyDigits inSteps() { return ManyDigits(std::ldexp(1.0, kStepExponent)); }

RationalPoint steps(int x, int y) { return {x * step(), y * step()}; }

struct Derivatives {
  ManyDigits irradiance;
  std::array<ManyDigits, 2> gradient;
  std::array<std::array<ManyDigits, 2>, 2> hessian;
};

bool sameTopology(const std::vector<RationalInterval>& a, const std::vector<RationalInterval>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const RationalInterval& s, const RationalInterval& t) { return s.segment == t.segment; });
}

/// Central differences; `is_regular` tells whether the same is seen from all points of the stencil.
Derivatives differences(const RationalScene& scene, bool& is_regular) {
  std::array<std::array<ManyDigits, 3>, 3> e;
  const std::vector<RationalInterval> middle = scene.visible().intervals;
  is_regular = true;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const RationalScene::Sight sight = scene.visible(steps(static_cast<int>(i) - 1, static_cast<int>(j) - 1));
      e.at(i).at(j) = sight.irradiance();
      is_regular = is_regular && sameTopology(middle, sight.intervals);
    }
  }
  const ManyDigits h = inSteps();
  const ManyDigits mixed = (e[2][2] - e[2][0] - e[0][2] + e[0][0]) / (4 * h * h);
  return {e[1][1],
          {ManyDigits((e[2][1] - e[0][1]) / (2 * h)), ManyDigits((e[1][2] - e[1][0]) / (2 * h))},
          {{{ManyDigits((e[2][1] - 2 * e[1][1] + e[0][1]) / (h * h)), mixed},
            {mixed, ManyDigits((e[1][2] - 2 * e[1][1] + e[1][0]) / (h * h))}}}};
}

struct Error {
  double absolute = 0.0;
  double norm = 0.0;

  void add(double actual, const ManyDigits& expected) {
    absolute = std::max(absolute, abs(ManyDigits(actual - expected)).convert_to<double>());
    norm = std::max(norm, abs(expected).convert_to<double>());
  }
};

void keepLargest(double value, double& largest, const FlatlandScene& scene, const char* quantity, std::string& where) {
  if (value > largest || !(value == value)) {
    largest = value;
    where = std::string(quantity) + ": " + sceneLine(scene);
  }
}

void judge(const SceneEvaluation<2>& actual, const FlatlandScene& scene, SceneVerdict& verdict) {
  const RationalScene oracle(scene.segments, scene.receiver, {});
  bool is_regular = false;
  const Derivatives expected = differences(oracle, is_regular);
  if (!is_regular) {
    // Not even 2^-130 from an event, and yet the candidate has derivatives: checkExistence() is for those.
    ++verdict.at_events;
    return;
  }
  std::array<Error, 3> errors;
  errors[0].add(actual.derivatives.irradiance.value, expected.irradiance);
  for (std::size_t i = 0; i < 2; ++i) {
    errors[1].add(actual.derivatives.gradient.value(static_cast<Eigen::Index>(i)), expected.gradient.at(i));
    for (std::size_t j = 0; j < 2; ++j) {
      errors[2].add(actual.derivatives.hessian.value(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)),
                    expected.hessian.at(i).at(j));
    }
  }
  const std::array<double, 3> bounds = {actual.bounds.irradiance, actual.bounds.gradient, actual.bounds.hessian};
  const std::array<const char*, 3> names = {"irradiance", "gradient", "hessian"};
  ++verdict.judged;
  const bool is_far = oracle.distanceFromEvents() >= kFarFromEvents;
  verdict.far += is_far ? 1 : 0;
  for (std::size_t q = 0; q < 3; ++q) {
    // The differences themselves are right to about 1e-60 of the largest term.
    if (errors.at(q).absolute > 1e-50 * errors.at(q).norm && errors.at(q).absolute > 1e-50) {
      keepLargest(errors.at(q).absolute / bounds.at(q), verdict.bound_share, scene, names.at(q), verdict.worst_bound);
    }
    if (is_far && errors.at(q).norm > 1e-50) {
      keepLargest(errors.at(q).absolute / errors.at(q).norm, verdict.norm_wise_far, scene, names.at(q),
                  verdict.worst_far);
    }
  }
}

}  // namespace

SceneEvaluation<2> evaluateByLibrary(const FlatlandScene& scene) {
  return evaluateScene(scene.segments, scene.receiver);
}

std::string SceneVerdict::text() const {
  std::ostringstream out;
  out.precision(3);
  out << judged << " judged, " << at_events << " at events; error at most " << bound_share << " of the bound; " << far
      << " far from events, there at most " << norm_wise_far << " norm-wise\n  worst of bound: " << worst_bound
      << "\n  worst far: " << worst_far << '\n';
  return out.str();
}

SceneVerdict checkScenes(const SceneCandidate& candidate, const SceneFamily& family, std::size_t count,
                         std::uint64_t seed) {
  SceneVerdict verdict;
  for (std::size_t i = 0; i < count; ++i) {
    KeyedRandom random(seed, family.name, i);
    const FlatlandScene scene = family.draw(random);
    const SceneEvaluation<2> evaluation = candidate(scene);
    if (evaluation.no_gradient.empty() && evaluation.no_hessian.empty()) {
      judge(evaluation, scene, verdict);
    } else {
      ++verdict.at_events;
    }
  }
  return verdict;
}

std::string checkExistence(const SceneCandidate& candidate, const FlatlandScene& scene) {
  const SceneEvaluation<2> actual = candidate(scene);
  const RationalScene oracle(scene.segments, scene.receiver, {});
  // The last two are oblique to all rays between small integers.
  constexpr std::array<std::array<int, 2>, 12> kDirections = {{{1, 0},
                                                               {-1, 0},
                                                               {0, 1},
                                                               {0, -1},
                                                               {1, 1},
                                                               {-1, -1},
                                                               {1, -1},
                                                               {-1, 1},
                                                               {89, 233},
                                                               {-89, -233},
                                                               {144, -55},
                                                               {-144, 55}}};
  const ManyDigits h = inSteps();
  const ManyDigits here = oracle.visible().irradiance();
  const auto& d = actual.derivatives;
  if (!(abs(ManyDigits(d.irradiance.value - here)) <= actual.bounds.irradiance)) return "irradiance";
  const bool has_gradient = actual.no_gradient.empty();
  const bool has_hessian = actual.no_hessian.empty();
  bool is_kinked = false;
  bool is_one_sided = false;
  for (std::size_t k = 0; k < kDirections.size(); k += 2) {
    std::array<ManyDigits, 2> first;
    std::array<ManyDigits, 2> second;
    for (std::size_t side = 0; side < 2; ++side) {
      const auto [x, y] = kDirections.at(k + side);
      const RationalScene::Sight sight = oracle.visible(steps(x, y));
      // Beside an overlap of different radiances there is no irradiance. On the horizon its weight is 0, and the
      // gradient may exist.
      if (sight.has_tie) return has_hessian ? "a Hessian beside an overlap" : "";
      const ManyDigits once = sight.irradiance() - here;
      const ManyDigits twice = oracle.visible(steps(2 * x, 2 * y)).irradiance() - here;
      first.at(side) = once / h;
      second.at(side) = (twice - 2 * once) / (h * h);
      if (has_gradient) {
        const ManyDigits claimed = d.gradient.value(0) * ManyDigits(x) + d.gradient.value(1) * ManyDigits(y);
        const ManyDigits allowed = (std::abs(x) + std::abs(y)) * ManyDigits(actual.bounds.gradient) + 1e-30;
        if (!(abs(ManyDigits(claimed - first.at(side))) <= allowed)) return "gradient";
      }
      if (has_hessian) {
        const ManyDigits size = std::abs(x) + std::abs(y);
        const ManyDigits claimed = d.hessian.value(0, 0) * ManyDigits(x * x) +
                                   2 * d.hessian.value(0, 1) * ManyDigits(x * y) +
                                   d.hessian.value(1, 1) * ManyDigits(y * y);
        const ManyDigits allowed = size * size * ManyDigits(actual.bounds.hessian) + 1e-25;
        if (!(abs(ManyDigits(claimed - second.at(side))) <= allowed)) return "hessian";
      }
    }
    is_kinked = is_kinked || abs(ManyDigits(first[0] + first[1])) > 1e-25;
    is_one_sided = is_one_sided || abs(ManyDigits(second[0] - second[1])) > 1e-20;
  }
  if (!has_gradient && !is_kinked) return "a gradient that exists is refused";
  if (has_gradient && !has_hessian && !is_one_sided) return "a Hessian that exists is refused";
  return "";
}

}  // namespace irradiff
