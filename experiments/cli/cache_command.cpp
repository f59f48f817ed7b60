#include "experiments/cli/cache_command.h"

#include "derivatives/scene/number_text.h"
#include "experiments/cli/cache_options.h"
#include "experiments/cli/command_files.h"
#include "experiments/cli/progress.h"
#include "experiments/cli/run_options.h"
#include "experiments/curves/cache_run.h"
#include "experiments/curves/error_curves.h"
#include "experiments/figures/tile_store.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace irradiff {

namespace {

constexpr const char* kCommand = "cache";
constexpr unsigned kMostWidth = 1024;
constexpr unsigned kDefaultWidth = 256;
constexpr unsigned kDefaultFlatlandReceivers = 4096;
constexpr unsigned kDefaultRays = 4096;
constexpr std::size_t kDefaultRecords = 1000;
/// Of the receivers, that are asked to be records where nothing is said.
constexpr std::size_t kDefaultShare = 8;

RecordScene readScene(const std::string& path) {
  try {
    return readRecordScene(path);
  } catch (const std::exception& error) {
    throw CLI::ValidationError("FILE", error.what());
  }
}

RecordFieldPlan fieldPlan(const CacheArguments& arguments, const RecordScene& scene) {
  RecordFieldPlan plan;
  plan.seed = arguments.seed;
  plan.threads = arguments.threads;
  plan.width = arguments.width.value_or(scene.isFlatland() ? kDefaultFlatlandReceivers : kDefaultWidth);
  if (!scene.isFlatland() && plan.width > kMostWidth) {
    throw CLI::ValidationError("--width", '"' + std::to_string(plan.width) + "\" must be a whole number from 1 to " +
                                              std::to_string(kMostWidth) + " for a scene in space");
  }
  if (scene.isFlatland() && arguments.rays) {
    throw CLI::ValidationError("--rays", "means nothing in flatland, where derivatives are exact: must not be given");
  }
  if (arguments.knows_geometry.value_or(false) && (scene.isFlatland() || scene.isPlane())) {
    throw CLI::ValidationError("--known-geometry", "\"" + arguments.file +
                                                       "\" is no room in space, must be one: only there are gathers " +
                                                       "made with exact visibility beside them");
  }
  const unsigned rays = arguments.rays.value_or(scene.isFlatland() || scene.isPlane() ? 0 : kDefaultRays);
  const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(rays)));
  plan.rays = side * side;
  return plan;
}

MetricChoice choiceOf(const CacheArguments& arguments, const RecordField& field) {
  MetricChoice choice = defaultChoice(field, arguments.metric);
  choice.ellipse = {errorScaleOf(arguments.scale), errorMeasureOf(arguments.measure), ellipseRuleOf(arguments.ellipse),
                    arguments.aspect};
  if (arguments.threshold) choice.threshold = *arguments.threshold;
  if (arguments.knows_geometry) choice.knows_geometry = *arguments.knows_geometry;
  return choice;
}

PlacementOptions placementOf(const CacheArguments& arguments) {
  PlacementOptions options;
  options.order = placementOrderOf(arguments.order);
  options.has_overture = arguments.has_overture;
  options.clamps_neighbours = arguments.clamps_neighbours;
  options.refinement_passes = arguments.passes;
  options.most_records = arguments.most_records;
  return options;
}

/// Nothing where a threshold is given.
std::optional<std::size_t> askedRecords(const CacheArguments& arguments, const RecordField& field) {
  if (arguments.threshold) return std::nullopt;
  if (arguments.records) return *arguments.records;
  return std::clamp<std::size_t>(field.receivers.size() / kDefaultShare, 1, kDefaultRecords);
}

/// All that the results depend on besides the scene.
nlohmann::ordered_json configurationOf(const CacheArguments& arguments, const RecordScene& scene,
                                       const RecordFieldPlan& plan, const CacheRun& run) {
  return {{"scene", scene.name},
          {"metric", arguments.metric},
          {"threshold", run.choice.threshold},
          {"scale", arguments.scale},
          {"measure", arguments.measure},
          {"ellipse", arguments.ellipse},
          {"aspect", arguments.aspect},
          {"known_geometry", run.choice.knows_geometry},
          {"black_pixels", run.choice.black_pixels},
          {"order", arguments.order},
          {"overture", arguments.has_overture},
          {"clamp_neighbours", arguments.clamps_neighbours},
          {"passes", arguments.passes},
          {"width", plan.width},
          {"rays", plan.rays},
          {"most_records", arguments.most_records}};
}

