#include "experiments/cli/atlas_command.h"

#include "experiments/atlas/atlas.h"
#include "experiments/cli/progress.h"
#include "experiments/cli/run_options.h"
#include "experiments/figures/tile_store.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace irradiff {
namespace {

constexpr const char* kCommand = "atlas";

struct AtlasArguments {
  std::string output;
  Effort effort = Effort::kStandard;
  std::uint64_t seed = 1;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
};

RunRecord recordOf(const AtlasArguments& arguments) {
  RunRecord record = recordOfThisProgram();
  record.command = {"irradiff", kCommand,
                    "--output", arguments.output,
                    "--effort", nameOf(arguments.effort),
                    "--seed",   std::to_string(arguments.seed)};
  record.threads = arguments.threads;
  return record;
}

Atlas makeWithProgress(const AtlasArguments& arguments, const TileStore& finished) {
  Progress progress(false);
  return makeAtlas(atlasPlan(arguments.effort, arguments.seed), arguments.threads, &finished,
                   [&progress](const std::string& work, std::size_t done, std::size_t all) {
                     if (!progress.isDue()) return;
                     progress.show("atlas: " + work + ", " + std::to_string(done) + " of " + std::to_string(all));
                   });
}

void makeAndWrite(const AtlasArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  // Asked for before the work, made after it: what a run that is killed leaves is finished rows alone.
  static_cast<void>(ResultFolder(arguments.output, kCommand));
  RunRecord record = recordOf(arguments);
  TileStore finished(unfinishedFolder(arguments.output), atlasFingerprint(atlasPlan(arguments.effort, arguments.seed)));
  const Atlas atlas = makeWithProgress(arguments, finished);
  ResultFolder folder(arguments.output, kCommand);
  record.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  writeAtlas(atlas, record, folder);
  folder.commit();
  finished.remove();
  const StatementCounts counts = countsOf(atlas);
  std::cout << counts.regions << " inequalities, " << counts.checks << " checks with fresh inputs, " << counts.refuted
            << " failed\n"
            << (folder.path() / "index.html").string() << '\n'
            << std::flush;
  for (const SafetyStatement& s : atlas.statements) {
    if (s.violations == 0) continue;
    const StabilityMap& map = *std::ranges::find(atlas.maps, s.map, &StabilityMap::file);
    std::cerr << "irradiff atlas: " << s.map << ", " << s.formula << ", " << nameOf(s.scalar) << ", "
              << kAtlasQuantityNames[s.quantity] << ": \"" << textOf(s.region, map.x, map.y) << "\" is not safe for "
              << s.tolerance << " at " << s.violations << " of " << s.checked << " fresh inputs\n";
  }
  if (counts.refuted > 0) throw CLI::RuntimeError(1);
}

}  // namespace

void addAtlasCommand(CLI::App& app) {
  const auto arguments = std::make_shared<AtlasArguments>();
  CLI::App* command =
      app.add_subcommand(kCommand, "Maps the errors of every formula over pairs of extremes, and where each is safe");
  addFolderOption(*command, arguments->output, "of the atlas; an earlier atlas there");
  addEffortOption(*command, arguments->effort, "quick (seconds), standard (minutes) or full (half an hour)");
  addSeedOption(*command, arguments->seed);
  addThreadsOption(*command, arguments->threads);
  command->footer(
      "Writes for each map an EXR with the largest error of each variant and quantity and a PNG for each quantity;\n"
      "regions.csv and regions.json, the inequalities; atlas.md, index.html and run.json. A run that was killed leaves "
      "its\n"
      "finished rows in DIR.part, and the same call goes on from there.\n"
      "Exit status: 0 if no fresh input refutes an inequality, 1 if one does, 2 for a wrong call.");
  onCall(*command, [arguments] { makeAndWrite(*arguments); });
}

}  // namespace irradiff
