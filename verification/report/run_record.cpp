#include "verification/report/run_record.h"

#include <nlohmann/json.hpp>

#include <array>
#include <chrono>
#include <ctime>
#include <fstream>
#include <sys/utsname.h>

namespace irradiff {
namespace {

std::string processorName() {
  std::ifstream information("/proc/cpuinfo");
  for (std::string line; std::getline(information, line);) {
    if (line.starts_with("model name")) {
      const std::size_t colon = line.find(": ");
      return colon == std::string::npos ? line : line.substr(colon + 2);
    }
  }
  return "unknown processor";
}

std::string systemName() {
  utsname name{};
  return uname(&name) == 0 ? std::string(name.sysname) + ' ' + name.machine : "unknown system";
}

std::string utcNow() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

}  // namespace

RunRecord recordOfThisProgram() {
  RunRecord record;
  record.version = IRRADIFF_VERSION;
  record.date = utcNow();
#if defined(__clang__)
  record.compiler = "clang " __clang_version__;
#else
  record.compiler = "g++ " __VERSION__;
#endif
  record.machine = processorName() + ", " + systemName();
  return record;
}

std::string runJson(const RunRecord& record, const nlohmann::ordered_json& configuration,
                    const nlohmann::ordered_json& seed, const nlohmann::ordered_json& findings) {
  nlohmann::ordered_json json = {
      {"format", "irradiff-run"},
      {"command", record.command},
      {"configuration", configuration},
      {"seed", seed},
      {"version", record.version},
      {"compiler", record.compiler},
      {"machine", record.machine},
      {"date", record.date},
      {"wall_seconds", record.wall_seconds},
  };
  json.update(findings);
  return json.dump(2) + '\n';
}

std::string runJson(const AccuracyReport& report, const RunRecord& record) {
  const ReportSizes sizes = sizesOf(report.effort);
  return runJson(
      record,
      {{"effort", nameOf(report.effort)},
       {"inputs", sizes.inputs},
       {"slow_oracle_inputs", sizes.slow_oracle_inputs},
       {"sweep_samples", sizes.sweep_samples},
       {"errata_inputs", sizes.errata_inputs},
       {"threads", record.threads}},
      report.seed,
      {{"broken_promises", brokenPromises(report).size()}, {"unconfirmed_errata", unconfirmedErrata(report).size()}});
}

}  // namespace irradiff