RunRecord recordOf(const CacheArguments& arguments, const RecordFieldPlan& plan) {
  RunRecord record = recordOfThisProgram();
  record.command = {"irradiff", kCommand, arguments.file, "--output", arguments.output, "--metric", arguments.metric};
  const auto add = [&record](const char* option, const std::string& value) {
    record.command.insert(record.command.end(), {option, value});
  };
  if (arguments.threshold) add("--threshold", numberText(*arguments.threshold));
  if (arguments.records) add("--records", std::to_string(*arguments.records));
  add("--scale", arguments.scale);
  add("--measure", arguments.measure);
  add("--ellipse", arguments.ellipse);
  add("--aspect", numberText(arguments.aspect));
  if (arguments.knows_geometry) {
    record.command.emplace_back(*arguments.knows_geometry ? "--known-geometry" : "--no-known-geometry");
  }
  add("--order", arguments.order);
  record.command.emplace_back(arguments.has_overture ? "--overture" : "--no-overture");
  if (arguments.clamps_neighbours) record.command.emplace_back("--clamp-neighbours");
  add("--passes", std::to_string(arguments.passes));
  if (plan.rays > 0) add("--rays", std::to_string(plan.rays));
  add("--width", std::to_string(plan.width));
  add("--seed", std::to_string(arguments.seed));
  if (arguments.most_records > 0) add("--most-records", std::to_string(arguments.most_records));
  record.threads = arguments.threads;
  return record;
}

void makeAndWrite(const CacheArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const RecordScene scene = readScene(arguments.file);
  const RecordFieldPlan plan = fieldPlan(arguments, scene);
  // Asked for before the work, made after it: what a run that is killed leaves is finished rows alone.
  static_cast<void>(ResultFolder(arguments.output, kCommand));
  RunRecord record = recordOf(arguments, plan);
  TileStore finished(unfinishedFolder(arguments.output), fieldFingerprint(scene, plan));
  std::optional<RecordField> field;
  std::optional<CacheRun> run;
  try {
    Progress progress(false);
    field = recordField(scene, plan, &finished, [&progress](std::size_t done, std::size_t all) {
      if (!progress.isDue()) return;
      progress.show("cache: records, " + std::to_string(done) + " of " + std::to_string(all) + " parts");
    });
    run = runCache(*field, choiceOf(arguments, *field), placementOf(arguments), askedRecords(arguments, *field));
  } catch (const std::exception& error) {
    finished.remove();
    fail(kCommand, arguments.file + ": " + error.what());
  }
  ResultFolder folder(arguments.output, kCommand);
  record.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  nlohmann::ordered_json seed;
  if (plan.rays > 0) seed = arguments.seed;
  writeCacheRun(*run, scene, record, configurationOf(arguments, scene, plan, *run), seed, folder);
  folder.commit();
  finished.remove();
  for (const std::string& sentence : runSentences(*run)) std::cout << sentence << '\n';
  std::cout << (folder.path() / "index.html").string() << '\n' << std::flush;
  if (run->placement.reached_limit || !run->is_within) fail(kCommand, runSentences(*run).back());
}

}  // namespace

void addCacheCommand(CLI::App& app) {
  const auto arguments = std::make_shared<CacheArguments>();
  CLI::App* command = app.add_subcommand(kCommand, "An irradiance cache on a room, with any error metric");
  addCacheOptions(*command, *arguments);
  command->footer(
      "Writes irradiance.exr and .png, footprints.png, radii.png, error.png, records.csv, summary.json, index.html "
      "and\n"
      "run.json. A run that was killed leaves its finished rows in DIR.part, and the same call goes on from there.\n"
      "Exit status: 0 if the results were written, 1 if the scene cannot be evaluated, the limit of records was\n"
      "reached or the metric cannot have the number of records that was asked for, 2 for a wrong call.");
  onCall(*command, [arguments] { makeAndWrite(*arguments); });
}

}  // namespace irradiff
