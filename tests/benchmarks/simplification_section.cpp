#include "tests/benchmarks/simplification_section.h"

#include "derivatives/boundary/boundary_sums.h"
#include "derivatives/boundary/edge_arcs.h"
#include "derivatives/form_factor/polygon_evaluation.h"
#include "derivatives/form_factor/prepared_polygon.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "experiments/figures/derivative_map.h"
#include "experiments/inspection/evaluation_cost.h"
#include "experiments/io/scene_file.h"
#include "tests/benchmarks/ratio_reporter.h"
#include "verification/checks/random.h"

#include <Eigen/Core>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iterator>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {

namespace {

constexpr std::uint64_t kSeed = 2013;
constexpr int kRounds = 11;

using Eigen::Vector3d;

/// Seconds of the processor for one call, as often as it takes to fill a few milliseconds.
double secondsFor(const std::function<void()>& work) {
  constexpr double kLeast = 0.004;
  std::size_t calls = 1;
  while (true) {
    const std::clock_t start = std::clock();
    for (std::size_t i = 0; i < calls; ++i) work();
    const double elapsed = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    if (elapsed >= kLeast) return elapsed / static_cast<double>(calls);
    calls *= 2;
  }
}

Polygon square(const std::string& name, const Vector3d& centre, double half_width, double radiance) {
  const Vector3d u(half_width, 0.0, 0.0);
  const Vector3d v(0.0, half_width, 0.0);
  return {name, {centre - u - v, centre + u - v, centre + u + v, centre - u + v}, radiance};
}

const Receiver kReceiver{{0.05, -0.03, 0.0}, {0.0, 0.0, 1.0}};

/// What evaluates a composition at the receiver.
std::function<void()> sumOf(const SceneEvaluator& evaluator, const SceneComposition& scene) {
  return
      [&evaluator, scene] { benchmark::DoNotOptimize(evaluator.evaluate(kReceiver, scene, ApparentVertices::kMove)); };
}

/// All that is seen as if it were partly hidden.
SceneComposition general(const SceneEvaluator& evaluator) {
  SceneComposition scene = evaluator.compose(kReceiver);
  for (const std::size_t i : scene.whole) scene.partly_hidden[i] = evaluator.polygons()[i].radiance;
  scene.whole.clear();
  scene.view = evaluator.view(kReceiver);
  return scene;
}

void printSaving(std::ostream& out, const std::string& what, const std::function<double()>& without,
                 const std::function<double()>& with) {
  std::vector<double> ratios, microseconds;
  for (int round = 0; round < kRounds; ++round) {
    const double simplified = with();
    ratios.push_back(without() / simplified);
    microseconds.push_back(1e6 * simplified);
  }
  out << std::left << std::setw(66) << what << std::setw(26) << spread(microseconds, 2) << spread(ratios, 2) << '\n';
}

void printSavings(std::ostream& out) {
  out << "\nWhat simplifications save: an evaluation with each, microseconds; without : with\n";
  const auto evaluating = [](const SceneEvaluator& evaluator) {
    return [&evaluator] { return secondsFor([&] { benchmark::DoNotOptimize(evaluator.evaluate(kReceiver)); }); };
  };
  const auto composing = [](const SceneEvaluator& evaluator) {
    return secondsFor([&] { benchmark::DoNotOptimize(evaluator.compose(kReceiver)); });
  };
  const auto viewing = [](const SceneEvaluator& evaluator) {
    return secondsFor([&] { benchmark::DoNotOptimize(evaluator.view(kReceiver)); });
  };

  const SceneEvaluator alone(std::vector<Polygon>{square("lamp", {0, 0, 2}, 0.5, 1.0)});
  const std::function<void()> alone_general = sumOf(alone, general(alone));
  printSaving(
      out, "no visibility where nothing can hide (a square)",
      [&] { return viewing(alone) + secondsFor(alone_general); }, evaluating(alone));

  std::vector<Polygon> tiles;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) tiles.push_back(square("tile", {i - 1.5, j - 1.5, 2.0}, 0.4, 1.0 + i + j));
  }
  const SceneEvaluator tiled(tiles);
  const std::function<void()> tiled_general = sumOf(tiled, general(tiled));
  printSaving(
      out, "polygons seen whole as if alone (16 squares side by side)",
      [&] { return viewing(tiled) + secondsFor(tiled_general); }, evaluating(tiled));

  std::vector<Polygon> screened = tiles;
  screened.push_back(square("wall", {0, 0, 1.5}, 3.0, 1.0));
  const SceneEvaluator hidden(screened);
  SceneComposition with_hidden = hidden.compose(kReceiver);
  for (std::size_t i = 0; i < tiles.size(); ++i) with_hidden.whole.push_back(i);
  const std::function<void()> sum_with_hidden = sumOf(hidden, with_hidden);
  printSaving(
      out, "hidden polygons skipped (16 of 17 squares)",
      [&] { return composing(hidden) + secondsFor(sum_with_hidden); }, evaluating(hidden));

  std::vector<Polygon> dark_tiles = tiles;
  for (std::size_t i = 1; i < dark_tiles.size(); ++i) dark_tiles[i].radiance = 0.0;
  const SceneEvaluator dark(dark_tiles);
  SceneComposition with_black = dark.compose(kReceiver);
  for (std::size_t i = 1; i < tiles.size(); ++i) with_black.whole.push_back(i);
  const std::function<void()> sum_with_black = sumOf(dark, with_black);
  printSaving(
      out, "black polygons skipped (15 of 16 squares)", [&] { return composing(dark) + secondsFor(sum_with_black); },
      evaluating(dark));

  // A bar across a lamp: what is seen on both sides of it ends in four apparent vertices.
  std::vector<Polygon> barred{square("lamp", {0, 0, 2}, 0.5, 1.0),
                              {"bar", {{-1, -0.1, 1}, {1, -0.1, 1}, {1, 0.1, 1}, {-1, 0.1, 1}}, 0.0}};
  const SceneEvaluator bars(barred);
  const SceneComposition moving = bars.compose(kReceiver);
  SceneComposition still = moving;
  still.view.apparent_vertices.clear();
  const std::function<void()> sum_moving = sumOf(bars, moving);
  const std::function<void()> sum_still = sumOf(bars, still);
  printSaving(
      out, "no motion of apparent vertices (4 of them, a bar before a square)",
      [&] { return composing(bars) + secondsFor(sum_moving); },
      [&] { return composing(bars) + secondsFor(sum_still); });

  const Polygon above{"above", {{1, -1, 0.1}, {1, 1, 0.1}, {1, 1, 1}, {1, -1, 1}}, 1.0};
  const Polygon cut{"cut", {{1, -1, -0.5}, {1, 1, -0.5}, {1, 1, 1}, {1, -1, 1}}, 1.0};
  const auto evaluatingPolygon = [](const Polygon& polygon) {
    return [&polygon] { return secondsFor([&] { benchmark::DoNotOptimize(evaluatePolygon(polygon, 0, kReceiver)); }); };
  };
  printSaving(out, "no cut above the horizon (a square; cut, it has three edges)", evaluatingPolygon(cut),
              evaluatingPolygon(above));

  const Polygon small = square("small", {0, 0, 2}, 1e-3, 1.0);
  printSaving(
      out, "the area rule for a small square, instead of edges that cancel",
      [&] {
        return secondsFor([&] {
          const PreparedPolygon prepared = preparePolygon(small, 0, kReceiver);
          benchmark::DoNotOptimize(boundarySums(polygonBoundary(prepared.clipped, kReceiver.normal), kReceiver.normal));
        });
      },
      evaluatingPolygon(small));
  out << "Below 1 nothing is saved but digits: the area rule keeps those that edges lose, and a polygon that is seen "
         "whole\n"
         "has the same bits and the same bound whatever else is in the scene.\n";
}

