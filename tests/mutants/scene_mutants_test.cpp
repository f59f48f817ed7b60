// Is there a single change of what finds and adds up visible regions that our checks would let pass?

#include "tests/mutants/formula_entry_points.h"
#include "verification/occlusion/scene_checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <memory>
#include <stdexcept>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 20120806;
constexpr std::size_t kFewestMutants = 20;

/// SceneEvaluator of a mutant, or unmutated, in a shared object that stays loaded as long as a copy lives.
SceneCandidate loadedEvaluator(const std::string& name, const std::filesystem::path& file) {
  // RTLD_LOCAL: no shared object finds its functions in another one.
  const std::shared_ptr<void> handle(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL), [](void* opened) {
    if (opened != nullptr) dlclose(opened);
  });
  void* symbol = handle ? dlsym(handle.get(), "answerScene") : nullptr;
  if (symbol == nullptr) throw std::runtime_error(dlerror());
  const auto answer_scene = reinterpret_cast<decltype(&answerScene)>(symbol);
  return {name, [handle, answer_scene](const OccludedScene& scene) {
            std::vector<double> vertices;
            std::vector<std::size_t> counts;
            std::vector<double> radiances;
            for (const Polygon& polygon : scene.polygons) {
              for (const Eigen::Vector3d& vertex : polygon.vertices) {
                vertices.insert(vertices.end(), vertex.begin(), vertex.end());
              }
              counts.push_back(polygon.vertices.size());
              radiances.push_back(polygon.radiance);
            }
            FormulaAnswer answer{};
            if (!answer_scene(vertices.data(), counts.data(), radiances.data(), scene.polygons.size(),
                              scene.receiver.position.data(), scene.receiver.normal.data(), &answer)) {
              throw std::domain_error("the evaluator does not accept the scene");
            }
            SceneResult result{
                answer.value, {}, {}, DerivativeBounds{answer.bounds[0], answer.bounds[1], answer.bounds[2]}};
            if (!std::isnan(answer.gradient[0])) result.gradient = Eigen::Vector3d(answer.gradient);
            if (!std::isnan(answer.hessian[0])) {
              result.hessian = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(answer.hessian);
            }
            return result;
          }};
}

/// Those of the folder's scene_libraries.txt, a line each.
std::vector<SceneCandidate> loadedEvaluators() {
  const char* folder = std::getenv("IRRADIFF_FORMULA_LIBRARIES");
  if (folder == nullptr) {
    throw std::runtime_error("IRRADIFF_FORMULA_LIBRARIES must name the folder of the compiled formulas; ctest does");
  }
  std::ifstream lines(std::filesystem::path(folder) / "scene_libraries.txt");
  std::vector<SceneCandidate> loaded;
  for (std::string line; std::getline(lines, line);) {
    loaded.push_back(loadedEvaluator(line.substr(0, line.find('.')), std::filesystem::path(folder) / (line + ".so")));
  }
  return loaded;
}

/// What fails first, over the families from the first on; empty if nothing does.
std::string firstFailure(const SceneCandidate& candidate) {
  for (const SceneFamily& family : sceneFamilies()) {
    const std::size_t scenes = family.is_near_events ? 30 : 3;
    const std::vector<Verdict> failed =
        failures(checkVisibleRegions(candidate, family, {.seed = kSeed, .scenes = scenes}));
    if (!failed.empty()) {
      return failed.front().check + ", " + failed.front().family + ", " + nameOf(failed.front().quantity);
    }
  }
  return "";
}

TEST(SceneMutants, EveryOneIsCaughtByVisibleRegions) {
  std::size_t mutants = 0;
  for (const SceneCandidate& candidate : loadedEvaluators()) {
    const std::string failure = firstFailure(candidate);
    std::cout << std::left << std::setw(36) << candidate.name << (failure.empty() ? "passes" : failure) << '\n';
    if (candidate.name == "unmutated") {
      EXPECT_EQ(failure, "");
      continue;
    }
    ++mutants;
    EXPECT_NE(failure, "") << candidate.name << " survived";
  }
  EXPECT_GE(mutants, kFewestMutants);
}

}  // namespace
}  // namespace irradiff
