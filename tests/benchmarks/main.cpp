// Speed of the ways to get F, gradient and Hessian of a polygon, relative to the appendix form with acos as a renderer
// would write it, the price of proven bounds and of occlusion, what a tolerance and simplifications save, the price of
// derivatives from samples, rays a second, and what derivatives and an error metric cost beside their rays. Arguments
// as for Google Benchmark.

#include "tests/benchmarks/benchmark_inputs.h"
#include "tests/benchmarks/certified_section.h"
#include "tests/benchmarks/chooser_section.h"
#include "tests/benchmarks/derivative_share_section.h"
#include "tests/benchmarks/mesh_section.h"
#include "tests/benchmarks/metric_share_section.h"
#include "tests/benchmarks/occlusion_section.h"
#include "tests/benchmarks/polygon_variants.h"
#include "tests/benchmarks/ratio_reporter.h"
#include "tests/benchmarks/ray_section.h"
#include "tests/benchmarks/simplification_section.h"

#include <benchmark/benchmark.h>

#include <array>
#include <iostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using irradiff::BenchmarkInputs;
using irradiff::FormFactor;
using irradiff::PolygonVariant;

/// The reporter divides by this: polygons evaluated in all iterations.
void countPolygons(benchmark::State& state, std::size_t in_one_iteration) {
  state.counters["polygons"] = static_cast<double>(state.iterations()) * static_cast<double>(in_one_iteration);
}

void evaluateOneByOne(benchmark::State& state, const PolygonVariant& variant, const BenchmarkInputs& inputs) {
  std::size_t next = 0;
  for (auto unused : state) {
    (void)unused;
    benchmark::DoNotOptimize(variant.evaluate(inputs.polygons[next], inputs.receiver));
    next = next + 1 < inputs.polygons.size() ? next + 1 : 0;
  }
  countPolygons(state, 1);
}

void evaluateBatches(benchmark::State& state, const PolygonVariant& variant, const BenchmarkInputs& inputs) {
  std::vector<FormFactor<long double>> results(inputs.polygons.size());
  for (auto unused : state) {
    (void)unused;
    for (std::size_t i = 0; i < results.size(); ++i) {
      results[i] = variant.evaluate(inputs.polygons[i], inputs.receiver);
    }
    benchmark::DoNotOptimize(results.data());
    benchmark::ClobberMemory();
  }
  countPolygons(state, inputs.polygons.size());
}

void registerBenchmarks(const std::vector<PolygonVariant>& variants) {
  using Evaluate = void (*)(benchmark::State&, const PolygonVariant&, const BenchmarkInputs&);
  const std::array<std::pair<const char*, Evaluate>, 2> modes{
      {{"scalar", evaluateOneByOne}, {"batched", evaluateBatches}}};
  for (const auto& [mode, evaluate] : modes) {
    for (const int edges : {3, 4, 16}) {
      for (const PolygonVariant& variant : variants) {
        const BenchmarkInputs inputs = benchmarkInputs(static_cast<std::size_t>(edges), variant.size);
        benchmark::RegisterBenchmark(
            irradiff::benchmarkName({variant.name, mode, edges}).c_str(),
            [=, evaluate = evaluate](benchmark::State& state) { evaluate(state, variant, inputs); });
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  // The table of docs/caching.md, without the minutes that all others take.
  if (argc == 2 && std::string_view(argv[1]) == "--metric-share") {
    irradiff::printMetricShareSection(std::cout);
    return 0;
  }
  // The user's arguments come later and win.
  std::vector<char*> arguments{argv, argv + argc};
  std::string min_time = "--benchmark_min_time=0.02";
  arguments.insert(arguments.begin() + 1, min_time.data());
  auto count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  const std::vector<PolygonVariant> variants = irradiff::polygonVariants();
  registerBenchmarks(variants);
  std::vector<std::string> names;
  for (const PolygonVariant& variant : variants) names.push_back(variant.name);
  irradiff::RatioReporter reporter(names);
  // Rounds of all variants, so that none has the machine's best or worst moment to itself.
  constexpr int kRounds = 11;
  for (int round = 0; round < kRounds; ++round) {
    benchmark::RunSpecifiedBenchmarks(&reporter);
    // A call that only lists the benchmarks runs none.
    if (reporter.isEmpty()) return 0;
  }
  reporter.printTable();
  irradiff::printCertifiedSection(std::cout);
  irradiff::printChooserSection(std::cout);
  irradiff::printOcclusionSection(std::cout);
  irradiff::printSimplificationSection(std::cout);
  irradiff::printMeshSection(std::cout);
  irradiff::printRaySection(std::cout);
  irradiff::printDerivativeShareSection(std::cout);
  irradiff::printMetricShareSection(std::cout);
  return 0;
}
