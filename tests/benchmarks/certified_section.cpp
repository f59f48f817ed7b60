#include "tests/benchmarks/certified_section.h"

#include "derivatives/form_factor/polygon_evaluation.h"
#include "derivatives/scene/invalid_scene.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "tests/benchmarks/ratio_reporter.h"
#include "verification/certified/certified_polygon.h"
#include "verification/certified/certified_scene.h"
#include "verification/checks/input_families.h"
#include "verification/occlusion/scene_families.h"

#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <iomanip>
#include <ostream>
#include <string>
#include <vector>

namespace irradiff {

namespace {

constexpr std::uint64_t kSeed = 2012;
constexpr int kRounds = 11;
constexpr std::size_t kPolygons = 1000;
constexpr std::size_t kScenes = 100;

/// Of one pass over all inputs.
template <class Inputs, class Work>
double microseconds(const Inputs& inputs, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  for (const auto& input : inputs) work(input);
  const auto end = std::chrono::steady_clock::now();
  return std::chrono::duration<double, std::micro>(end - start).count() / static_cast<double>(inputs.size());
}

/// Ratios of two times of the same round.
template <class Inputs, class Reference, class Work>
std::vector<double> ratios(const Inputs& inputs, const Reference& reference, const Work& work) {
  std::vector<double> result;
  for (int round = 0; round < kRounds; ++round) {
    const double reference_time = microseconds(inputs, reference);
    result.push_back(microseconds(inputs, work) / reference_time);
  }
  return result;
}

/// Those that the plain path evaluates.
std::vector<Configuration> polygonsOf(const InputFamily& family) {
  std::vector<Configuration> valid;
  for (const Configuration& c : drawInputs(family, kPolygons, kSeed)) {
    try {
      evaluatePolygon(c.polygon, 0, c.receiver);
      valid.push_back(c);
    } catch (const InvalidScene&) {
      // The receiver is on it.
    }
  }
  return valid;
}

void plain(const Configuration& c) { benchmark::DoNotOptimize(evaluatePolygon(c.polygon, 0, c.receiver)); }
void certified(const Configuration& c) {
  benchmark::DoNotOptimize(certifyPolygon(c.polygon, 0, c.receiver, kDefaultTolerance));
}

void printPolygons(std::ostream& out) {
  out << "\nProven bounds, polygons: certifyPolygon to 1e-12 over evaluatePolygon, median (smallest .. largest) over "
      << kRounds << " rounds of " << kPolygons << "\n(asked for generic: at most 3, and at most 1 % above double)\n"
      << std::left << std::setw(20) << "family" << std::setw(28) << "time over the plain path"
      << "% above double\n";
  for (const InputFamily& family : inputFamilies()) {
    const std::vector<Configuration> inputs = polygonsOf(family);
    std::size_t climbing = 0;
    for (const Configuration& c : inputs) {
      if (certifyPolygon(c.polygon, 0, c.receiver, kDefaultTolerance).rung != Rung::kDouble) ++climbing;
    }
    out << std::setw(20) << std::string(family.name) << std::setw(28) << spread(ratios(inputs, plain, certified), 2)
        << std::setprecision(3) << 100.0 * static_cast<double>(climbing) / static_cast<double>(inputs.size()) << '\n';
  }
}

void printRungs(std::ostream& out) {
  const std::vector<Configuration> inputs = polygonsOf(inputFamily("generic"));
  out << "\nRungs, generic polygons: time over evaluatePolygon\n";
  for (const Rung rung : kRungs) {
    const auto at_rung = [rung](const Configuration& c) {
      benchmark::DoNotOptimize(certifyPolygonAt(rung, c.polygon, 0, c.receiver, kDefaultTolerance));
    };
    out << std::setw(20) << nameOf(rung) << spread(ratios(inputs, plain, at_rung), 1) << '\n';
  }
}

struct SceneInput {
  SceneEvaluator evaluator;
  Receiver receiver;
};

void printScenes(std::ostream& out) {
  out << "\nProven bounds, scenes that hide each other: certifyScene to 1e-12 over SceneEvaluator::evaluate, rounds of "
      << kScenes << '\n';
  for (const SceneFamily& family : sceneFamilies()) {
    std::vector<SceneInput> inputs;
    std::size_t climbing = 0;
    for (std::size_t i = 0; i < kScenes; ++i) {
      const OccludedScene scene = drawScene(family, kSeed, i);
      SceneInput input{SceneEvaluator(scene.polygons), scene.receiver};
      try {
        input.evaluator.evaluate(input.receiver);
        if (certifyScene(input.evaluator, input.receiver, kDefaultTolerance).rung() != Rung::kDouble) ++climbing;
        inputs.push_back(std::move(input));
      } catch (const InvalidScene&) {
        // The receiver is on a polygon.
      }
    }
    const auto evaluate = [](const SceneInput& s) { benchmark::DoNotOptimize(s.evaluator.evaluate(s.receiver)); };
    const auto certify = [](const SceneInput& s) {
      benchmark::DoNotOptimize(certifyScene(s.evaluator, s.receiver, kDefaultTolerance));
    };
    out << std::setw(20) << std::string(family.name) << std::setw(28) << spread(ratios(inputs, evaluate, certify), 2)
        << 100.0 * static_cast<double>(climbing) / static_cast<double>(inputs.size()) << '\n';
  }
}

}  // namespace

void printCertifiedSection(std::ostream& out) {
  printPolygons(out);
  printRungs(out);
  printScenes(out);
  out << std::flush;
}

}  // namespace irradiff
