#include "experiments/cli/pareto_command.h"

#include "experiments/cli/progress.h"
#include "experiments/cli/run_options.h"
#include "experiments/pareto/pareto.h"
#include "experiments/pareto/pareto_page.h"
#include "verification/checks/input_families.h"
#include "verification/report/gnuplot.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace irradiff {

namespace {

constexpr const char* kCommand = "pareto";
constexpr const char* kScene = IRRADIFF_SCENE_FOLDER "/figure5.json";

struct ParetoArguments {
  std::string output;
  Effort effort = Effort::kStandard;
  std::uint64_t seed = 1;
  std::vector<std::string> families;
};

std::string unknownFamily(const std::string& name) {
  std::string names;
  for (const InputFamily& family : inputFamilies()) {
    if (family.name == name) return "";
    names += (names.empty() ? "" : ", ") + std::string(family.name);
  }
  return "unknown family \"" + name + "\", must be one of " + names;
}

RunRecord recordOf(const ParetoArguments& arguments) {
  RunRecord record = recordOfThisProgram();
  record.command = {"irradiff", kCommand,
                    "--output", arguments.output,
                    "--effort", nameOf(arguments.effort),
                    "--seed",   std::to_string(arguments.seed)};
  for (const std::string& family : arguments.families) {
    record.command.insert(record.command.end(), {"--family", family});
  }
  return record;
}

void makeAndWrite(const ParetoArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  requireGnuplot();
  ResultFolder folder(arguments.output, kCommand);
  RunRecord record = recordOf(arguments);
  ParetoPlan plan = paretoPlan(arguments.effort, arguments.seed);
  plan.families = arguments.families;
  Pareto pareto;
  {
    Progress progress(false);
    pareto = measurePareto(
        plan, readFigureScene(kScene), [&progress](const std::string& work, std::size_t done, std::size_t all) {
          if (!progress.isDue()) return;
          progress.show("pareto: " + work + ", " + std::to_string(done) + " of " + std::to_string(all));
        });
  }
  record.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  writePareto(pareto, record, folder);
  folder.commit();
  for (const std::string& sentence : paretoSentences(pareto)) std::cout << sentence << '\n';
  std::cout << (folder.path() / "index.html").string() << '\n' << std::flush;
}

}  // namespace

void addParetoCommand(CLI::App& app) {
  const auto arguments = std::make_shared<ParetoArguments>();
  CLI::App* command = app.add_subcommand(kCommand, "Time and error of every formula, rule and estimator.");
  addFolderOption(*command, arguments->output, "of the results; an earlier one there");
  addEffortOption(*command, arguments->effort, "quick (seconds), standard (half a minute) or full (minutes)");
  addSeedOption(*command, arguments->seed);
  command->add_option("--family", arguments->families, "an input family, all of them without; may be repeated")
      ->check(unknownFamily, "")
      ->type_name("NAME");
  command->footer(
      "Writes pareto.svg, trade, errors, regret and estimators as .csv and .json, index.html and run.json. Times "
      "depend\n"
      "on the machine and what else it does: run it on a quiet one. errors.csv holds no times.\n"
      "Exit status: 0 if the results were written, 2 for a wrong call.");
  onCall(*command, [arguments] { makeAndWrite(*arguments); });
}

}  // namespace irradiff
