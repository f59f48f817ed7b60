#pragma once

#include "verification/report/accuracy_report.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <functional>
#include <string>

namespace irradiff {

// What commands that make a folder of results have in common. Each option keeps its value unless it is given.

/// --output DIR, which must be given; `what` it is a folder of, such as "of the atlas; an earlier atlas there".
void addFolderOption(CLI::App& command, std::string& folder, const std::string& what);
/// --effort quick|standard|full; `durations` says how long each takes.
void addEffortOption(CLI::App& command, Effort& effort, const std::string& durations);
/// --seed S, a whole number up to 999999999.
void addSeedOption(CLI::App& command, std::uint64_t& seed);
/// --threads N, from 1 to 1024.
void addThreadsOption(CLI::App& command, unsigned& threads);

/// Does the command's work when it is called. A folder that is refused is a wrong --output.
void onCall(CLI::App& command, const std::function<void()>& work);

}  // namespace irradiff
