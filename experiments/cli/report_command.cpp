#include "experiments/cli/report_command.h"

#include "experiments/cli/progress.h"
#include "experiments/cli/report_figures.h"
#include "experiments/cli/run_options.h"
#include "verification/reference/reference_data.h"
#include "verification/report/accuracy_report.h"
#include "verification/report/gnuplot.h"
#include "verification/report/result_folder.h"
#include "verification/report/run_record.h"
#include "verification/report/summary_text.h"
#include "verification/report/write_report.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <utility>

namespace irradiff {
namespace {

struct ReportArguments {
  std::string output;
  Effort effort = Effort::kStandard;
  std::uint64_t seed = 1;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  std::string reference_folder = IRRADIFF_REFERENCE_FOLDER;
};

RunRecord recordOf(const ReportArguments& arguments) {
  RunRecord record = recordOfThisProgram();
  record.command = {"irradiff", "report",
                    "--output", arguments.output,
                    "--effort", nameOf(arguments.effort),
                    "--seed",   std::to_string(arguments.seed)};
  record.threads = arguments.threads;
  return record;
}

void makeAndWrite(const ReportArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  requireGnuplot();
  // Claimed first: nobody should wait minutes to hear that the folder is refused.
  ResultFolder folder(arguments.output, "report");
  RunRecord record = recordOf(arguments);
  AccuracyReport report;
  {
    Progress progress(false);
    ReportOptions options;
    options.effort = arguments.effort;
    options.seed = arguments.seed;
    options.threads = arguments.threads;
    options.reference_folder = arguments.reference_folder;
    options.progress = [&](std::size_t done, std::size_t all) {
      if (progress.isDue()) {
        progress.show("report: " + std::to_string(done) + " of " + std::to_string(all) + " parts done");
      }
    };
    report = makeReport(libraryFormulas(), options);
  }
  FurtherContent further;
  {
    Progress progress(false);
    further = writeReportFigures(
        {arguments.effort, arguments.seed, arguments.threads}, record, folder,
        [&](const std::string& work, std::size_t done, std::size_t all) {
          if (!progress.isDue()) return;
          progress.show("report: " + work + ", " + std::to_string(done) + " of " + std::to_string(all));
        });
  }
  record.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  writeReport(report, record, folder, further);
  folder.commit();

  for (const std::string& sentence : summarySentences(report)) {
    std::cout << sentence << '\n';
  }
  std::cout << (folder.path() / "index.html").string() << '\n' << std::flush;
  for (const Verdict& verdict : brokenPromises(report)) {
    std::cerr << describe(verdict) << '\n';
  }
  for (const BoundTightness& broken : brokenBounds(report)) {
    std::cerr << "a bound does not hold: " << broken.evaluator << ", " << broken.family << ", "
              << nameOf(broken.quantity) << ": " << broken.least << " of the error\n";
  }
  if (const int status = exitStatusOf(report); status != 0) {
    throw CLI::RuntimeError(status);
  }
}

}  // namespace

void addReportCommand(CLI::App& app) {
  const auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = app.add_subcommand("report", "Checks every formula and writes the accuracy report.");
  addFolderOption(*command, arguments->output, "of the report; an earlier report there");
  addEffortOption(*command, arguments->effort, "quick (half a minute), standard (two minutes) or full");
  addSeedOption(*command, arguments->seed);
  addThreadsOption(*command, arguments->threads);
  command->add_option("--reference", arguments->reference_folder, "folder of the reference values")->type_name("DIR");
  command->footer(
      "Writes index.html, accuracy.md, tables as .csv and .json, plots, the figures, a quick atlas, the trade of "
      "speed\n"
      "against accuracy and run.json.\n"
      "Exit status: 0 if every promise and every bound holds and the errata are confirmed, 1 if not, 2 for a wrong "
      "call.");
  command->callback([arguments] {
    try {
      makeAndWrite(*arguments);
    } catch (const RefusedFolder& refused) {
      throw CLI::ValidationError("--output", refused.what());
    } catch (const InvalidReference& invalid) {
      throw CLI::ValidationError("--reference", invalid.what());
    }
  });
}

}  // namespace irradiff
