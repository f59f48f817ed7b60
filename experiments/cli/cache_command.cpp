#include "experiments/cli/cache_command.h"

#include "derivatives/scene/number_text.h"
#include "experiments/cache_3d/metric_records.h"
#include "experiments/cli/bounded_number.h"
#include "experiments/cli/command_files.h"
#include "experiments/cli/progress.h"
#include "experiments/cli/run_options.h"
#include "experiments/cli/whole_number.h"
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
#include <thread>

namespace irradiff {

namespace {

constexpr const char* kCommand = "cache";
constexpr unsigned kMostWidth = 1024;
constexpr unsigned kMostReceivers = 1U << 20U;
/// Every estimator works with so many.
constexpr unsigned kFewestRays = 16;
constexpr unsigned kMostRays = 1U << 20U;
constexpr unsigned kDefaultWidth = 256;
constexpr unsigned kDefaultFlatlandReceivers = 4096;
constexpr unsigned kDefaultRays = 4096;
constexpr std::size_t kDefaultRecords = 1000;
/// Of the receivers, that are asked to be records where nothing is said.
constexpr std::size_t kDefaultShare = 8;

struct CacheArguments {
  std::string file;
  std::string output;
  std::string metric = "occlusion-hessian";
  std::optional<double> threshold;
  std::optional<unsigned> records;
  std::string scale = "relative";
  std::string measure = "total";
  std::string ellipse = "equal-error";
  double aspect = 2.0;
  std::string order = "refining";
  bool has_overture = true;
  bool clamps_neighbours = false;
  unsigned passes = 1;
  std::optional<unsigned> rays;
  std::optional<unsigned> width;
  std::uint64_t seed = 1;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  unsigned most_records = 0;
};

RecordScene readScene(const std::string& path) {
  try {
    return readRecordScene(path);
  } catch (const std::exception& error) {
    throw CLI::ValidationError("FILE", error.what());
  }
}

/// What of an option's name is wrong, empty for nothing: `parse` throws std::invalid_argument.
template <class Parse>
CLI::Validator nameFor(const Parse& parse) {
  return CLI::Validator(
      [parse](const std::string& name) {
        try {
          static_cast<void>(parse(name));
          return std::string();
        } catch (const std::invalid_argument& error) {
          return std::string(error.what());
        }
      },
      "");
}

std::string wrongMetric(const std::string& name) {
  std::string names;
  for (const std::string& metric : recordMetrics(true)) {
    if (metric == name) return "";
    names += (names.empty() ? "" : ", ") + metric;
  }
  return "unknown metric \"" + name + "\", must be one of " + names;
}

/// A threshold must be positive: a record that keeps an error of nothing serves nobody.
std::string wrongThreshold(const std::string& given) {
  double value = 0.0;
  const bool is_right = CLI::detail::lexical_cast(given, value) && value > 0.0 && std::isfinite(value);
  return is_right ? "" : '"' + given + "\" must be a number greater than 0";
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
  record.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  nlohmann::ordered_json seed;
  if (plan.rays > 0) seed = arguments.seed;
  ResultFolder folder(arguments.output, kCommand);
  try {
    writeCacheRun(*run, scene, record, configurationOf(arguments, scene, plan, *run), seed, folder);
  } catch (const std::invalid_argument& error) {
    // Of a value that a file cannot hold: another call would meet it too.
    finished.remove();
    fail(kCommand, arguments.file + ": " + error.what());
  }
  folder.commit();
  finished.remove();
  for (const std::string& sentence : runSentences(*run)) std::cout << sentence << '\n';
  std::cout << (folder.path() / "index.html").string() << '\n' << std::flush;
  if (run->placement.reached_limit || !run->is_within) fail(kCommand, runSentences(*run).back());
}

void addMetricOptions(CLI::App& command, CacheArguments& arguments) {
  command.add_option("--metric", arguments.metric, "error metric")
      ->check(wrongMetric, "")
      ->type_name("NAME")
      ->capture_default_str();
  CLI::Option* threshold = command
                               .add_option("--threshold", arguments.threshold,
                                           "what the metric keeps the error at; its unit is the metric's")
                               ->check(wrongThreshold, "")
                               ->type_name("EPS");
  command
      .add_option("--records", arguments.records,
                  "number of records that the threshold is tuned for, to 2 %; 1000 without, or an eighth of the "
                  "receivers")
      ->check(wholeNumber(1, kMostReceivers))
      ->excludes(threshold)
      ->type_name("N");
  command.add_option("--scale", arguments.scale, "absolute errors or shares of the record's irradiance")
      ->check(nameFor(errorScaleOf))
      ->type_name("absolute|relative")
      ->capture_default_str();
  command.add_option("--measure", arguments.measure, "the error's integral over the region or its mean")
      ->check(nameFor(errorMeasureOf))
      ->type_name("total|mean")
      ->capture_default_str();
  command.add_option("--ellipse", arguments.ellipse, "how a Hessian becomes an ellipse")
      ->check(nameFor(ellipseRuleOf))
      ->type_name("printed|equal-error|equal-error-exact")
      ->capture_default_str();
  command.add_option("--aspect", arguments.aspect, "longer half-axis over the shorter, at most")
      ->check(boundedNumber(1.0, 1000.0))
      ->type_name("A")
      ->capture_default_str();
}

void addPlacementOptions(CLI::App& command, CacheArguments& arguments) {
  command.add_option("--order", arguments.order, "in which order pixels are asked for")
      ->check(nameFor(placementOrderOf))
      ->type_name("rows|refining")
      ->capture_default_str();
  command.add_flag("--overture,!--no-overture", arguments.has_overture,
                   "interpolate all pixels anew when all records are there; so without either");
  command.add_flag("--clamp-neighbours", arguments.clamps_neighbours,
                   "no region larger than a neighbour's plus the distance");
  command.add_option("--passes", arguments.passes, "of progressive refinement")
      ->check(wholeNumber(1, 16))
      ->type_name("P")
      ->capture_default_str();
  command.add_option("--most-records", arguments.most_records, "stop there; the status is then 1")
      ->check(wholeNumber(1, kMostReceivers))
      ->type_name("N");
}

}  // namespace

void addCacheCommand(CLI::App& app) {
  const auto arguments = std::make_shared<CacheArguments>();
  CLI::App* command = app.add_subcommand(kCommand, "An irradiance cache on a room, with any error metric");
  command->add_option("FILE", arguments->file, "a room (irradiff-room), or a scene with a grid (irradiff-scene)")
      ->required()
      ->type_name("");
  addFolderOption(*command, arguments->output, "of the results; earlier ones there");
  addMetricOptions(*command, *arguments);
  addPlacementOptions(*command, *arguments);
  command
      ->add_option("--rays", arguments->rays,
                   "rays for each record, rounded down to a square; 4096 without, of a scene with a grid none: exact")
      ->check(wholeNumber(kFewestRays, kMostRays))
      ->type_name("N");
  command
      ->add_option("--width", arguments->width,
                   "pixels along the image's side, or receivers along a grid's or on all walls of flatland; 256 "
                   "without, in flatland 4096")
      ->check(wholeNumber(1, kMostReceivers))
      ->type_name("W");
  addSeedOption(*command, arguments->seed);
  addThreadsOption(*command, arguments->threads);
  command->footer(
      "Writes irradiance.exr and .png, footprints.png, radii.png, error.png, records.csv, summary.json, index.html "
      "and\n"
      "run.json. A run that was killed leaves its finished rows in DIR.part, and the same call goes on from there.\n"
      "Exit status: 0 if the results were written, 1 if the scene cannot be evaluated, the limit of records was\n"
      "reached or the metric cannot have the number of records that was asked for, 2 for a wrong call.");
  onCall(*command, [arguments] { makeAndWrite(*arguments); });
}

}  // namespace irradiff
