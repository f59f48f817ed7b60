// Is there a single change of the formulas that our checks would let pass?

#include "tests/mutants/mutant_checks.h"
#include "verification/checks/input_families.h"
#include "verification/checks/library_candidates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <set>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 20120806;
constexpr std::size_t kFewestMutants = 60;

const std::vector<FormulaLibrary>& libraries() {
  static const std::vector<FormulaLibrary> all = [] {
    const char* folder = std::getenv("IRRADIFF_FORMULA_LIBRARIES");
    if (folder == nullptr) {
      throw std::runtime_error("IRRADIFF_FORMULA_LIBRARIES must name the folder of the compiled formulas; ctest does");
    }
    return loadFormulaLibraries(folder);
  }();
  return all;
}

const MutantChecks& checks() {
  static const MutantChecks all("data/reference", kSeed);
  return all;
}

bool isMutant(const FormulaLibrary& formulas) { return formulas.name() != "unmutated"; }

/// One for each group of formulas.
std::vector<FormulaLibrary> unmutatedLibraries() {
  std::vector<FormulaLibrary> unmutated;
  std::remove_copy_if(libraries().begin(), libraries().end(), std::back_inserter(unmutated), isMutant);
  return unmutated;
}

/// The name of the check, closed forms under one.
std::string checkOf(const Verdict& verdict) {
  return verdict.check.starts_with("closed form") ? "closed form" : verdict.check;
}

/// The checks that failed, each with the family where it failed first, and how many more verdicts.
std::map<std::string, std::string> summaryOf(const std::vector<Verdict>& failed) {
  std::map<std::string, std::string> families;
  std::map<std::string, std::size_t> counts;
  for (const Verdict& verdict : failed) {
    families.emplace(checkOf(verdict), verdict.family + ", " + nameOf(verdict.quantity));
    ++counts[checkOf(verdict)];
  }
  for (auto& [check, text] : families) {
    text += counts[check] > 1 ? " and " + std::to_string(counts[check] - 1) + " more" : "";
  }
  return families;
}

TEST(Mutants, UnmutatedFormulasPassEveryCheck) {
  const std::vector<FormulaLibrary> unmutated = unmutatedLibraries();
  ASSERT_EQ(unmutated.size(), 4U);
  for (const FormulaLibrary& formulas : unmutated) {
    for (const Verdict& verdict : checks().run(formulas)) {
      EXPECT_TRUE(verdict.passed) << describe(verdict);
    }
  }
}

TEST(Mutants, EveryOneIsCaughtByACheckThatDoesNotTrustTheFormulas) {
  std::cout << "seed " << kSeed << "; in brackets: what also fails, but expects values of the formulas themselves\n";
  std::map<std::string, std::size_t> caught_by;
  std::set<std::string> trusting;
  for (const FormulaLibrary& formulas : unmutatedLibraries()) {
    for (const Verdict& verdict : checks().run(formulas)) {
      caught_by[checkOf(verdict)] = 0;
      if (trustsTheFormulas(verdict) && verdict.check != "claimed bound") {
        trusting.insert(checkOf(verdict));
      }
    }
  }
  std::size_t mutants = 0;
  for (const FormulaLibrary& mutant : libraries()) {
    if (!isMutant(mutant)) {
      continue;
    }
    ++mutants;
    std::vector<Verdict> independent;
    std::set<std::string> others;
    std::set<std::string> all;
    for (Verdict& verdict : failures(checks().run(mutant))) {
      all.insert(checkOf(verdict));
      if (trustsTheFormulas(verdict)) {
        others.insert(checkOf(verdict));
      } else {
        independent.push_back(std::move(verdict));
      }
    }
    EXPECT_FALSE(independent.empty()) << mutant.name() << " survived";
    std::cout << std::left << std::setw(36) << mutant.name();
    const char* separator = "";
    for (const auto& [check, where] : summaryOf(independent)) {
      std::cout << separator << check << " (" << where << ')';
      separator = "; ";
    }
    separator = independent.empty() ? "SURVIVED [" : " [";
    for (const std::string& check : others) {
      std::cout << separator << check;
      separator = "; ";
    }
    std::cout << (others.empty() ? "\n" : "]\n");
    for (const std::string& check : all) {
      ++caught_by[check];
    }
  }
  EXPECT_GE(mutants, kFewestMutants);
  std::cout << "\nMutants of " << mutants << " that each check caught:\n";
  for (const auto& [check, count] : caught_by) {
    std::cout << std::right << std::setw(5) << count << "  " << check
              << (trusting.contains(check) ? " (trusts the formulas)" : "") << (count == 0 ? ": none\n" : "\n");
  }
}

/// What is loaded stays apart: with all mutants in the process the unmutated formulas still give the library's bits.
TEST(Mutants, DoNotReplaceOneAnothersFunctions) {
  const std::vector<FormulaLibrary> all = unmutatedLibraries();
  const auto production = std::find_if(all.begin(), all.end(), [](const FormulaLibrary& formulas) {
    return formulas.group() == FormulaGroup::kProduction;
  });
  ASSERT_NE(production, all.end());
  const Candidate unmutated = production->candidate(PolygonFormula::kProduction);
  const Candidate linked = productionCandidate();
  const InputFamily& family = inputFamily("generic");
  for (const Configuration& input : drawInputs(family, 20, kSeed)) {
    EXPECT_EQ(unmutated.form_factor(input), linked.form_factor(input)) << sceneLine(input);
    EXPECT_EQ(unmutated.gradient(input), linked.gradient(input)) << sceneLine(input);
    EXPECT_EQ(unmutated.hessian(input), linked.hessian(input)) << sceneLine(input);
    EXPECT_EQ(unmutated.tangential_hessian(input), linked.tangential_hessian(input)) << sceneLine(input);
    EXPECT_EQ(unmutated.rotational_gradient(input), linked.rotational_gradient(input)) << sceneLine(input);
  }
}

}  // namespace
}  // namespace irradiff
