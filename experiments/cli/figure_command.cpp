#include "experiments/cli/figure_command.h"

#include "derivatives/scene/invalid_scene.h"
#include "experiments/cli/command_files.h"
#include "experiments/cli/progress.h"
#include "experiments/figures/analytic_figure.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
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
constexpr unsigned kMostThreads = 1024;

struct FigureArguments {
  std::string number;
  bool is_analytic = false;
  std::string output;
  std::string scene = IRRADIFF_SCENE_FOLDER "/figure5.json";
  std::optional<unsigned> resolution;  ///< the scene's own without
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
};

RunRecord recordOf(const FigureArguments& arguments, const ReceiverGrid& grid) {
  RunRecord record = recordOfThisProgram();
  record.command = {
      "irradiff",       kCommand,  arguments.number, "--analytic",   "--output",
      arguments.output, "--scene", arguments.scene,  "--resolution", std::to_string(std::max(grid.width, grid.height))};
  record.threads = arguments.threads;
  return record;
}

FigureScene readScene(const std::string& path) {
  try {
    return readFigureScene(path);
  } catch (const std::runtime_error& error) {
    throw CLI::ValidationError("--scene", error.what());
  }
}

void makeAndWrite(const FigureArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  FigureScene scene = readScene(arguments.scene);
  const ReceiverGrid own_grid = *scene.scene.grid;
  const ReceiverGrid grid = arguments.resolution ? withResolution(own_grid, *arguments.resolution) : own_grid;
  // Claimed first, like a report's.
  ResultFolder folder(arguments.output, kCommand);
  RunRecord record = recordOf(arguments, grid);
  AnalyticFigure figure;
  try {
    Progress progress(false);
    figure = analyticFigure(std::move(scene), grid, arguments.threads, [&progress](std::size_t done, std::size_t all) {
      if (progress.isDue()) {
        progress.show("figure: " + std::to_string(done) + " of " + std::to_string(all) + " rows");
      }
    });
  } catch (const InvalidScene& error) {
    fail(kCommand, arguments.scene + ": " + error.what());
  }
  record.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  writeFigure(figure, record, folder);
  folder.commit();
  std::cout << (folder.path() / "index.html").string() << '\n' << std::flush;
}

/// A whole number from 1 to `last`.
CLI::Validator wholeNumberTo(unsigned last) {
  return CLI::Validator(
      [last](const std::string& given) {
        const bool is_number = !given.empty() && given.size() <= 9 &&
                               std::ranges::all_of(given, [](char c) { return c >= '0' && c <= '9'; });
        const unsigned long value = is_number ? std::stoul(given) : 0;
        return value >= 1 && value <= last
                   ? std::string()
                   : '"' + given + "\" must be a whole number from 1 to " + std::to_string(last);
      },
      "");
}

}  // namespace

void addFigureCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(kCommand, "Makes a figure of the 2012 paper: its maps, previews and a page");
  const auto arguments = std::make_shared<FigureArguments>();
  command->add_option("N", arguments->number, "the number of the figure in the paper; there is 5")
      ->required()
      ->type_name("")
      ->check([](const std::string& given) { return given == "5" ? std::string() : '"' + given + "\" must be 5"; }, "");
  command->add_flag("--analytic", arguments->is_analytic,
                    "the exact maps; they are all there is so far, so it must be given");
  command->add_option("--output", arguments->output, "folder of the figure; an earlier figure there is replaced")
      ->required()
      ->type_name("DIR");
  command->add_option("--scene", arguments->scene, "another scene with a grid, such as those beside the figure's own")
      ->type_name("FILE")
      ->capture_default_str();
  command
      ->add_option("--resolution", arguments->resolution,
                   "receivers along the longer side of the grid, up to " + std::to_string(kLargestResolution) +
                       "; as the scene says without")
      ->check(wholeNumberTo(kLargestResolution))
      ->type_name("N");
  command->add_option("--threads", arguments->threads, "threads; results do not depend on it")
      ->check(wholeNumberTo(kMostThreads))
      ->type_name("N");
  command->footer(
      "Writes maps.exr (all channels, 32-bit floats), a PNG for each picture, index.html and run.json.\n"
      "Exit status: 0 if the figure was written, 1 if the scene cannot be evaluated, 2 for a wrong call.");
  command->callback([arguments] {
    if (!arguments->is_analytic) {
      throw CLI::ValidationError("--analytic", "is missing, must be given: the figure's sampled part is not built yet");
    }
    try {
      makeAndWrite(*arguments);
    } catch (const RefusedFolder& refused) {
      throw CLI::ValidationError("--output", refused.what());
    }
  });
}

}  // namespace irradiff
