#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {

/// Requires a value.
double median(std::vector<double> values);
/// "median (smallest .. largest)".
std::string spread(const std::vector<double>& values, int decimals);

/// What a benchmark's name stands for; the names of a case's benchmarks differ in the variant only.
struct BenchmarkCase {
  std::string variant;
  std::string mode;  ///< scalar or batched
  int edges = 0;

  bool operator==(const BenchmarkCase&) const = default;
};

/// "variant/mode/edges".
std::string benchmarkName(const BenchmarkCase& benchmark_case);

/// Gathers the runs of all benchmarks over several calls of RunSpecifiedBenchmarks, the rounds, and prints them as one
/// table: processor time for a polygon and an edge, and the ratio to the reference variant's, each as
/// median (smallest .. largest). A ratio is of two times of the same round, mode and number of edges, measured one soon
/// after the other, so that a machine that slows down slows down both.
class RatioReporter : public benchmark::BenchmarkReporter {
 public:
  /// The variants in the order of the table; the first is the reference.
  explicit RatioReporter(std::vector<std::string> variants) : variants_(std::move(variants)) {}

  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;

  bool isEmpty() const { return series_.empty(); }
  void printTable() const;

 private:
  using RunNumber = std::pair<int, std::int64_t>;  ///< round, repetition in it
  struct Series {
    BenchmarkCase benchmark_case;
    std::map<RunNumber, double> nanoseconds;  ///< for a polygon
  };

  const Series* find(const BenchmarkCase& benchmark_case) const;
  std::vector<const Series*> inTableOrder() const;

  std::vector<std::string> variants_;
  std::vector<Series> series_;
  int round_ = 0;
};

}  // namespace irradiff
