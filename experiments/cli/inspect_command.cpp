#include "experiments/cli/inspect_command.h"

#include "experiments/cli/bounded_number.h"
#include "experiments/cli/command_files.h"
#include "experiments/cli/evaluation_text.h"
#include "experiments/cli/inspection_text.h"
#include "experiments/cli/progress.h"
#include "experiments/inspection/scene_inspection.h"
#include "experiments/io/scene_file.h"
#include "experiments/io/scene_lines.h"
#include "experiments/io/whole_file.h"

#include <CLI/CLI.hpp>

#include <cerrno>
#include <cstddef>
#include <exception>
#include <fstream>
#include <iostream>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <unistd.h>

namespace irradiff {

namespace {

constexpr const char* kCommand = "inspect";
constexpr const char* kStandardStream = "-";

struct InspectOptions {
  std::string input = kStandardStream;
  std::string output;  ///< standard output if empty
  double tolerance = kDefaultTolerance;
  bool is_json = false;
};

/// What is to be written of one scene, the last line break included.
std::string inspectOne(const std::string& text, const InspectOptions& options, std::size_t index, Progress& progress) {
  const Scene scene = parseScene(text);
  const std::size_t points = pointCount(scene);
  std::string found;
  InspectionSinks sinks;
  const auto take = [&](std::size_t i, const auto& point) {
    // Those of a grid are in the summary alone.
    if (options.is_json && i < points) found += (found.empty() ? "" : ",") + pointJson(i, point);
  };
  sinks.take = take;
  sinks.take_flatland = take;
  sinks.progress = [&](std::size_t done, std::size_t all) {
    if (!progress.isDue()) return;
    progress.show("scene " + std::to_string(index) + ": " + std::to_string(done) + " of " + std::to_string(all) +
                  " receivers");
  };
  const SceneInspection inspection = inspectScene(scene, options.tolerance, sinks);
  if (options.is_json) return "{\"summary\":" + inspectionJson(inspection) + ",\"points\":[" + found + "]}\n";
  return (index > 0 ? "\n\n" : "") + std::string("scene ") + std::to_string(index) + ": " + inspectionText(inspection);
}

void inspect(const InspectOptions& options) {
  std::ifstream file;
  if (options.input != kStandardStream) file = openInput(options.input);
  std::istream& in = options.input == kStandardStream ? std::cin : file;
  const std::unique_ptr<WholeFile> output_file = openOutput(options.output);
  std::ostream& out = output_file ? output_file->stream() : std::cout;

  Progress progress(!output_file && isatty(STDOUT_FILENO) == 1);
  SceneLines scenes(in);
  std::size_t count = 0;
  std::size_t refused = 0;
  std::string first_refusal;
  while (out) {
    std::string answer;
    std::optional<std::string> refusal;
    try {
      std::string text;
      if (!scenes.next(text)) break;
      answer = inspectOne(text, options, count, progress);
    } catch (const std::bad_alloc&) {
      refusal = "not enough memory for this scene";
    } catch (const std::exception& error) {
      if (!in.good() && !in.eof()) fail(kCommand, error.what());
      refusal = error.what();
    }
    if (refusal) {
      const std::string message = "scene " + std::to_string(count) + ": " + *refusal;
      answer = options.is_json ? errorLine(*refusal) + '\n' : (count > 0 ? "\n\n" : "") + message + '\n';
      if (refused++ == 0) first_refusal = message;
    }
    ++count;
    errno = 0;
    out << answer << std::flush;
    if (!out && !output_file) failToWrite(kCommand, errno);
  }
  if (count == 0) {
    fail(kCommand, (options.input == kStandardStream ? "standard input" : options.input) +
                       " is empty, must hold at least one scene");
  }
  if (output_file) output_file->commit();
  if (refused > 0) {
    fail(kCommand, std::to_string(refused) + " of " + std::to_string(count) + " scenes could not be inspected; first " +
                       first_refusal);
  }
}

}  // namespace

void addInspectCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(kCommand, "What scenes need at their receivers, and why");
  const auto options = std::make_shared<InspectOptions>();
  command->add_option("FILE", options->input, "a scene, or JSON Lines with a scene a line; - is standard input")
      ->type_name("")
      ->capture_default_str();
  addOutputOption(*command, options->output, "where the findings go");
  command
      ->add_option("--tolerance", options->tolerance,
                   "relative error to be reached, for the expected precision; 1e-60 to 1")
      ->type_name("T")
      ->check(boundedNumber(kSmallestTolerance, 1.0))
      ->capture_default_str();
  command->add_flag("--json", options->is_json,
                    "a JSON line for each scene: a summary, and each of its \"points\"; those of a grid are in the "
                    "summary alone");
  command->footer(
      "Exit status: 0 if every scene was inspected, 1 if not, 2 for a wrong call. A scene that cannot be evaluated\n"
      "has an error in place of its findings.");
  command->callback([options] { inspect(*options); });
}

}  // namespace irradiff
