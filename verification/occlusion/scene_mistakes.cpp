#include "verification/occlusion/scene_mistakes.h"

#include "verification/checks/error_diagnosis.h"
#include "verification/occlusion/scene_candidate.h"

#include <algorithm>
#include <exception>
#include <sstream>

namespace irradiff {
namespace {

/// Each polygon as if the others were not there.
SceneResult withoutOcclusion(const OccludedScene& scene) {
  const SceneCandidate library = libraryEvaluator();
  SceneResult sum{0.0, Eigen::Vector3d(Eigen::Vector3d::Zero()), Eigen::Matrix3d(Eigen::Matrix3d::Zero()), {}};
  for (const Polygon& polygon : scene.polygons) {
    const SceneResult alone = library.evaluate({{polygon}, scene.receiver});
    sum.irradiance += alone.irradiance;
    if (sum.gradient && alone.gradient) *sum.gradient += *alone.gradient;
    if (sum.hessian && alone.hessian) *sum.hessian += *alone.hessian;
    if (!alone.gradient) sum.gradient.reset();
    if (!alone.hessian) sum.hessian.reset();
  }
  return sum;
}

std::vector<UsualMistake> usualMistakes(Quantity quantity, const OccludedScene& scene) {
  std::vector<UsualMistake> mistakes;
  const auto add = [&](const std::string& text, const auto& evaluate) {
    try {
      if (const auto value = evaluate().get(quantity)) mistakes.push_back({text, *value});
    } catch (const std::exception&) {
      // The library refuses the changed scene, so whoever got a value did something else.
    }
  };
  add("occlusion is ignored: each polygon counts as if the others were not there",
      [&] { return withoutOcclusion(scene); });
  add("apparent vertices are held fixed: where one edge is seen on another, the crossing moves with the receiver",
      [&] { return libraryEvaluator(ApparentVertices::kFixed).evaluate(scene); });
  OccludedScene lamps = scene;
  std::erase_if(lamps.polygons, [](const Polygon& polygon) { return polygon.radiance == 0.0; });
  if (lamps.polygons.size() < scene.polygons.size()) {
    add("polygons of radiance 0 are ignored: they hide what is behind them",
        [&] { return libraryEvaluator().evaluate(lamps); });
  }
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
    OccludedScene fewer = scene;
    fewer.polygons.erase(fewer.polygons.begin() + static_cast<std::ptrdiff_t>(i));
    const bool is_last = i + 1 == scene.polygons.size();
    add((is_last ? "the last polygon" : "polygon " + std::to_string(i)) + " is ignored",
        [&] { return libraryEvaluator().evaluate(fewer); });
  }
  return mistakes;
}

}  // namespace

std::string likelyCause(Quantity quantity, const OccludedScene& scene, const Eigen::MatrixXd& expected,
                        const Eigen::MatrixXd& actual) {
  return diagnose(expected, actual, [&] { return usualMistakes(quantity, scene); });
}

std::string inWords(const OccludedScene& scene) {
  const auto black = std::ranges::count(scene.polygons, 0.0, &Polygon::radiance);
  std::ostringstream text;
  text.precision(2);
  text << scene.polygons.size() << " polygons, " << black << " of them black, within " << extentOf(scene);
  return text.str();
}

}  // namespace irradiff
