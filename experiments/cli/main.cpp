#include "experiments/cli/atlas_command.h"
#include "experiments/cli/cache_command.h"
#include "experiments/cli/check_command.h"
#include "experiments/cli/curves_command.h"
#include "experiments/cli/estimate_command.h"
#include "experiments/cli/evaluate_command.h"
#include "experiments/cli/figure_command.h"
#include "experiments/cli/import_command.h"
#include "experiments/cli/inspect_command.h"
#include "experiments/cli/pareto_command.h"
#include "experiments/cli/report_command.h"
#include "experiments/io/whole_file.h"

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>

namespace {

constexpr int kFailed = 1;
constexpr int kWrongCall = 2;

int run(int argc, char** argv) {
  CLI::App app("Irradiance, its gradient and its Hessian in polygonal scenes, with verification.", "irradiff");
  app.set_version_flag("--version", "irradiff " IRRADIFF_VERSION);
  app.footer("irradiff COMMAND --help shows the options of a command.");
  // None is refused below: CLI11 would ask for a command where one was misspelt, without naming it.
  app.require_subcommand(0, 1);
  irradiff::addAtlasCommand(app);
  irradiff::addEvaluateCommand(app);
  irradiff::addEstimateCommand(app);
  irradiff::addCheckCommand(app);
  irradiff::addCacheCommand(app);
  irradiff::addCurvesCommand(app);
  irradiff::addFigureCommand(app);
  irradiff::addImportCommand(app);
  irradiff::addInspectCommand(app);
  irradiff::addParetoCommand(app);
  irradiff::addReportCommand(app);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) {
      std::cerr << "irradiff: a command is missing\n\n" << app.help();
      return kWrongCall;
    }
  } catch (const CLI::RuntimeError& failure) {
    // How a command ends with a status of its own; it has said why.
    return failure.get_exit_code();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kWrongCall;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    // Nothing here uses C's streams; reading a long line character by character through them takes seconds.
    std::ios::sync_with_stdio(false);
    irradiff::removePartsWhenInterrupted();
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "irradiff: " << error.what() << '\n';
    return kFailed;
  }
}
