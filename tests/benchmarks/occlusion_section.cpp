#include "tests/benchmarks/occlusion_section.h"

#include "derivatives/visibility/scene_evaluation.h"
#include "derivatives/visibility/view_grid.h"
#include "experiments/figures/derivative_map.h"
#include "experiments/io/scene_file.h"
#include "tests/benchmarks/ratio_reporter.h"
#include "verification/checks/random.h"
#include "verification/exact_boundary/exact_evaluation.h"
#include "verification/exact_visibility/exact_visibility.h"

#include <Eigen/Core>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {

namespace {

constexpr std::uint64_t kSeed = 2012;
constexpr int kRounds = 5;

Scene figureScene() {
  const std::string path = std::string(IRRADIFF_SCENE_FOLDER) + "/figure5.json";
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  return parseScene(std::string(std::istreambuf_iterator<char>(file), {}));
}

template <class Work>
double seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Microseconds for a receiver: all of them, as often as it takes to fill `least` seconds.
template <class Evaluate>
double microseconds(const std::vector<Receiver>& receivers, double least, const Evaluate& evaluate) {
  double elapsed = 0.0;
  std::size_t passes = 0;
  while (elapsed < least || passes == 0) {
    elapsed += seconds([&] {
      for (const Receiver& receiver : receivers) benchmark::DoNotOptimize(evaluate(receiver));
    });
    ++passes;
  }
  return 1e6 * elapsed / static_cast<double>(passes * receivers.size());
}

void printRatios(std::ostream& out) {
  const Scene scene = figureScene();
  const SceneEvaluator evaluator(scene.polygons);
  // Every 64th of the map in both directions.
  std::vector<Receiver> receivers;
  for (std::size_t j = 32; j < 256; j += 64) {
    for (std::size_t i = 32; i < 256; i += 64) receivers.push_back(scene.grid->receiver(i, j));
  }
  std::vector<double> fast_view, exact_view, view_ratio, fast, exact, ratio;
  for (int round = 0; round < kRounds; ++round) {
    fast_view.push_back(microseconds(receivers, 0.02, [&](const Receiver& r) { return evaluator.view(r); }));
    exact_view.push_back(
        microseconds(receivers, 0.0, [&](const Receiver& r) { return exactVisibility(scene.polygons, r); }));
    view_ratio.push_back(exact_view.back() / fast_view.back());
    fast.push_back(microseconds(receivers, 0.02, [&](const Receiver& r) { return evaluator.evaluate(r); }));
    exact.push_back(
        microseconds(receivers, 0.0, [&](const Receiver& r) { return evaluateExactly(scene.polygons, r); }));
    ratio.push_back(exact.back() / fast.back());
  }
  out << "\nOcclusion, figure 5: microseconds for each of " << receivers.size() << " receivers\n"
      << "what            by predicates            exact                       exact : predicates\n"
      << "visibility      " << std::left << std::setw(25) << spread(fast_view, 2) << std::setw(28)
      << spread(exact_view, 0) << spread(view_ratio, 0) << '\n'
      << "E, grad, hess   " << std::setw(25) << spread(fast, 2) << std::setw(28) << spread(exact, 0) << spread(ratio, 0)
      << '\n'
      << "median (smallest .. largest) over " << kRounds << " rounds; asked: 50 at least\n";
}

/// Squares of half width `size` at random in front of a bright square that is seen behind most of them.
std::vector<Polygon> scatteredScene(std::size_t count, double size) {
  KeyedRandom random(kSeed, "scattered", count);
  std::vector<Polygon> polygons{{"emitter", {{-2, -2, 3}, {2, -2, 3}, {2, 2, 3}, {-2, 2, 3}}, 1.0}};
  while (polygons.size() < count) {
    const double x = random.between(-1.0, 1.0);
    const double y = random.between(-1.0, 1.0);
    // One above the other, so that none passes through another: that is a matter of the mesh, not of the view.
    const double height = 1.2 + 0.6 * static_cast<double>(polygons.size()) / static_cast<double>(count);
    const Eigen::Vector3d centre(x, y, height);
    const double turn = random.between(0.0, 1.5);
    const Eigen::Vector3d u(size * std::cos(turn), size * std::sin(turn), 0.0);
    const Eigen::Vector3d v(-u.y(), u.x(), 0.0);
    polygons.push_back({"screen", {centre - u - v, centre + u - v, centre + u + v, centre - u + v}, 0.1});
  }
  return polygons;
}

std::vector<Receiver> receiversBelow() {
  KeyedRandom random(kSeed, "receivers", 0);
  std::vector<Receiver> receivers;
  for (int i = 0; i < 4; ++i) {
    const double x = random.between(-0.3, 0.3);
    receivers.push_back({{x, random.between(-0.3, 0.3), 0.0}, {0, 0, 1}});
  }
  return receivers;
}

/// Half the width at which each of so many takes 1/n of the view.
double sizeSideBySide(std::size_t count) { return 0.7 / std::sqrt(static_cast<double>(count)); }

/// Arcs and apparent vertices of what a receiver sees, in the mean.
double meanOutput(const SceneEvaluator& evaluator, const std::vector<Receiver>& receivers) {
  std::size_t sum = 0;
  for (const Receiver& receiver : receivers) {
    const VisibleBoundary view = evaluator.view(receiver);
    sum += view.arcs.size() + view.apparent_vertices.size();
  }
  return static_cast<double>(sum) / static_cast<double>(receivers.size());
}

struct Growth {
  std::size_t count;
  double output;
  std::vector<double> times;
  std::vector<double> relative;
};

/// `sizeFor` of the number of polygons.
template <class SizeFor>
void printGrowth(std::ostream& out, const std::string& title, const SizeFor& sizeFor) {
  const std::vector<Receiver> receivers = receiversBelow();
  std::vector<Growth> growths;
  std::vector<SceneEvaluator> evaluators;
  for (const std::size_t count : {4U, 8U, 16U, 32U, 64U, 128U, 256U}) {
    evaluators.emplace_back(scatteredScene(count, sizeFor(count)));
    growths.push_back({count, meanOutput(evaluators.back(), receivers), {}, {}});
  }
  constexpr std::size_t kSixteen = 2;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < growths.size(); ++i) {
      growths[i].times.push_back(
          microseconds(receivers, 0.005, [&](const Receiver& r) { return evaluators[i].evaluate(r); }));
    }
    for (Growth& growth : growths) growth.relative.push_back(growth.times.back() / growths[kSixteen].times.back());
  }
  out << '\n'
      << title << '\n'
      << "polygons  microseconds                    each     relative to 16          output   by law   exponent\n";
  // n log n and what is put out: arcs and apparent vertices.
  const auto byLaw = [](const Growth& growth) {
    const auto count = static_cast<double>(growth.count);
    return median(growth.times) / (count * std::log2(count) + growth.output);
  };
  for (std::size_t i = 0; i < growths.size(); ++i) {
    const auto count = static_cast<double>(growths[i].count);
    out << std::left << std::setw(10) << growths[i].count << std::setw(32) << spread(growths[i].times, 1)
        << std::setw(9) << std::fixed << std::setprecision(2) << median(growths[i].times) / count << std::setw(24)
        << spread(growths[i].relative, 2) << std::setw(9) << std::setprecision(0) << growths[i].output << std::setw(9)
        << std::setprecision(2) << byLaw(growths[i]) / byLaw(growths[kSixteen]);
    if (i > 0) {
      out << std::log(median(growths[i].times) / median(growths[i - 1].times)) /
                 std::log(count / static_cast<double>(growths[i - 1].count));
    }
    out << '\n';
  }
  out << "output: arcs and apparent vertices; by law: time / (n log2 n + output), relative to that of 16\n";
}

