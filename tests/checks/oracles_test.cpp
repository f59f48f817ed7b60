// Every oracle: production passes, and a wrong twin is rejected with its likely cause.

#include "tests/checks/bad_twins.h"
#include "tests/checks/remembering_oracle.h"
#include "tests/checks/verdict_expectations.h"
#include "verification/checks/flatland_suite.h"
#include "verification/checks/input_families.h"
#include "verification/checks/oracle_check.h"
#include "verification/checks/reference_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

namespace irradiff {
namespace {

using Eigen::MatrixXd;

constexpr std::uint64_t kSeed = 20120806;
constexpr double kPromise = 2e-14;

Allowance promise() { return Allowance::uniform(kPromise, "the promise on well-conditioned polygons"); }

std::vector<Configuration> wellConditioned(std::size_t count) {
  return drawInputs(inputFamily("well-conditioned"), count, kSeed);
}

struct NamedOracle {
  const char* name;
  Oracle (*make)();
  std::size_t inputs;
};

class EveryOracle : public testing::TestWithParam<NamedOracle> {
 protected:
  static const std::vector<Configuration>& inputs() {
    static const std::vector<Configuration> drawn = wellConditioned(lengthened(20));
    return drawn;
  }
  /// One for all tests of the parameter.
  static const Oracle& oracle() {
    static std::map<std::string, Oracle> made;
    return made.try_emplace(GetParam().name, remembering(GetParam().make())).first->second;
  }
  static std::vector<Verdict> check(const Candidate& candidate) {
    const std::span<const Configuration> few(inputs().data(), std::min(inputs().size(), lengthened(GetParam().inputs)));
    return checkAgainst(oracle(), candidate, few, "well-conditioned", promise());
  }
  static bool knows(Quantity quantity) {
    return std::find(oracle().knows.begin(), oracle().knows.end(), quantity) != oracle().knows.end();
  }
};

TEST_P(EveryOracle, AcceptsProductionAndRejectsItsTwins) {
  expectAllPass(check(productionCandidate()));
  struct Twin {
    double factor;
    const char* cause;
  };
  for (const Twin& twin : {Twin{-1.0, "the sign is flipped"}, Twin{2.0, "a factor 2 too much"},
                           Twin{0.5, "a factor 2 is missing"}, Twin{1.0 / std::numbers::pi, "a factor pi is missing"},
                           Twin{1.01, "all is right but for a factor 1.01"}, Twin{1.0 + 1e-12, "digits are lost"}}) {
    for (const Quantity quantity : kQuantities) {
      if (knows(quantity)) {
        expectOnlyRejected(quantity, check(multiplied(quantity, twin.factor)), twin.cause);
      }
    }
  }
}

TEST_P(EveryOracle, RejectsADroppedEntryOfTheHessian) {
  const Candidate twin =
      spoiled(Quantity::kHessian, "dropped entry", [](const MatrixXd& value, const Configuration&) -> MatrixXd {
        MatrixXd wrong = value;
        wrong(0, 1) = 0.0;
        return wrong;
      });
  const std::vector<Configuration> one = wellConditioned(1);
  expectOnlyRejected(Quantity::kHessian, checkAgainst(oracle(), twin, one, "well-conditioned", promise()),
                     "the Hessian is not symmetric");
}

/// Those that know the rotational gradient.
class EveryOracleOfTheNormal : public EveryOracle {};

TEST_P(EveryOracleOfTheNormal, RejectsTheRotationalGradientOfTheOtherOrder) {
  ASSERT_TRUE(knows(Quantity::kRotationalGradient));
  // V x n, and n x g: V turned by a quarter too much.
  const std::vector<Configuration> one = wellConditioned(1);
  const auto check = [&one](const Candidate& twin) {
    return checkAgainst(oracle(), twin, one, "well-conditioned", promise());
  };
  expectOnlyRejected(Quantity::kRotationalGradient, check(multiplied(Quantity::kRotationalGradient, -1.0)),
                     "the sign is flipped");
  const Candidate turned = spoiled(Quantity::kRotationalGradient, "a quarter turn too much",
                                   [](const MatrixXd& value, const Configuration& c) -> MatrixXd {
                                     const Eigen::Vector3d gradient = value;
                                     return c.receiver.normal.cross(gradient);
                                   });
  expectOnlyRejected(Quantity::kRotationalGradient, check(turned), "");
}

TEST_P(EveryOracle, RejectsTheTangentialHessianInAnotherFrame) {
  // Tangents exchanged, and the frame's matrix transposed: its columns taken for rows in the plane.
  const std::vector<Configuration> one = wellConditioned(1);
  const Candidate exchanged =
      spoiled(Quantity::kTangentialHessian, "tangents exchanged",
              [](const MatrixXd& value, const Configuration&) -> MatrixXd { return value.reverse(); });
  expectOnlyRejected(Quantity::kTangentialHessian,
                     checkAgainst(oracle(), exchanged, one, "well-conditioned", promise()), "");
  const Candidate handed =
      spoiled(Quantity::kTangentialHessian, "left-handed", [](const MatrixXd& value, const Configuration&) -> MatrixXd {
        MatrixXd wrong = value;
        wrong(0, 1) = -value(0, 1);
        wrong(1, 0) = -value(1, 0);
        return wrong;
      });
  expectOnlyRejected(Quantity::kTangentialHessian, checkAgainst(oracle(), handed, one, "well-conditioned", promise()),
                     "");
}

constexpr NamedOracle kMultiprecision{"Multiprecision", multiprecisionOracle, 10};
constexpr NamedOracle kNestedJets{"NestedJets", jetOracle, 3};
constexpr NamedOracle kJetsOnTheGradient{"JetsOnTheGradient", gradientJetOracle, 5};
constexpr NamedOracle kDifferences{"Differences", differenceOracle, 1};
constexpr NamedOracle kEnclosures{"Enclosures", enclosureOracle, 1};

INSTANTIATE_TEST_SUITE_P(Oracles, EveryOracle,
                         testing::Values(kMultiprecision, kNestedJets, kJetsOnTheGradient, kDifferences, kEnclosures),
                         [](const auto& param) { return std::string(param.param.name); });
INSTANTIATE_TEST_SUITE_P(Oracles, EveryOracleOfTheNormal,
                         testing::Values(kMultiprecision, kNestedJets, kDifferences, kEnclosures),
                         [](const auto& param) { return std::string(param.param.name); });

TEST(CheckAgainst, NoInputsIsNoPass) {
  for (const Verdict& verdict : checkAgainst(multiprecisionOracle(), productionCandidate(), {}, "none", promise())) {
    EXPECT_FALSE(verdict.passed) << describe(verdict);
  }
}

TEST(CheckAgainst, AllowsTheOraclesOwnUncertaintyAndNoMore) {
  Oracle vague = multiprecisionOracle();
  const auto exact = vague.evaluate;
  const std::vector<Configuration> inputs = wellConditioned(1);
  const double gradient_norm = productionCandidate().gradient(inputs[0]).cwiseAbs().maxCoeff();
  vague.evaluate = [exact, gradient_norm](const Configuration& c) {
    std::optional<OracleValue> value = exact(c);
    value->gradient_uncertainty = 0.005 * gradient_norm;
    return value;
  };
  expectAllPass(checkAgainst(vague, multiplied(Quantity::kGradient, 1.004), inputs, "well-conditioned", promise()));
  expectOnlyRejected(Quantity::kGradient,
                     checkAgainst(vague, multiplied(Quantity::kGradient, 1.006), inputs, "well-conditioned", promise()),
                     "all is right but for a factor 1.006");
}

TEST(CheckBounds, AcceptsProductionOnEveryFamily) {
  for (const InputFamily& family : inputFamilies()) {
    expectAllPass(checkBounds(multiprecisionOracle(), productionCandidate(), drawInputs(family, lengthened(5), kSeed),
                              std::string(family.name)));
  }
}

TEST(CheckBounds, RejectsSinglePrecisionUnderBoundsOfDouble) {
  for (const Quantity quantity : kQuantities) {
    const Candidate twin = spoiled(
        quantity, "rounded to float",
        [](const MatrixXd& value, const Configuration&) -> MatrixXd { return value.cast<float>().cast<double>(); });
    expectOnlyRejected(quantity, checkBounds(multiprecisionOracle(), twin, wellConditioned(5), "well-conditioned"),
                       "digits are lost");
  }
}

TEST(CheckBounds, RejectsBoundsThatAreZeroOrNotANumber) {
  for (const double bound : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    Candidate twin = productionCandidate();
    twin.bounds = [bound](const Configuration&) { return DerivativeBounds{bound, bound, bound, bound, bound}; };
    for (const Verdict& verdict : checkBounds(multiprecisionOracle(), twin, wellConditioned(5), "well-conditioned")) {
      EXPECT_FALSE(verdict.passed) << describe(verdict);
    }
  }
}

/// A bound with the size of the error but no room for it: what a bound 10 times too small amounts to where it is tight.
TEST(CheckBounds, RejectsABoundTenTimesTooSmall) {
  const std::vector<Configuration> inputs = wellConditioned(10);
  const Oracle oracle = remembering(multiprecisionOracle());
  const auto tight = [oracle](double factor) {
    Candidate twin = productionCandidate();
    twin.bounds = [oracle, factor, right = productionCandidate()](const Configuration& c) {
      const OracleValue truth = *oracle.evaluate(c);
      const auto error = [](const auto& actual, const auto& expected) {
        double largest = 0.0;
        for (Eigen::Index i = 0; i < actual.size(); ++i) {
          largest = std::max(largest, abs(Multiprecision(actual(i)) - expected(i)).template convert_to<double>());
        }
        return largest;
      };
      const double value = abs(Multiprecision(right.form_factor(c)) - truth.form_factor).template convert_to<double>();
      return DerivativeBounds{factor * value, factor * error(right.gradient(c), truth.gradient),
                              factor * error(right.hessian(c), truth.hessian),
                              factor * error(right.tangential_hessian(c), truth.tangential_hessian),
                              factor * error(right.rotational_gradient(c), truth.rotational_gradient)};
    };
    return checkBounds(oracle, twin, wellConditioned(10), "well-conditioned");
  };
  expectAllPass(tight(1.0 + 1e-15));
  for (const Verdict& verdict : tight(0.1)) {
    EXPECT_FALSE(verdict.passed) << describe(verdict);
    EXPECT_NEAR(verdict.peak, 10.0, 1e-9);
  }
}

TEST(ReferenceData, RejectsTheThirteenthDigit) {
  const ReferenceOracle references("data/reference");
  const auto check = [&references](const Candidate& candidate) {
    const std::string family = "generic";
    const double tolerance = 1e-13;
    return checkAgainst(references.oracle(), candidate, references.inputsByFamily().at(family), family,
                        Allowance::uniform(tolerance, "the promise"));
  };
  expectAllPass(check(productionCandidate()));
  for (const Quantity quantity : kQuantities) {
    expectOnlyRejected(quantity, check(multiplied(quantity, 1.0 + 3e-13)), "digits are lost");
  }
}

TEST(ReferenceData, DoesNotKnowOtherInputs) {
  const ReferenceOracle references("data/reference");
  EXPECT_FALSE(references.oracle().evaluate(wellConditioned(1).front()).has_value());
}

FlatlandSuiteOptions flatlandOptions() {
  FlatlandSuiteOptions options;
  options.seed = kSeed;
  options.inputs = lengthened(3);
  options.reference_folder = "data/reference";
  return options;
}

TEST(Flatland, AcceptsProduction) { expectAllPass(checkFlatland(flatlandCandidate(), flatlandOptions())); }

TEST(Flatland, RejectsOnePerCentInEachQuantity) {
  const FlatlandCandidate right = flatlandCandidate();
  for (const Quantity quantity : kQuantities) {
    FlatlandCandidate twin = right;
    if (quantity == Quantity::kFormFactor) {
      twin.irradiance = [right](const FlatlandConfiguration& c) { return 1.01 * right.irradiance(c); };
    } else if (quantity == Quantity::kGradient) {
      twin.gradient = [right](const FlatlandConfiguration& c) -> Eigen::Vector2d { return 1.01 * right.gradient(c); };
    } else if (quantity == Quantity::kTangentialHessian) {
      twin.tangential_hessian = [right](const FlatlandConfiguration& c) { return 1.01 * right.tangential_hessian(c); };
    } else if (quantity == Quantity::kRotationalGradient) {
      twin.rotational_gradient = [right](const FlatlandConfiguration& c) {
        return 1.01 * right.rotational_gradient(c);
      };
    } else {
      twin.hessian = [right](const FlatlandConfiguration& c) -> Eigen::Matrix2d { return 1.01 * right.hessian(c); };
    }
    for (const Verdict& verdict : checkFlatland(twin, flatlandOptions())) {
      // Derivatives that sum to 0 do so after multiplication too.
      const bool is_blind = verdict.check == "closure" && quantity != Quantity::kFormFactor;
      EXPECT_EQ(verdict.passed, verdict.quantity != quantity || is_blind) << describe(verdict);
      if (!verdict.passed && verdict.check != "closure") {
        expectOnlyRejected(quantity, {verdict}, "1.01");
      }
    }
  }
}

TEST(Flatland, ClosureRejectsASideWithTheWrongSign) {
  const FlatlandCandidate right = flatlandCandidate();
  FlatlandCandidate twin = right;
  twin.hessian = [right](const FlatlandConfiguration& c) -> Eigen::Matrix2d {
    return (c.segment.vertices[0](0) > 0.0 ? -1.0 : 1.0) * right.hessian(c);
  };
  for (const Verdict& verdict : checkFlatland(twin, flatlandOptions())) {
    if (verdict.check == "closure") {
      EXPECT_EQ(verdict.passed, verdict.quantity != Quantity::kHessian) << describe(verdict);
    }
  }
}

}  // namespace
}  // namespace irradiff
