#include "verification/checks/input_families.h"
#include "verification/checks/library_candidates.h"
#include "verification/checks/suite.h"

#include <gtest/gtest.h>

#include <iostream>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 20120806;

SuiteOptions productionOptions() {
  SuiteOptions options;
  options.seed = kSeed;
  options.inputs = lengthened(200);
  options.knows_horizon = true;
  options.promises_extremes = true;
  options.reference_folder = "data/reference";
  return options;
}

TEST(ProductionSuite, PassesEveryCheck) {
  const SuiteOptions options = productionOptions();
  std::cout << "seed " << options.seed << ", " << options.inputs << " inputs for each family\n";
  for (const Verdict& verdict : checkAll(productionCandidate(), options)) {
    EXPECT_TRUE(verdict.passed) << describe(verdict);
    std::cout << verdict.check << ", " << verdict.family << ", " << nameOf(verdict.quantity) << ": peak "
              << verdict.peak << ", rms " << verdict.rms << ", allowed " << verdict.tolerance << ", " << verdict.inputs
              << " inputs\n";
  }
}

/// The suite must be able to see each quantity go wrong by one per cent.
class OnePercentTwin : public testing::TestWithParam<Quantity> {};

TEST_P(OnePercentTwin, IsRejectedInThatQuantityAlone) {
  Candidate twin = productionCandidate();
  twin.name = "one per cent too large";
  twin.bounds = nullptr;
  const Candidate right = productionCandidate();
  switch (GetParam()) {
    case Quantity::kFormFactor:
      twin.form_factor = [right](const Configuration& c) { return 1.01 * right.form_factor(c); };
      break;
    case Quantity::kGradient:
      twin.gradient = [right](const Configuration& c) -> Eigen::Vector3d { return 1.01 * right.gradient(c); };
      break;
    case Quantity::kHessian:
      twin.hessian = [right](const Configuration& c) -> Eigen::Matrix3d { return 1.01 * right.hessian(c); };
      break;
    case Quantity::kTangentialHessian:
      twin.tangential_hessian = [right](const Configuration& c) -> Eigen::Matrix2d {
        return 1.01 * right.tangential_hessian(c);
      };
      break;
    case Quantity::kRotationalGradient:
      twin.rotational_gradient = [right](const Configuration& c) -> Eigen::Vector3d {
        return 1.01 * right.rotational_gradient(c);
      };
      break;
    case Quantity::kIrradiance:
      FAIL() << "not a quantity of one polygon";
  }
  SuiteOptions options = productionOptions();
  options.inputs = 10;
  options.slow_oracles = false;
  std::size_t oracle_failures = 0;
  for (const Verdict& verdict : checkAll(twin, options)) {
    // A form factor or gradient that is off also spoils the differences that its derivative is compared with.
    const bool is_oracle = verdict.check == "multiprecision" || verdict.check == "reference data";
    if (is_oracle && verdict.tolerance > 0.0) {
      EXPECT_EQ(verdict.passed, verdict.quantity != GetParam()) << describe(verdict);
      oracle_failures += verdict.passed ? 0 : 1;
    }
  }
  EXPECT_GT(oracle_failures, 0U);
}

INSTANTIATE_TEST_SUITE_P(Quantities, OnePercentTwin, testing::ValuesIn(kQuantities));

}  // namespace
}  // namespace irradiff
