#include "verification/checks/suite.h"

#include "verification/checks/catalogue_check.h"
#include "verification/checks/input_families.h"
#include "verification/checks/invariants.h"
#include "verification/checks/oracle_check.h"
#include "verification/checks/reference_oracle.h"
#include "verification/checks/self_consistency.h"

#include <algorithm>
#include <iterator>

namespace irradiff {
namespace {

/// The family of data/reference without extremes: above the horizon, no edge near or short.
constexpr std::string_view kPlainReferences = "generic";

void append(std::vector<Verdict>& all, std::vector<Verdict> more) {
  std::move(more.begin(), more.end(), std::back_inserter(all));
}

Allowance allowanceOn(const InputFamily& family, const SuiteOptions& options) {
  if (family.name == "well-conditioned") {
    return Allowance::uniform(options.tolerance, "the promise on well-conditioned polygons");
  }
  return promiseOf(family);
}

}  // namespace

Allowance promiseOf(const InputFamily& family) {
  return {0.0,
          family.gradient_promise,
          family.hessian_promise,
          family.tangential_hessian_promise,
          family.rotational_gradient_promise,
          "the promise on this family"};
}

Allowance promiseOnReferences(const std::string& family) {
  const double promise = family == "sliver" ? 0.0 : 1e-13;
  Allowance allowance = Allowance::uniform(promise, "the promise on the reference cases; none on slivers");
  allowance.form_factor = 0.0;
  if (family == "near_plane" || family == "near_radial") {
    // Seen almost edge-on from outside the rotational gradient loses digits, as F does.
    allowance.rotational_gradient = 0.0;
  }
  return allowance;
}

std::vector<Verdict> checkAll(const Candidate& candidate, const SuiteOptions& options) {
  std::vector<Verdict> verdicts;
  const InputFamily& plain = inputFamily("well-conditioned");
  const Allowance plain_allowance = allowanceOn(plain, options);
  const std::vector<Configuration> plain_inputs = drawInputs(plain, options.inputs, options.seed);
  append(verdicts,
         checkAgainst(multiprecisionOracle(), candidate, plain_inputs, std::string(plain.name), plain_allowance));
  append(verdicts, checkAgainst(jetOracle(), candidate, plain_inputs, std::string(plain.name), plain_allowance));
  append(verdicts,
         checkAgainst(gradientJetOracle(), candidate, plain_inputs, std::string(plain.name), plain_allowance));
  if (options.slow_oracles) {
    const std::vector<Configuration> few(
        plain_inputs.begin(),
        plain_inputs.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(1, options.inputs / 10)));
    append(verdicts, checkAgainst(differenceOracle(), candidate, few, std::string(plain.name), plain_allowance));
    append(verdicts, checkAgainst(enclosureOracle(), candidate, few, std::string(plain.name), plain_allowance));
  }
  append(verdicts,
         checkClosedForms(candidate, std::max<std::size_t>(1, options.inputs / 10), options.seed, options.tolerance));
  append(verdicts, checkClosedFormsBetweenAreas(candidate, std::max<std::size_t>(1, options.inputs / 10), options.seed,
                                                options.tolerance));
  append(verdicts, checkScaling(candidate, options.inputs, options.seed, options.tolerance));
  append(verdicts, checkRotation(candidate, options.inputs, options.seed, options.tolerance));
  append(verdicts, checkMirror(candidate, options.inputs, options.seed, options.tolerance));
  append(verdicts, checkReversal(candidate, options.inputs, options.seed, options.tolerance));
  append(verdicts,
         checkReciprocity(candidate, std::max<std::size_t>(1, options.inputs / 10), options.seed, options.tolerance));
  append(verdicts, checkSymmetryAndTrace(candidate, options.inputs, options.seed, options.tolerance));
  append(verdicts, checkSelfConsistency(candidate, options.inputs, options.seed, options.tolerance));
  if (options.knows_horizon) {
    append(verdicts, checkClosure(candidate, options.inputs, options.seed, options.tolerance));
    append(verdicts, checkAdditivity(candidate, options.inputs, options.seed, options.tolerance));
  }
  if (options.promises_extremes) {
    for (const InputFamily& family : inputFamilies()) {
      const std::vector<Configuration> inputs = drawInputs(family, options.inputs, options.seed);
      const std::string name(family.name);
      if (family.name != plain.name) {
        append(verdicts, checkAgainst(multiprecisionOracle(), candidate, inputs, name, allowanceOn(family, options)));
      }
      append(verdicts, checkBounds(multiprecisionOracle(), candidate, inputs, name));
    }
  }
  if (!options.reference_folder.empty()) {
    const ReferenceOracle references(options.reference_folder);
    for (const auto& [family, inputs] : references.inputsByFamily()) {
      if (!options.promises_extremes && family != kPlainReferences) {
        continue;
      }
      const Allowance allowance = options.promises_extremes ? promiseOnReferences(family) : plain_allowance;
      append(verdicts, checkAgainst(references.oracle(), candidate, inputs, family, allowance));
      append(verdicts, checkBounds(references.oracle(), candidate, inputs, family));
    }
  }
  return verdicts;
}

}  // namespace irradiff
