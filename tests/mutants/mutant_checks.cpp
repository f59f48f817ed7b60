#include "tests/mutants/mutant_checks.h"

#include "tests/checks/remembering_oracle.h"
#include "verification/checks/catalogue_check.h"
#include "verification/checks/input_families.h"
#include "verification/checks/invariants.h"
#include "verification/checks/oracle_check.h"
#include "verification/checks/self_consistency.h"
#include "verification/checks/suite.h"

#include <array>
#include <iterator>
#include <string_view>

namespace irradiff {
namespace {

/// Inputs for each check and family. The quadratures and differences of a candidate's own values cost some hundred
/// evaluations an input, the oracles in 200 digits tenths of a second.
constexpr std::size_t kInputs = 12;
constexpr std::size_t kCostlyInputs = 3;

/// The production promise on well-conditioned polygons, and elsewhere.
constexpr double kWellConditionedPromise = 2e-14;
constexpr double kPromise = 1e-13;
/// The appendix form loses (|r|/|e|)^3 u: edges of the family are at least 0.06 long, no vertex is farther than 3.5.
/// That makes 2e-11, for each of some terms.
constexpr double kAppendixTolerance = 1e-10;
/// The same, and acos of a number within a few u of 1: an angle is off by up to sqrt(8 u), 3e-8.
constexpr double kArccosTolerance = 1e-7;
constexpr std::string_view kReferencePrefix = "reference data: ";

void append(std::vector<Verdict>& all, std::vector<Verdict> more) {
  std::move(more.begin(), more.end(), std::back_inserter(all));
}

}  // namespace

/// What is promised of a formula.
struct MutantChecks::Extent {
  double tolerance;                             ///< on well-conditioned inputs
  bool knows_horizon = false;                   ///< also polygons partly below the horizon
  std::vector<std::string> extreme_families;    ///< of input_families.h
  std::vector<std::string> reference_families;  ///< of data/reference
};

MutantChecks::MutantChecks(std::filesystem::path reference_folder, std::uint64_t seed)
    : reference_folder_(std::move(reference_folder)),
      seed_(seed),
      references_(reference_folder_),
      stored_(remembering(references_.oracle())),
      rounding_(remembering(multiprecisionOracle())),
      jets_(remembering(jetOracle())),
      gradient_jets_(remembering(gradientJetOracle())),
      differences_(remembering(differenceOracle())),
      enclosures_(remembering(enclosureOracle())) {}

void MutantChecks::addPolygonVerdicts(const Candidate& candidate, const Extent& extent,
                                      std::vector<Verdict>& verdicts) const {
  const std::string plain = "well-conditioned";
  const std::vector<Configuration> inputs = drawInputs(inputFamily(plain), kInputs, seed_);
  const std::vector<Configuration> few(inputs.begin(), inputs.begin() + kCostlyInputs);
  const Allowance allowance = Allowance::uniform(extent.tolerance, "the formula's promise");
  append(verdicts, checkAgainst(rounding_, candidate, inputs, plain, allowance));
  for (const Oracle* oracle : {&jets_, &gradient_jets_, &differences_, &enclosures_}) {
    append(verdicts, checkAgainst(*oracle, candidate, few, plain, allowance));
  }
  append(verdicts, checkClosedForms(candidate, kCostlyInputs, seed_, extent.tolerance));
  append(verdicts, checkScaling(candidate, kInputs, seed_, extent.tolerance));
  append(verdicts, checkRotation(candidate, kInputs, seed_, extent.tolerance));
  append(verdicts, checkMirror(candidate, kInputs, seed_, extent.tolerance));
  append(verdicts, checkReversal(candidate, kInputs, seed_, extent.tolerance));
  append(verdicts, checkReciprocity(candidate, 1, seed_, extent.tolerance));
  append(verdicts, checkSymmetryAndTrace(candidate, kInputs, seed_, extent.tolerance));
  append(verdicts, checkSelfConsistency(candidate, kCostlyInputs, seed_, extent.tolerance));
  if (extent.knows_horizon) {
    append(verdicts, checkClosure(candidate, kInputs, seed_, extent.tolerance));
    append(verdicts, checkAdditivity(candidate, kInputs, seed_, extent.tolerance));
  }
  for (const std::string& name : extent.extreme_families) {
    const InputFamily& family = inputFamily(name);
    const std::vector<Configuration> drawn = drawInputs(family, kInputs, seed_);
    append(verdicts, checkAgainst(rounding_, candidate, drawn, name, promiseOf(family)));
    append(verdicts, checkBounds(rounding_, candidate, drawn, name));
  }
  for (const std::string& family : extent.reference_families) {
    const std::vector<Configuration>& stored = references_.inputsByFamily().at(family);
    const std::string name = std::string(kReferencePrefix) + family;
    append(verdicts, checkAgainst(stored_, candidate, stored, name, promiseOnReferences(family)));
    append(verdicts, checkBounds(stored_, candidate, stored, name));
  }
}

std::vector<Verdict> MutantChecks::run(const FormulaLibrary& formulas) const {
  std::vector<Verdict> verdicts;
  switch (formulas.group()) {
    case FormulaGroup::kBoundary: {
      // Scaling and the area rule for small polygons are what evaluatePolygon adds.
      const Extent boundary{
          kWellConditionedPromise,
          true,
          {"generic", "near edge", "near vertex", "near plane", "near radial", "translated", "horizon corner"},
          {"generic", "near_edge", "near_vertex", "near_plane", "near_radial", "translated", "horizon"}};
      addPolygonVerdicts(formulas.candidate(PolygonFormula::kBoundaryForm), boundary, verdicts);
      addPolygonVerdicts(formulas.candidate(PolygonFormula::kEdgeTerms), {kWellConditionedPromise, true, {}, {}},
                         verdicts);
      break;
    }
    case FormulaGroup::kAppendix:
      addPolygonVerdicts(formulas.candidate(PolygonFormula::kAppendixArccos), {kArccosTolerance, false, {}, {}},
                         verdicts);
      addPolygonVerdicts(formulas.candidate(PolygonFormula::kAppendixArctangent), {kAppendixTolerance, false, {}, {}},
                         verdicts);
      break;
    case FormulaGroup::kProduction: {
      Extent production{kWellConditionedPromise, true, {}, {}};
      for (const InputFamily& family : inputFamilies()) {
        production.extreme_families.emplace_back(family.name);
      }
      for (const auto& [family, inputs] : references_.inputsByFamily()) {
        production.reference_families.push_back(family);
      }
      addPolygonVerdicts(formulas.candidate(PolygonFormula::kProduction), production, verdicts);
      break;
    }
    case FormulaGroup::kSegment: {
      FlatlandSuiteOptions options;
      options.seed = seed_;
      options.inputs = kCostlyInputs;
      options.reference_folder = reference_folder_;
      append(verdicts, checkFlatland(formulas.flatlandCandidate(), options));
      break;
    }
  }
  return verdicts;
}

bool trustsTheFormulas(const Verdict& verdict) {
  static constexpr std::array<std::string_view, 4> kTrusting = {"multiprecision", "nested Jets on F",
                                                                "Jets on the gradient", "differences at 200 digits"};
  for (const std::string_view check : kTrusting) {
    if (verdict.check == check) {
      return true;
    }
  }
  return verdict.check == "claimed bound" && verdict.family.find("reference data") == std::string::npos;
}

}  // namespace irradiff