/// A scene whose cost is estimated and measured, as the mean over receivers.
struct CostCase {
  std::string name;
  std::vector<Polygon> polygons;
  std::vector<Receiver> receivers;
};

std::vector<Receiver> receiversOf(const Scene& scene) {
  std::vector<Receiver> receivers;
  const ReceiverGrid& grid = *scene.grid;
  for (std::size_t j = grid.height / 8; j < grid.height; j += grid.height / 4) {
    for (std::size_t i = grid.width / 8; i < grid.width; i += grid.width / 4) receivers.push_back(grid.receiver(i, j));
  }
  return receivers;
}

std::vector<CostCase> costCases() {
  std::vector<CostCase> cases;
  for (const char* name : {"one_occluder", "figure5", "three_tilted_occluders", "two_emitters", "slab_through_emitter",
                           "black_square_in_box", "cornell_box"}) {
    const std::string path = std::string(IRRADIFF_SCENE_FOLDER) + "/" + name + ".json";
    std::ifstream file(path);
    if (!file) throw std::runtime_error(path + ": cannot be read");
    const Scene scene = parseScene(std::string(std::istreambuf_iterator<char>(file), {}));
    cases.push_back({name, scene.polygons, receiversOf(scene)});
  }
  KeyedRandom random(kSeed, "cost", 0);
  const auto below = [&] {
    std::vector<Receiver> receivers;
    for (int i = 0; i < 8; ++i) {
      const double x = random.between(-0.5, 0.5);
      receivers.push_back({{x, random.between(-0.5, 0.5), 0.0}, {0, 0, 1}});
    }
    return receivers;
  };
  cases.push_back({"a triangle", {{"lamp", {{-1, -1, 2}, {1, -1, 2}, {0, 1, 2}}, 1.0}}, below()});
  Polygon round{"lamp", {}, 1.0};
  for (int i = 0; i < 32; ++i) round.vertices.emplace_back(std::cos(i * 0.19), std::sin(i * 0.19), 2.0);
  cases.push_back({"a polygon of 32 edges", {round}, below()});
  cases.push_back({"a small square", {square("lamp", {0, 0, 2}, 1e-3, 1.0)}, below()});
  for (const std::size_t count : {4U, 16U, 40U}) {
    for (const double size : {0.1, 0.35}) {
      std::vector<Polygon> polygons{square("lamp", {0, 0, 3}, 2.0, 1.0)};
      while (polygons.size() < count) {
        const double x = random.between(-1.0, 1.0);
        const double y = random.between(-1.0, 1.0);
        const double height = 1.2 + 0.6 * static_cast<double>(polygons.size()) / static_cast<double>(count);
        polygons.push_back(square("screen", {x, y, height}, size, 0.1));
      }
      cases.push_back({std::to_string(count) + (size > 0.2 ? " squares over each other" : " squares side by side"),
                       polygons, below()});
    }
  }
  return cases;
}

