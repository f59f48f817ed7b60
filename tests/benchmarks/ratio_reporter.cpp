#include "tests/benchmarks/ratio_reporter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <tuple>

namespace irradiff {

namespace {

BenchmarkCase caseOf(const std::string& name) {
  const std::size_t mode = name.find('/');
  const std::size_t edges = name.find('/', mode + 1);
  return {name.substr(0, mode), name.substr(mode + 1, edges - mode - 1), std::stoi(name.substr(edges + 1))};
}

void printRow(std::ostream& out, const std::vector<std::string>& cells) {
  constexpr std::array<int, 5> kWidths{9, 7, 32, 30, 28};
  out << std::left;
  for (std::size_t i = 0; i < cells.size(); ++i) out << std::setw(i < kWidths.size() ? kWidths[i] : 0) << cells[i];
  out << '\n';
}

}  // namespace

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

std::string spread(const std::vector<double>& values, int decimals) {
  if (values.empty()) return "-";
  const auto [smallest, largest] = std::ranges::minmax(values);
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals) << median(values) << " (" << smallest << " .. " << largest << ')';
  return text.str();
}

std::string benchmarkName(const BenchmarkCase& benchmark_case) {
  return benchmark_case.variant + "/" + benchmark_case.mode + "/" + std::to_string(benchmark_case.edges);
}

bool RatioReporter::ReportContext(const Context& context) {
  if (round_++ > 0) return true;
  const benchmark::CPUInfo& cpu = context.cpu_info;
  std::ostream& out = GetOutputStream();
  out << cpu.num_cpus << " processors of " << std::lround(cpu.cycles_per_second / 1e6) << " MHz; compiler "
      << __VERSION__ << '\n';
  if (!cpu.load_avg.empty() && cpu.load_avg.front() > 0.5) {
    out << "The machine is busy (load " << cpu.load_avg.front() << "): trust the ratios, not the times.\n";
  }
  return true;
}

void RatioReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
    const BenchmarkCase benchmark_case = caseOf(run.run_name.function_name);
    auto found = std::ranges::find(series_, benchmark_case, &Series::benchmark_case);
    if (found == series_.end()) found = series_.insert(series_.end(), {benchmark_case, {}});
    const double polygons = run.counters.at("polygons");
    found->nanoseconds[{round_, run.repetition_index}] = 1e9 * run.cpu_accumulated_time / polygons;
  }
}

const RatioReporter::Series* RatioReporter::find(const BenchmarkCase& benchmark_case) const {
  const auto found = std::ranges::find(series_, benchmark_case, &Series::benchmark_case);
  return found == series_.end() ? nullptr : &*found;
}

std::vector<const RatioReporter::Series*> RatioReporter::inTableOrder() const {
  std::vector<const Series*> ordered;
  for (const Series& series : series_) ordered.push_back(&series);
  std::ranges::stable_sort(ordered, {}, [this](const Series* series) {
    const BenchmarkCase& c = series->benchmark_case;
    return std::tuple(c.mode == "batched", c.edges, std::ranges::find(variants_, c.variant) - variants_.begin());
  });
  return ordered;
}

void RatioReporter::printTable() const {
  std::ostream& out = GetOutputStream();
  out << '\n';
  printRow(out, {"mode", "edges", "variant", "ns per polygon", "ns per edge", "ratio to " + variants_.front()});
  for (const Series* series : inTableOrder()) {
    const BenchmarkCase& c = series->benchmark_case;
    const Series* reference = find({variants_.front(), c.mode, c.edges});
    std::vector<double> polygon_times;
    std::vector<double> edge_times;
    std::vector<double> ratios;
    for (const auto& [run, time] : series->nanoseconds) {
      polygon_times.push_back(time);
      edge_times.push_back(time / c.edges);
      if (reference != nullptr && reference->nanoseconds.contains(run)) {
        ratios.push_back(time / reference->nanoseconds.at(run));
      }
    }
    printRow(out, {c.mode, std::to_string(c.edges), c.variant, spread(polygon_times, 0), spread(edge_times, 0),
                   spread(ratios, 2)});
  }
  out << "\nmedian (smallest .. largest) over " << round_
      << " rounds, processor time; a ratio is of two times in the same round. F, gradient and Hessian each time;\n"
         "batched: 256 polygons in one call, a plain loop.\n";
}

}  // namespace irradiff
