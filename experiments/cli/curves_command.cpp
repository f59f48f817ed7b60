#include "experiments/cli/curves_command.h"

#include "experiments/cache_3d/metric_records.h"
#include "experiments/cli/command_files.h"
#include "experiments/cli/metric_option.h"
#include "experiments/cli/progress.h"
#include "experiments/cli/run_options.h"
#include "experiments/curves/metric_study.h"
#include "experiments/curves/study_text.h"
#include "experiments/figures/tile_store.h"
#include "verification/report/gnuplot.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace irradiff {

namespace {

constexpr const char* kCommand = "curves";

struct CurvesArguments {
  std::string file;
  std::string output;
  Effort effort = Effort::kStandard;
  std::uint64_t seed = 1;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::string> metrics;
};

std::vector<RecordScene> readScenes(const CurvesArguments& arguments) {
  try {
    if (!arguments.file.empty()) return {readRecordScene(arguments.file)};
    std::vector<RecordScene> scenes;
    for (const std::filesystem::path& path : studyScenes()) scenes.push_back(readRecordScene(path));
    return scenes;
  } catch (const std::exception& error) {
    throw CLI::ValidationError("FILE", error.what());
  }
}

RunRecord recordOf(const CurvesArguments& arguments) {
  RunRecord record = recordOfThisProgram();
  record.command = {"irradiff", kCommand};
  if (!arguments.file.empty()) record.command.push_back(arguments.file);
  record.command.insert(record.command.end(), {"--output", arguments.output, "--effort", nameOf(arguments.effort),
                                               "--seed", std::to_string(arguments.seed)});
  for (const std::string& metric : arguments.metrics) {
    record.command.insert(record.command.end(), {"--metric", metric});
  }
  record.threads = arguments.threads;
  return record;
}

void makeAndWrite(const CurvesArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  requireGnuplot();
  const std::vector<RecordScene> scenes = readScenes(arguments);
  // Asked for before the work, made after it: what a run that is killed leaves is finished parts alone.
  static_cast<void>(ResultFolder(arguments.output, kCommand));
  RunRecord record = recordOf(arguments);
  StudyPlan plan = studyPlan(arguments.effort, arguments.seed);
  // In the order of tables, each once.
  for (const std::string& metric : recordMetrics(true)) {
    if (std::ranges::find(arguments.metrics, metric) != arguments.metrics.end()) plan.metrics.push_back(metric);
  }
  plan.has_comparisons = plan.metrics.empty();
  std::vector<std::filesystem::path> unfinished;
  const MakeStore make_store = [&](const std::string& name, const std::string& fingerprint) {
    unfinished.push_back(unfinishedFolder(arguments.output + '.' + name));
    return std::make_unique<TileStore>(unfinished.back(), fingerprint);
  };
  MetricStudy study;
  try {
    Progress progress(false);
    study = metricStudy(plan, scenes, arguments.threads, make_store,
                        [&progress](const std::string& work, std::size_t done, std::size_t all) {
                          if (!progress.isDue()) return;
                          progress.show("curves: " + work + ", " + std::to_string(done) + " of " + std::to_string(all));
                        });
  } catch (const RefusedFolder&) {
    throw;
  } catch (const std::exception& error) {
    fail(kCommand, error.what());
  }
  ResultFolder folder(arguments.output, kCommand);
  record.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  writeStudy(study, record, folder);
  folder.commit();
  for (const std::filesystem::path& path : unfinished) std::filesystem::remove_all(path);
  for (const std::string& sentence : conclusionSentences(study)) std::cout << sentence << '\n';
  std::cout << (folder.path() / "index.html").string() << '\n' << std::flush;
}

}  // namespace

void addCurvesCommand(CLI::App& app) {
  const auto arguments = std::make_shared<CurvesArguments>();
  CLI::App* command =
      app.add_subcommand(kCommand, "Error of an irradiance cache against its records, for every error metric");
  command
      ->add_option("FILE", arguments->file,
                   "a room (irradiff-room) or a scene with a grid (irradiff-scene); without, a flatland room, Figure "
                   "5 and the Cornell box with the paper's figures")
      ->type_name("");
  addFolderOption(*command, arguments->output, "of the results; earlier ones there");
  addEffortOption(*command, arguments->effort,
                  "quick (a minute and a half), standard (a quarter of an hour) or full (three seeds)");
  command->add_option("--metric", arguments->metrics, "an error metric, all of them without; may be repeated")
      ->check(wrongMetric, "")
      ->type_name("NAME");
  addSeedOption(*command, arguments->seed);
  addThreadsOption(*command, arguments->threads);
  command->footer(
      "Writes curves, slopes, ratios, table and figures as .csv and .json, plots, pictures, metrics.md, index.html "
      "and\n"
      "run.json. A run that was killed leaves its finished parts in folders DIR.NAME.part, and the same call goes on\n"
      "from there.\n"
      "Exit status: 0 if the results were written, 1 if a scene cannot be evaluated, 2 for a wrong call.");
  onCall(*command, [arguments] { makeAndWrite(*arguments); });
}

}  // namespace irradiff