void printCosts(std::ostream& out) {
  const SceneEvaluator unit(std::vector<Polygon>{square("lamp", {0, 0, 2}, 0.5, 1.0)});
  out << "\nThe cost of an evaluation in unhidden squares, as irradiff inspect estimates it and as measured\n"
      << "scene                              estimated   measured                      estimated : measured\n";
  for (const CostCase& c : costCases()) {
    const SceneEvaluator evaluator(c.polygons);
    double estimated = 0.0;
    for (const Receiver& r : c.receivers) {
      estimated += estimateCost(workOf(evaluator, evaluator.compose(r), evaluator.evaluate(r), r));
    }
    estimated /= static_cast<double>(c.receivers.size());
    std::vector<double> measured, ratios;
    for (int round = 0; round < kRounds; ++round) {
      const double one = secondsFor([&] { benchmark::DoNotOptimize(unit.evaluate(kReceiver)); });
      const double all = secondsFor([&] {
        for (const Receiver& r : c.receivers) benchmark::DoNotOptimize(evaluator.evaluate(r));
      });
      measured.push_back(all / (one * static_cast<double>(c.receivers.size())));
      ratios.push_back(estimated / measured.back());
    }
    out << std::left << std::setw(35) << c.name << std::setw(12) << std::fixed << std::setprecision(1) << estimated
        << std::setw(30) << spread(measured, 1) << spread(ratios, 2) << '\n';
  }
}

}  // namespace

void printSimplificationSection(std::ostream& out) {
  printSavings(out);
  out << std::flush;
  printCosts(out);
}

}  // namespace irradiff
