#include "verification/occlusion/scene_checks.h"

#include "verification/checks/verdict_builder.h"
#include "verification/occlusion/scene_invariants.h"
#include "verification/occlusion/scene_mistakes.h"
#include "verification/visible_region/region_differences.h"

#include <algorithm>
#include <iterator>
#include <numbers>

namespace irradiff {
namespace {

using MultiprecisionValues = Eigen::Matrix<Multiprecision, Eigen::Dynamic, Eigen::Dynamic>;

MultiprecisionValues valueOf(const RegionValue& value, Quantity quantity) {
  switch (quantity) {
    case Quantity::kIrradiance:
      return MultiprecisionValues::Constant(1, 1, value.irradiance);
    case Quantity::kGradient:
      return value.gradient;
    case Quantity::kHessian:
      return value.hessian;
    default:
      return {};
  }
}

double largestOf(const MultiprecisionValues& values) {
  Multiprecision largest = 0;
  for (Eigen::Index i = 0; i < values.size(); ++i) largest = std::max<Multiprecision>(largest, abs(values(i)));
  return largest.convert_to<double>();
}

double errorOf(const Eigen::MatrixXd& actual, const MultiprecisionValues& expected) {
  if (!actual.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  MultiprecisionValues error = expected;
  for (Eigen::Index i = 0; i < error.size(); ++i) error(i) -= Multiprecision(actual(i));
  return largestOf(error);
}

Eigen::MatrixXd rounded(const MultiprecisionValues& values) {
  Eigen::MatrixXd result(values.rows(), values.cols());
  for (Eigen::Index i = 0; i < values.size(); ++i) result(i) = values(i).convert_to<double>();
  return result;
}

/// 2^-150 of the scene's size: the differences' own error is far below any tolerance, 1e-16 from an event too.
RegionValue regionValueOf(const OccludedScene& scene) {
  return differentiateRegions(CutScene(scene.polygons), scene.receiver, ldexp(Multiprecision(extentOf(scene)), -150));
}

double largestRadiance(const OccludedScene& scene) {
  double largest = 0.0;
  for (const Polygon& polygon : scene.polygons) largest = std::max(largest, polygon.radiance);
  return largest;
}

}  // namespace

std::vector<Verdict> checkVisibleRegions(const SceneCandidate& candidate, const SceneFamily& family,
                                         const OcclusionOptions& options) {
  std::vector<VerdictBuilder> values;
  std::vector<VerdictBuilder> bounds;
  for (const Quantity quantity : kSceneQuantities) {
    const bool is_irradiance = quantity == Quantity::kIrradiance;
    values.emplace_back(
        candidate.name, "visible regions", std::string(family.name), quantity, options.tolerance,
        is_irradiance ? "relative to pi times the largest radiance; as asked for" : "relative; as asked for");
    bounds.emplace_back(candidate.name, "claimed bound", std::string(family.name), quantity, 1.0,
                        "error in units of the candidate's own bound");
  }
  for (std::size_t i = 0; i < options.scenes; ++i) {
    const OccludedScene scene = drawScene(family, options.seed, i);
    values.front().attempt(scene, [&] {
      const SceneResult result = candidate.evaluate(scene);
      const RegionValue expected = regionValueOf(scene);
      for (std::size_t q = 0; q < kSceneQuantities.size(); ++q) {
        const Quantity quantity = kSceneQuantities[q];
        const std::optional<Eigen::MatrixXd> actual = result.get(quantity);
        if (!actual) continue;
        const MultiprecisionValues value = valueOf(expected, quantity);
        const double error = errorOf(*actual, value);
        const double size =
            quantity == Quantity::kIrradiance ? std::numbers::pi * largestRadiance(scene) : largestOf(value);
        values[q].add(error == 0.0 ? 0.0 : error / size, 0.0, scene, rounded(value), *actual);
        if (result.bounds) {
          bounds[q].add(error == 0.0 ? 0.0 : error / boundOf(*result.bounds, quantity), 0.0, scene, rounded(value),
                        *actual);
        }
      }
    });
  }
  std::vector<Verdict> verdicts;
  for (const std::vector<VerdictBuilder>* builders : {&values, &bounds}) {
    for (const VerdictBuilder& builder : *builders) {
      if (Verdict verdict = builder.finish(); verdict.inputs > 0) verdicts.push_back(std::move(verdict));
    }
  }
  return verdicts;
}

std::vector<Verdict> checkOcclusion(const SceneCandidate& candidate, const OcclusionOptions& options) {
  std::vector<Verdict> verdicts;
  const auto append = [&verdicts](std::vector<Verdict> more) {
    std::move(more.begin(), more.end(), std::back_inserter(verdicts));
  };
  for (const SceneFamily& family : sceneFamilies()) {
    if (family.is_near_events && !options.includes_events) continue;
    append(checkVisibleRegions(candidate, family, options));
    append(checkSceneInvariants(candidate, family, options));
  }
  append(checkConstantRooms(candidate, options));
  return verdicts;
}

}  // namespace irradiff
