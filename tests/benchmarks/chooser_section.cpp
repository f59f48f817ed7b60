#include "tests/benchmarks/chooser_section.h"

#include "experiments/pareto/family_inputs.h"
#include "experiments/pareto/rule_regret.h"

#include <iomanip>
#include <ostream>

namespace irradiff {

namespace {

constexpr std::uint64_t kSeed = 2012;
constexpr std::size_t kInputs = 40;
constexpr std::size_t kRounds = 7;

}  // namespace

void printChooserSection(std::ostream& out) {
  out << "\nevaluatePolygon to a tolerance, " << kInputs << " inputs of each family, " << kRounds
      << " rounds; inputs where some rule is guaranteed to meet it\n"
      << std::left << std::setw(20) << "family" << std::setw(12) << "tolerance" << std::setw(10) << "inputs"
      << std::setw(16) << "ns without" << std::setw(12) << "ns with" << std::setw(10) << "saving"
      << "regret (asked: at most 1.3)\n";
  for (const InputFamily& family : inputFamilies()) {
    for (const RuleRegret& row : regretsOf(familyInputs(family, kInputs, kSeed), kRounds)) {
      out << std::setw(20) << row.family << std::setw(12) << row.tolerance << std::setw(10) << row.in_set.inputs;
      if (row.in_set.inputs == 0) {
        out << "-\n";
        continue;
      }
      out << std::fixed << std::setprecision(0) << std::setw(16) << row.without_tolerance << std::setw(12)
          << row.in_set.chosen << std::setprecision(1) << std::setw(10) << row.without_tolerance / row.in_set.chosen
          << std::defaultfloat << std::setprecision(6) << spreadText(row.in_set.regret, 3) << '\n';
    }
  }
  out << std::flush;
}

}  // namespace irradiff
