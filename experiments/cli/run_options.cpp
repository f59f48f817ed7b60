#include "experiments/cli/run_options.h"

#include "experiments/cli/whole_number.h"
#include "verification/report/result_folder.h"

#include <optional>

namespace irradiff {

namespace {

std::optional<Effort> effortOf(const std::string& name) {
  for (const Effort effort : {Effort::kQuick, Effort::kStandard, Effort::kFull}) {
    if (name == nameOf(effort)) return effort;
  }
  return std::nullopt;
}

}  // namespace

void addFolderOption(CLI::App& command, std::string& folder, const std::string& what) {
  command.add_option("--output", folder, "folder " + what + " is replaced")->required()->type_name("DIR");
}

void addEffortOption(CLI::App& command, Effort& effort, const std::string& durations) {
  command
      .add_option_function<std::string>(
          "--effort", [&effort](const std::string& name) { effort = effortOf(name).value_or(effort); },
          durations + "; standard without")
      ->check(
          [](const std::string& name) {
            return effortOf(name) ? std::string() : '"' + name + "\" must be quick, standard or full";
          },
          "")
      ->type_name("quick|standard|full");
}

void addSeedOption(CLI::App& command, std::uint64_t& seed) {
  command.add_option("--seed", seed, "of the random inputs; 1 without")
      ->check(wholeNumber(0, kLargestSeed))
      ->type_name("S");
}

void addThreadsOption(CLI::App& command, unsigned& threads) {
  command.add_option("--threads", threads, "threads; results do not depend on it")
      ->check(wholeNumber(1, kMostThreads))
      ->type_name("N");
}

void onCall(CLI::App& command, const std::function<void()>& work) {
  command.callback([work] {
    try {
      work();
    } catch (const RefusedFolder& refused) {
      throw CLI::ValidationError("--output", refused.what());
    }
  });
}

}  // namespace irradiff
