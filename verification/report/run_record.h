#pragma once

#include "verification/report/accuracy_report.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace irradiff {

/// How a report, a figure or another result came to be.
struct RunRecord {
  std::vector<std::string> command;  ///< "irradiff", "report", ...
  std::string version;
  std::string date;  ///< UTC, ISO 8601
  std::string compiler;
  std::string machine;  ///< processor and system; no names of people or hosts
  unsigned threads = 1;
  double wall_seconds = 0.0;
};

/// Version, compiler, machine and date of this program, now.
RunRecord recordOfThisProgram();

/// run.json of any command: the record with what the command was told (an object), the seed (null where nothing is
/// random), and what it found (an object whose fields stand last).
std::string runJson(const RunRecord& record, const nlohmann::ordered_json& configuration,
                    const nlohmann::ordered_json& seed, const nlohmann::ordered_json& findings);

/// run.json: the record with the report's configuration.
std::string runJson(const AccuracyReport& report, const RunRecord& record);

}  // namespace irradiff
