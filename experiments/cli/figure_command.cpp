#include "experiments/cli/figure_command.h"

#include "derivatives/scene/invalid_scene.h"
#include "experiments/cli/command_files.h"
#include "experiments/cli/progress.h"
#include "experiments/cli/whole_number.h"
#include "experiments/figures/analytic_figure.h"
#include "experiments/figures/quality_figure.h"
#include "experiments/figures/sampled_figure.h"
#include "verification/report/gnuplot.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace irradiff {

namespace {

constexpr const char* kCommand = "figure";
/// A million receivers; their previews have more pixels than most screens.
constexpr unsigned kLargestResolution = 1024;
/// Every estimator works with so many.
constexpr unsigned kFewestRays = 16;
/// 4096 x 4096 strata.
constexpr unsigned kMostRays = 1U << 24U;
constexpr unsigned kQuickResolution = 64;
constexpr unsigned kPaperRays = 4096;
/// The curves of Figure 6.
constexpr const char* kBoxScene = IRRADIFF_SCENE_FOLDER "/black_square_in_box.json";

struct FigureArguments {
  std::string number;
  bool is_analytic = false;
  std::string output;
  std::string scene = IRRADIFF_SCENE_FOLDER "/figure5.json";
  std::optional<unsigned> resolution;  ///< as the effort says without
  std::optional<std::string> effort;
  std::optional<unsigned> rays;
  std::optional<unsigned> seed;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());

  bool isQuick() const { return effort == "quick"; }
};

FigureScene readScene(const std::string& path) {
  try {
    return readFigureScene(path);
  } catch (const std::runtime_error& error) {
    throw CLI::ValidationError("--scene", error.what());
  }
}

ReceiverGrid gridOf(const FigureArguments& arguments, const FigureScene& scene) {
  const ReceiverGrid own_grid = *scene.scene.grid;
  if (arguments.resolution) return withResolution(own_grid, *arguments.resolution);
  return arguments.isQuick() ? withResolution(own_grid, kQuickResolution) : own_grid;
}

RunRecord recordOf(const FigureArguments& arguments, const ReceiverGrid& grid, const std::vector<std::string>& own) {
  RunRecord record = recordOfThisProgram();
  record.command = {"irradiff",      kCommand,         arguments.number,
                    "--output",      arguments.output, "--scene",
                    arguments.scene, "--resolution",   std::to_string(std::max(grid.width, grid.height))};
  record.command.insert(record.command.end(), own.begin(), own.end());
  record.threads = arguments.threads;
  return record;
}

/// Rows of the figure, on a terminal.
class RowProgress {
 public:
  explicit RowProgress(std::string work) : work_(std::move(work)) {}

  std::function<void(std::size_t, std::size_t)> function() {
    return [this](std::size_t done, std::size_t all) {
      if (!progress_.isDue()) return;
      progress_.show("figure: " + work_ + ", " + std::to_string(done) + " of " + std::to_string(all) + " rows");
    };
  }

 private:
  std::string work_;
  Progress progress_{false};
};

using Clock = std::chrono::steady_clock;

template <class Figure>
void writeAndCommit(const FigureArguments& arguments, const Figure& figure, RunRecord record, Clock::time_point start) {
  ResultFolder folder(arguments.output, kCommand);
  record.wall_seconds = std::chrono::duration<double>(Clock::now() - start).count();
  writeFigure(figure, record, folder);
  folder.commit();
  std::cout << (folder.path() / "index.html").string() << '\n' << std::flush;
}

AnalyticFigure exactMaps(const FigureArguments& arguments, FigureScene scene, const ReceiverGrid& grid) {
  RowProgress progress("the truth");
  return analyticFigure(std::move(scene), grid, arguments.threads, progress.function());
}

void makeAnalytic(const FigureArguments& arguments, FigureScene scene) {
  const Clock::time_point start = Clock::now();
  const ReceiverGrid grid = gridOf(arguments, scene);
  writeAndCommit(arguments, exactMaps(arguments, std::move(scene), grid), recordOf(arguments, grid, {"--analytic"}),
                 start);
}

void makeSampled(const FigureArguments& arguments, FigureScene scene) {
  const Clock::time_point start = Clock::now();
  const ReceiverGrid grid = gridOf(arguments, scene);
  const SamplingPlan plan = figurePlan(arguments.rays.value_or(kPaperRays), arguments.seed.value_or(1));
  const std::vector<std::string> estimators = estimatorsFor(plan.stratification);
  const RunRecord record =
      recordOf(arguments, grid, {"--rays", std::to_string(plan.shape.size()), "--seed", std::to_string(plan.seed)});
  TileStore finished(unfinishedFolder(arguments.output), figureFingerprint(scene, grid, plan, estimators));
  AnalyticFigure analytic = exactMaps(arguments, std::move(scene), grid);
  RowProgress progress("estimates");
  writeAndCommit(
      arguments,
      sampledFigure(std::move(analytic), plan, estimators, arguments.threads, &finished, progress.function()), record,
      start);
  finished.remove();
}