/// Three quarters of them: so many of the pairs of equal times are not by chance.
bool isMostlyBelowOne(std::vector<double> ratios) {
  const auto upper_quartile = ratios.begin() + static_cast<std::ptrdiff_t>(3 * ratios.size() / 4);
  std::ranges::nth_element(ratios, upper_quartile);
  return *upper_quartile < 1.0;
}

/// What a view costs with a grid and without one, at numbers of polygons about those where both cost the same.
/// `sizeFor` of the number of polygons.
template <class SizeFor>
void printGridGain(std::ostream& out, const std::string& title, const SizeFor& sizeFor) {
  constexpr int kPairs = 15;
  const std::vector<Receiver> receivers = receiversBelow();
  out << '\n'
      << title << '\n'
      << "polygons  cells     one cell, microseconds          grid, microseconds              grid : one cell\n";
  std::optional<std::size_t> crossover;
  for (const std::size_t count : {16U, 24U, 32U, 48U, 64U, 96U, 128U, 256U}) {
    const SceneEvaluator evaluator(scatteredScene(count, sizeFor(count)));
    // That of viewGridResolution where there is more than one cell.
    const int resolution = static_cast<int>(std::sqrt(static_cast<double>(count)));
    const auto timeWith = [&](int along_side) {
      return microseconds(receivers, 0.005, [&](const Receiver& r) { return evaluator.view(r, along_side); });
    };
    std::vector<double> one_cell, grid, ratio;
    for (int pair = 0; pair < kPairs; ++pair) {
      one_cell.push_back(timeWith(1));
      grid.push_back(timeWith(resolution));
      ratio.push_back(grid.back() / one_cell.back());
    }
    const std::string cells = std::to_string(resolution) + " x " + std::to_string(resolution);
    out << std::left << std::setw(10) << count << std::setw(10) << cells << std::setw(32) << spread(one_cell, 1)
        << std::setw(32) << spread(grid, 1) << spread(ratio, 3) << '\n';
    if (!isMostlyBelowOne(ratio)) {
      crossover.reset();
    } else if (!crossover) {
      crossover = count;
    }
  }
  if (crossover) {
    out << "The grid is the faster one, in three of four pairs, from " << *crossover << " polygons on.\n";
  } else {
    out << "The grid is not the faster one, in three of four pairs, at the largest of these numbers.\n";
  }
}

void printMapTime(std::ostream& out) {
  const Scene scene = figureScene();
  std::vector<double> times;
  times.reserve(3);
  for (int round = 0; round < 3; ++round) {
    times.push_back(seconds([&] {
      benchmark::DoNotOptimize(derivativeMap(*scene.grid, viewEvaluator(scene.polygons), 2).channels.data());
    }));
  }
  out << "\nAnalytic map of figure 5, " << scene.grid->width << " x " << scene.grid->height
      << " receivers on 2 threads: " << spread(times, 2) << " s; asked: less than 5\n";
}

}  // namespace

void printOcclusionSection(std::ostream& out) {
  printRatios(out);
  out << std::flush;
  printGrowth(out, "Evaluation against the number of polygons, side by side in view (each takes 1/n of it)",
              sizeSideBySide);
  printGrowth(out, "The same, of one size: what crosses in view grows as n^2", [](std::size_t) { return 0.35; });
  out << std::flush;
  printGridGain(out, "The grid of directions (ViewGrid) against one cell, polygons side by side in view",
                sizeSideBySide);
  printGridGain(out, "The same, of one size", [](std::size_t) { return 0.35; });
  std::size_t fewest = 1;
  while (viewGridResolution(fewest) == 1) ++fewest;
  out << "An evaluation has a grid from " << fewest << " faces on.\n";
  printMapTime(out);
}

}  // namespace irradiff
