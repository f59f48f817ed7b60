#include "experiments/cli/run_options.h"

#include "experiments/cli/whole_number.h"

#include <map>

namespace irradiff {

void addFolderOption(CLI::App& command, std::string& folder, const std::string& what) {
  command.add_option("--output", folder, "folder " + what + " is replaced")->required()->type_name("DIR");
}

void addEffortOption(CLI::App& command, Effort& effort, const std::string& durations) {
  command.add_option("--effort", effort, durations)
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, Effort>{
              {"quick", Effort::kQuick}, {"standard", Effort::kStandard}, {"full", Effort::kFull}},
          CLI::ignore_case))
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

}  // namespace irradiff