void makeQuality(const FigureArguments& arguments, FigureScene scene) {
  const Clock::time_point start = Clock::now();
  requireGnuplot();
  const ReceiverGrid grid = gridOf(arguments, scene);
  const std::uint64_t seed = arguments.seed.value_or(1);
  const QualityPlan plan = arguments.isQuick() ? quickQualityPlan(seed) : standardQualityPlan(seed);
  std::vector<FigureScene> others{readScene(kBoxScene)};
  if (others[0].text == scene.text) others.clear();
  RunRecord record = recordOf(
      arguments, grid, {"--seed", std::to_string(plan.seed), "--effort", arguments.isQuick() ? "quick" : "standard"});
  TileStore finished(unfinishedFolder(arguments.output), qualityFingerprint(scene, grid, plan, others));
  AnalyticFigure analytic = exactMaps(arguments, std::move(scene), grid);
  std::optional<QualityFigure> figure;
  {
    Progress progress(false);
    figure =
        qualityFigure(std::move(analytic), plan, std::move(others), arguments.threads, &finished,
                      [&progress](const std::string& work, std::size_t done, std::size_t all) {
                        if (!progress.isDue()) return;
                        progress.show("figure: " + work + ", " + std::to_string(done) + " of " + std::to_string(all));
                      });
  }
  writeAndCommit(arguments, *figure, std::move(record), start);
  finished.remove();
}

void makeAndWrite(const FigureArguments& arguments) {
  FigureScene scene = readScene(arguments.scene);
  // Asked for before the work, made after it: what a run that is killed leaves is finished rows alone.
  static_cast<void>(ResultFolder(arguments.output, kCommand));
  try {
    if (arguments.number == "6") {
      makeQuality(arguments, std::move(scene));
    } else if (arguments.is_analytic) {
      makeAnalytic(arguments, std::move(scene));
    } else {
      makeSampled(arguments, std::move(scene));
    }
  } catch (const InvalidScene& error) {
    fail(kCommand, arguments.scene + ": " + error.what());
  }
}

void requireMeaning(const FigureArguments& arguments) {
  const auto refuse = [](const char* option, const char* reason) {
    throw CLI::ValidationError(option, std::string(reason) + ": must not be given");
  };
  if (arguments.number == "6") {
    if (arguments.is_analytic) refuse("--analytic", "means nothing for Figure 6, which compares estimators");
    if (arguments.rays) refuse("--rays", "means nothing for Figure 6, which has its own numbers of rays");
  }
  if (arguments.is_analytic) {
    if (arguments.rays) refuse("--rays", "means nothing with --analytic, which casts none");
    if (arguments.seed) refuse("--seed", "means nothing with --analytic, where nothing is random");
  }
}

}  // namespace

void addFigureCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(kCommand, "Makes a figure of the 2012 paper: its maps, previews and a page");
  const auto arguments = std::make_shared<FigureArguments>();
  command->add_option("N", arguments->number, "the number of the figure in the paper: 5 or 6")
      ->required()
      ->type_name("")
      ->check(
          [](const std::string& given) {
            return given == "5" || given == "6" ? std::string() : '"' + given + "\" must be 5 or 6";
          },
          "");
  command->add_flag("--analytic", arguments->is_analytic, "of Figure 5 the exact maps alone, without estimators");
  command->add_option("--output", arguments->output, "folder of the figure; an earlier figure there is replaced")
      ->required()
      ->type_name("DIR");
  command->add_option("--scene", arguments->scene, "another scene with a grid, such as those beside the figure's own")
      ->type_name("FILE")
      ->capture_default_str();
  command
      ->add_option("--effort", arguments->effort,
                   "quick: " + std::to_string(kQuickResolution) +
                       " receivers along the longer side; standard, which "
                       "is the default: as many as the scene says")
      ->check(
          [](const std::string& given) {
            return given == "quick" || given == "standard" ? std::string()
                                                           : '"' + given + "\" must be quick or standard";
          },
          "")
      ->type_name("EFFORT");
  command
      ->add_option("--resolution", arguments->resolution,
                   "receivers along the longer side of the grid, up to " + std::to_string(kLargestResolution) +
                       "; as the effort says without")
      ->check(wholeNumber(1, kLargestResolution))
      ->type_name("N");
  command
      ->add_option("--rays", arguments->rays,
                   "rays at each receiver, from " + std::to_string(kFewestRays) + ", rounded down to a square; " +
                       std::to_string(kPaperRays) + " without")
      ->check(wholeNumber(kFewestRays, kMostRays))
      ->type_name("N");
  command->add_option("--seed", arguments->seed, "of the random numbers; 1 without")
      ->check(wholeNumber(0, kLargestSeed))
      ->type_name("S");
  command->add_option("--threads", arguments->threads, "threads; results do not depend on it")
      ->check(wholeNumber(1, kMostThreads))
      ->type_name("N");
  command->footer(
      "Writes maps.exr (all channels, 32-bit floats), a PNG for each picture, index.html and run.json; with "
      "estimators\n"
      "also figure.png, the columns side by side, and errors.csv. A run with estimators that was killed leaves its\n"
      "finished rows in DIR.part, and the same call goes on from there.\n"
      "Exit status: 0 if the figure was written, 1 if the scene cannot be evaluated, 2 for a wrong call.");
  command->callback([arguments] {
    requireMeaning(*arguments);
    try {
      makeAndWrite(*arguments);
    } catch (const RefusedFolder& refused) {
      throw CLI::ValidationError("--output", refused.what());
    }
  });
}

}  // namespace irradiff
