#include "verification/report/accuracy_report.h"

#include "verification/checks/input_families.h"
#include "verification/checks/library_candidates.h"
#include "verification/checks/oracle_check.h"
#include "verification/checks/suite.h"
#include "verification/report/headline.h"
#include "verification/report/parallel_tasks.h"

#include <algorithm>
#include <iterator>

namespace irradiff {
namespace {

void append(std::vector<Verdict>& all, const std::vector<Verdict>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// Families whose polygons are above the horizon: all that a formula without a horizon can be asked.
bool isAboveHorizon(const InputFamily& family, const std::vector<Configuration>& inputs) {
  return family.name != "generic" && std::all_of(inputs.begin(), inputs.end(), [](const Configuration& c) {
           return std::all_of(c.polygon.vertices.begin(), c.polygon.vertices.end(), [&](const Eigen::Vector3d& v) {
             return c.receiver.normal.dot(v - c.receiver.position) > 0.0;
           });
         });
}

std::vector<Verdict> checkProduction(const Candidate& production, const ReportSizes& sizes,
                                     const ReportOptions& options) {
  SuiteOptions suite;
  suite.seed = options.seed;
  suite.inputs = sizes.inputs;
  suite.tolerance = kWellConditionedPromise;
  suite.knows_horizon = true;
  suite.promises_extremes = true;
  suite.slow_oracles = false;  // a part of its own
  suite.reference_folder = options.reference_folder;
  return checkAll(production, suite);
}

std::vector<Verdict> checkBySlowOracle(const Oracle& oracle, const Candidate& production, const ReportSizes& sizes,
                                       std::uint64_t seed) {
  const InputFamily& family = inputFamily("well-conditioned");
  const std::vector<Configuration> inputs = drawInputs(family, sizes.slow_oracle_inputs, seed);
  const Allowance allowance = Allowance::uniform(kWellConditionedPromise, "the promise on well-conditioned polygons");
  return checkAgainst(oracle, production, inputs, std::string(family.name), allowance);
}

/// Errors of production where it promises no figure.
std::vector<Verdict> measureUnpromised(const Candidate& production, const ReportSizes& sizes, std::uint64_t seed) {
  std::vector<Verdict> verdicts;
  // Any finite figure would do: the verdict's outcome is not used, only its worst input.
  constexpr double kAsLargeAsTheValue = 1.0;
  for (const InputFamily& family : inputFamilies()) {
    const auto unpromised = [](double promise) { return promise > 0.0 ? 0.0 : kAsLargeAsTheValue; };
    const Allowance allowance{0.0,
                              unpromised(family.gradient_promise),
                              unpromised(family.hessian_promise),
                              unpromised(family.tangential_hessian_promise),
                              unpromised(family.rotational_gradient_promise),
                              "none: measured, not judged"};
    if (allowance.gradient > 0.0 || allowance.hessian > 0.0 || allowance.tangential_hessian > 0.0 ||
        allowance.rotational_gradient > 0.0) {
      append(verdicts, checkAgainst(multiprecisionOracle(), production, drawInputs(family, sizes.inputs, seed),
                                    std::string(family.name), allowance));
    }
  }
  return verdicts;
}

std::vector<Verdict> checkComparison(const ComparisonFormula& formula, const ReportSizes& sizes, std::uint64_t seed) {
  SuiteOptions suite;
  suite.seed = seed;
  suite.inputs = sizes.inputs;
  suite.tolerance = kWellConditionedPromise;
  suite.knows_horizon = formula.knows_horizon;
  suite.slow_oracles = false;
  std::vector<Verdict> verdicts = checkAll(formula.candidate, suite);
  Allowance asked = Allowance::uniform(kExtremePromise, "what the production path promises; not promised here");
  asked.form_factor = 0.0;
  for (const InputFamily& family : inputFamilies()) {
    if (family.name == "well-conditioned") {
      continue;
    }
    std::vector<Configuration> inputs = drawInputs(family, sizes.inputs, seed);
    if (!formula.knows_horizon) {
      std::erase_if(inputs, [&](const Configuration& c) { return !isAboveHorizon(family, {c}); });
    }
    if (!inputs.empty()) {
      append(verdicts,
             checkAgainst(multiprecisionOracle(), formula.candidate, inputs, std::string(family.name), asked));
    }
  }
  return verdicts;
}

}  // namespace

const char* nameOf(Effort effort) {
  switch (effort) {
    case Effort::kQuick:
      return "quick";
    case Effort::kStandard:
      return "standard";
    case Effort::kFull:
      return "full";
  }
  return "";
}

ReportSizes sizesOf(Effort effort) {
  switch (effort) {
    case Effort::kQuick:
      return {30, 3, 8, 4, 100};
    case Effort::kStandard:
      return {200, 20, 60, 12, 500};
    case Effort::kFull:
      return {1000, 60, 400, 40, 2000};
  }
  return {};
}

ReportedFormulas libraryFormulas() {
  return {productionCandidate(),
          flatlandCandidate(),
          {{plainBoundaryCandidate(),
            "The same formula in plain double precision, without the edge rule's compensation.", true},
           {appendixArctangentCandidate(), "Equations (19) to (21) of the 2012 paper, signs corrected, angle by atan2.",
            false},
           {appendixArccosCandidate(),
            "The same, the angle by acos of the normalised dot product, as renderers write it.", false}},
          boundedEvaluators()};
}

std::vector<Verdict> brokenPromises(const AccuracyReport& report) {
  std::vector<Verdict> broken;
  for (const FormulaResults& formula : report.formulas) {
    if (formula.is_promised) {
      append(broken, failures(formula.verdicts));
    }
  }
  return broken;
}

std::vector<Erratum> unconfirmedErrata(const AccuracyReport& report) {
  std::vector<Erratum> unconfirmed;
  std::copy_if(report.errata.begin(), report.errata.end(), std::back_inserter(unconfirmed), [](const Erratum& erratum) {
    return !std::all_of(erratum.measurements.begin(), erratum.measurements.end(),
                        [](const ErratumMeasurement& m) { return m.isConfirmed(); });
  });
  return unconfirmed;
}

std::vector<BoundTightness> brokenBounds(const AccuracyReport& report) {
  std::vector<BoundTightness> broken;
  std::ranges::copy_if(report.tightness, std::back_inserter(broken),
                       [](const BoundTightness& tightness) { return !tightness.holds(); });
  return broken;
}

int exitStatusOf(const AccuracyReport& report) {
  return brokenPromises(report).empty() && brokenBounds(report).empty() && unconfirmedErrata(report).empty() ? 0 : 1;
}

AccuracyReport makeReport(const ReportedFormulas& formulas, const ReportOptions& options) {
  const ReportSizes sizes = sizesOf(options.effort);
  AccuracyReport report;
  report.effort = options.effort;
  report.seed = options.seed;
  report.references = summariseReferences(options.reference_folder);
  report.formulas.push_back({formulas.production.name,
                             "The boundary form with its edge rule, the area rule for small polygons, scaling and "
                             "claimed bounds: what irradiff evaluate uses.",
                             true,
                             false,
                             {},
                             {}});
  report.formulas.push_back({formulas.flatland.name, "The same in two dimensions.", true, true, {}, {}});
  for (const ComparisonFormula& formula : formulas.comparisons) {
    report.formulas.push_back({formula.candidate.name, formula.description, false, false, {}, {}});
  }
  report.sweeps.resize(sweepInputs().size());

  std::vector<std::function<void()>> tasks;
  std::vector<Verdict> production;
  std::vector<Verdict> enclosed;
  std::vector<Verdict> differenced;
  tasks.emplace_back(
      [&] { enclosed = checkBySlowOracle(enclosureOracle(), formulas.production, sizes, options.seed); });
  tasks.emplace_back([&] { production = checkProduction(formulas.production, sizes, options); });
  tasks.emplace_back(
      [&] { report.formulas[0].unjudged = measureUnpromised(formulas.production, sizes, options.seed); });
  tasks.emplace_back([&] { report.errata = measureErrata(sizes.errata_inputs, options.seed); });
  tasks.emplace_back([&] { report.gap_filling = measureGapFillingLosses(sizes.gap_filling_scenes, options.seed); });
  tasks.emplace_back(
      [&] { differenced = checkBySlowOracle(differenceOracle(), formulas.production, sizes, options.seed); });
  tasks.emplace_back([&] {
    FlatlandSuiteOptions suite;
    suite.seed = options.seed;
    suite.inputs = sizes.inputs;
    suite.reference_folder = options.reference_folder;
    report.formulas[1].verdicts = checkFlatland(formulas.flatland, suite);
  });
  for (std::size_t i = 0; i < formulas.comparisons.size(); ++i) {
    tasks.emplace_back(
        [&, i] { report.formulas[2 + i].verdicts = checkComparison(formulas.comparisons[i], sizes, options.seed); });
  }
  std::vector<std::vector<BoundTightness>> tightness(formulas.bounded.size());
  for (std::size_t i = 0; i < formulas.bounded.size(); ++i) {
    tasks.emplace_back([&, i] { tightness[i] = measureTightness(formulas.bounded[i], sizes.inputs, options.seed); });
  }
  for (std::size_t i = 0; i < sweepInputs().size(); ++i) {
    tasks.emplace_back([&, i] {
      const SweepInputs& inputs = sweepInputs()[i];
      std::vector<Candidate> comparisons;
      for (const ComparisonFormula& formula : formulas.comparisons) {
        if (formula.knows_horizon || inputs.is_above_horizon) {
          comparisons.push_back(formula.candidate);
        }
      }
      report.sweeps[i] = sweepErrors(inputs, formulas.production, comparisons, sizes.sweep_samples, options.seed);
    });
  }
  runTasks(tasks, options.threads, options.progress);
  for (const std::vector<BoundTightness>& of_one : tightness) {
    report.tightness.insert(report.tightness.end(), of_one.begin(), of_one.end());
  }

  std::vector<Verdict>& verdicts = report.formulas[0].verdicts;
  append(verdicts, enclosed);
  append(verdicts, differenced);
  append(verdicts, production);
  for (const ErrorSweep& sweep : report.sweeps) {
    append(verdicts, sweep.verdicts);
    append(report.formulas[0].unjudged, sweep.unjudged);
  }
  return report;
}

}  // namespace irradiff
