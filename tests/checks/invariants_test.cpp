// Every check that needs no oracle: production passes, and a twin made wrong for exactly that check is rejected.

#include "verification/checks/invariants.h"

#include "tests/checks/bad_twins.h"
#include "tests/checks/verdict_expectations.h"
#include "verification/checks/catalogue_check.h"
#include "verification/checks/input_families.h"
#include "verification/checks/self_consistency.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>

namespace irradiff {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

constexpr std::uint64_t kSeed = 20120806;
/// The production promise on well-conditioned polygons.
constexpr double kPromise = 2e-14;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

using Check = std::vector<Verdict> (*)(const Candidate&, std::size_t, std::uint64_t, double);

struct NamedCheck {
  const char* name;
  Check check;
  std::size_t inputs;
};

class EveryCheck : public testing::TestWithParam<NamedCheck> {};

TEST_P(EveryCheck, ProductionPasses) {
  expectAllPass(GetParam().check(productionCandidate(), lengthened(GetParam().inputs), kSeed, kPromise));
}

TEST_P(EveryCheck, ThrowingCandidateIsRejected) {
  Candidate twin = productionCandidate();
  twin.form_factor = [](const Configuration&) -> double { throw std::runtime_error("no form factor today"); };
  twin.gradient = [](const Configuration&) -> Vector3d { throw std::runtime_error("no gradient today"); };
  twin.hessian = [](const Configuration&) -> Matrix3d { throw std::runtime_error("no Hessian today"); };
  twin.hessian_before_symmetrisation = twin.hessian;
  twin.tangential_hessian = [](const Configuration&) -> Matrix2d { throw std::runtime_error("nothing flat today"); };
  twin.rotational_gradient = [](const Configuration&) -> Vector3d { throw std::runtime_error("no turns today"); };
  for (const Verdict& verdict : GetParam().check(twin, 2, kSeed, kPromise)) {
    EXPECT_FALSE(verdict.passed) << describe(verdict);
    EXPECT_NE(verdict.actual.find("today"), std::string::npos) << verdict.actual;
    EXPECT_EQ(verdict.peak, std::numeric_limits<double>::infinity());
  }
}

TEST_P(EveryCheck, NotANumberIsRejected) {
  Candidate twin = productionCandidate();
  twin.form_factor = [](const Configuration&) { return kNan; };
  twin.gradient = [](const Configuration&) -> Vector3d { return Vector3d::Constant(kNan); };
  twin.hessian = [](const Configuration&) -> Matrix3d { return Matrix3d::Constant(kNan); };
  twin.hessian_before_symmetrisation = twin.hessian;
  twin.tangential_hessian = [](const Configuration&) -> Matrix2d { return Matrix2d::Constant(kNan); };
  twin.rotational_gradient = [](const Configuration&) -> Vector3d { return Vector3d::Constant(kNan); };
  for (const Verdict& verdict : GetParam().check(twin, 2, kSeed, kPromise)) {
    EXPECT_FALSE(verdict.passed) << describe(verdict);
    EXPECT_TRUE(std::isnan(verdict.peak));
  }
}

TEST_P(EveryCheck, NoInputsIsNoPass) {
  for (const Verdict& verdict : GetParam().check(productionCandidate(), 0, kSeed, kPromise)) {
    EXPECT_FALSE(verdict.passed) << describe(verdict);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Checks, EveryCheck,
    testing::Values(NamedCheck{"Closure", checkClosure, 30}, NamedCheck{"Additivity", checkAdditivity, 30},
                    NamedCheck{"Scaling", checkScaling, 30}, NamedCheck{"Rotation", checkRotation, 30},
                    NamedCheck{"Mirror", checkMirror, 30}, NamedCheck{"Reversal", checkReversal, 30},
                    NamedCheck{"Reciprocity", checkReciprocity, 2},
                    NamedCheck{"SymmetryAndTrace", checkSymmetryAndTrace, 30},
                    NamedCheck{"SelfConsistency", checkSelfConsistency, 5},
                    NamedCheck{"ClosedForms", checkClosedForms, 3},
                    NamedCheck{"ClosedFormsBetweenAreas", checkClosedFormsBetweenAreas, 2}),
    [](const auto& param) { return std::string(param.param.name); });

class OfEveryQuantity : public testing::TestWithParam<Quantity> {};

INSTANTIATE_TEST_SUITE_P(Quantities, OfEveryQuantity, testing::ValuesIn(kQuantities),
                         [](const auto& param) { return std::string(nameOf(param.param)).substr(0, 4); });

TEST_P(OfEveryQuantity, ClosureRejectsOnePerCentOnFacesSeenFromOneSide) {
  // A factor common to all faces would pass for the derivatives, which sum to 0; an edge with the wrong sign does not.
  const Candidate twin =
      spoiled(GetParam(), "wrong where x > 0", [](const MatrixXd& value, const Configuration& c) -> MatrixXd {
        return (c.polygon.vertices[0](0) > 0.0 ? 1.01 : 1.0) * value;
      });
  expectOnlyRejected(GetParam(), checkClosure(twin, 10, kSeed, kPromise), "");
}

TEST(Closure, RejectsAFormThatKnowsNoHorizon) {
  for (const Verdict& verdict : checkClosure(appendixArctangentCandidate(), 10, kSeed, kPromise)) {
    EXPECT_EQ(verdict.passed, verdict.quantity != Quantity::kFormFactor && verdict.peak <= verdict.tolerance);
  }
  EXPECT_FALSE(checkClosure(appendixArctangentCandidate(), 10, kSeed, 1e-9).front().passed);
}

TEST_P(OfEveryQuantity, AdditivityRejectsWhatIsNotProportionalToTheArea) {
  const Candidate twin = spoiled(
      GetParam(), "not additive",
      [](const MatrixXd& value, const Configuration&) -> MatrixXd { return (1.0 + 1e-3 * value.norm()) * value; });
  expectOnlyRejected(GetParam(), checkAdditivity(twin, 10, kSeed, kPromise), "");
}

TEST_P(OfEveryQuantity, ScalingRejectsAnAbsoluteThreshold) {
  const Candidate twin =
      spoiled(GetParam(), "absolute threshold", [](const MatrixXd& value, const Configuration& c) -> MatrixXd {
        const double length = (c.polygon.vertices[1] - c.polygon.vertices[0]).norm();
        return value / (1.0 + 1e-6 / length);
      });
  expectOnlyRejected(GetParam(), checkScaling(twin, 10, kSeed, kPromise), "an absolute threshold");
}

TEST_P(OfEveryQuantity, RotationRejectsAPreferredAxis) {
  const Candidate twin =
      spoiled(GetParam(), "prefers z", [](const MatrixXd& value, const Configuration& c) -> MatrixXd {
        return (1.0 + 0.01 * c.receiver.normal(2)) * value;
      });
  expectOnlyRejected(GetParam(), checkRotation(twin, 10, kSeed, kPromise), "a preferred axis");
}

TEST(Mirror, RejectsACrossProductInTheWrongOrderThatRotationDoesNotSee) {
  // n x g is a vector as good as g, except in the mirror.
  const Candidate twin =
      spoiled(Quantity::kGradient, "handed", [](const MatrixXd& value, const Configuration& c) -> MatrixXd {
        const Vector3d gradient = value;
        return gradient + 0.01 * c.receiver.normal.cross(gradient);
      });
  expectOnlyRejected(Quantity::kGradient, checkMirror(twin, 10, kSeed, kPromise), "");
  expectAllPass(checkRotation(twin, 10, kSeed, kPromise));
}

TEST_P(OfEveryQuantity, ReversalRejectsAnUnsignedForm) {
  const Candidate twin = spoiled(GetParam(), "unsigned", [](const MatrixXd& value, const Configuration& c) -> MatrixXd {
    return productionCandidate().form_factor(c) < 0.0 ? MatrixXd(-value) : value;
  });
  expectOnlyRejected(GetParam(), checkReversal(twin, 10, kSeed, kPromise), "the sign is flipped");
}

TEST(Reciprocity, RejectsAFormFactorThatDependsOnTheSide) {
  const Candidate twin =
      spoiled(Quantity::kFormFactor, "brighter upwards", [](const MatrixXd& value, const Configuration& c) -> MatrixXd {
        return (1.0 + 0.01 * c.receiver.normal(2)) * value;
      });
  expectOnlyRejected(Quantity::kFormFactor, checkReciprocity(twin, 1, kSeed, kPromise),
                     "all is right but for a factor");
}

/// The verdict on one check among those of checkSymmetryAndTrace.
Verdict verdictOf(const std::string& check, const std::vector<Verdict>& verdicts) {
  for (const Verdict& verdict : verdicts) {
    if (verdict.check == check) {
      return verdict;
    }
  }
  ADD_FAILURE() << "no verdict of " << check;
  return {};
}

TEST(SymmetryAndTrace, EachRejectsWhatTheOtherDoesNotSee) {
  const Candidate asymmetric =
      spoiled(Quantity::kHessian, "missing transpose", [](const MatrixXd& value, const Configuration&) -> MatrixXd {
        MatrixXd wrong = value;
        wrong(0, 1) += 0.01 * value.norm();
        return wrong;
      });
  const std::vector<Verdict> of_asymmetric = checkSymmetryAndTrace(asymmetric, 10, kSeed, kPromise);
  expectOnlyRejected(Quantity::kHessian, {verdictOf("symmetry", of_asymmetric)}, "the Hessian is not symmetric");
  expectAllPass({verdictOf("trace", of_asymmetric)});

  const Candidate without_identity = spoiled(Quantity::kHessian, "wrong multiple of the identity",
                                             [](const MatrixXd& value, const Configuration&) -> MatrixXd {
                                               return value + 0.01 * value.norm() * Matrix3d::Identity();
                                             });
  const std::vector<Verdict> of_identity = checkSymmetryAndTrace(without_identity, 10, kSeed, kPromise);
  expectAllPass({verdictOf("symmetry", of_identity)});
  expectOnlyRejected(Quantity::kHessian, {verdictOf("trace", of_identity)}, "");
}

/// The sum over edges is symmetric only if every edge's term is right; the average with its transpose always is.
TEST(Symmetry, SeesAnEdgeTermThatTheAverageWithTheTransposeHides) {
  const Candidate right = productionCandidate();
  Candidate twin = right;
  twin.hessian_before_symmetrisation = [right](const Configuration& c) -> Matrix3d {
    Matrix3d wrong = right.hessian_before_symmetrisation(c);
    wrong(0, 1) += 0.01 * wrong.norm();
    wrong(1, 0) -= 0.01 * wrong.norm();
    return wrong;
  };
  expectAllPass({verdictOf("symmetry", checkSymmetryAndTrace(right, 10, kSeed, kPromise))});
  expectOnlyRejected(Quantity::kHessian, {verdictOf("symmetry", checkSymmetryAndTrace(twin, 10, kSeed, kPromise))},
                     "the Hessian is not symmetric");
}

/// The verdict on one quantity among those of checkSelfConsistency.
Verdict verdictOn(Quantity quantity, const std::vector<Verdict>& verdicts) {
  for (const Verdict& verdict : verdicts) {
    if (verdict.quantity == quantity) {
      return verdict;
    }
  }
  ADD_FAILURE() << "no verdict on " << nameOf(quantity);
  return {};
}

TEST(SelfConsistency, RejectsARotationalGradientOfTheOtherOrder) {
  const std::vector<Verdict> verdicts =
      checkSelfConsistency(multiplied(Quantity::kRotationalGradient, -1.0), 3, kSeed, kPromise);
  expectOnlyRejected(Quantity::kRotationalGradient, verdicts, "the sign is flipped");
}

TEST(SelfConsistency, RejectsATangentialHessianWithoutItsFactor2) {
  const std::vector<Verdict> verdicts =
      checkSelfConsistency(multiplied(Quantity::kTangentialHessian, 0.5), 3, kSeed, kPromise);
  expectOnlyRejected(Quantity::kTangentialHessian, verdicts, "a factor 2 is missing");
}

TEST(SelfConsistency, RejectsAGradientThatBelongsToAnotherFunction) {
  const std::vector<Verdict> verdicts = checkSelfConsistency(multiplied(Quantity::kGradient, 2.0), 3, kSeed, kPromise);
  expectOnlyRejected(Quantity::kGradient, {verdictOn(Quantity::kGradient, verdicts)}, "a factor 2 too much");
  // The Hessian is right, but not for this gradient.
  expectOnlyRejected(Quantity::kHessian, {verdictOn(Quantity::kHessian, verdicts)}, "a factor 2 is missing");
}

TEST(SelfConsistency, RejectsAHessianOnePerCentOff) {
  expectOnlyRejected(Quantity::kHessian, checkSelfConsistency(multiplied(Quantity::kHessian, 1.01), 3, kSeed, kPromise),
                     "all is right but for a factor 1.01");
}

TEST(ClosedForms, RejectAFormFactorThatIsAnIrradiance) {
  expectOnlyRejected(Quantity::kFormFactor,
                     checkClosedForms(multiplied(Quantity::kFormFactor, std::numbers::pi), 3, kSeed, kPromise),
                     "irradiance of radiance 1 instead of a form factor");
}

TEST(ClosedForms, SeeTwelveDigitsLost) {
  expectOnlyRejected(Quantity::kFormFactor,
                     checkClosedForms(multiplied(Quantity::kFormFactor, 1.0 + 1e-8), 3, kSeed, kPromise),
                     "digits are lost");
}

TEST(ClosedFormsBetweenAreas, RejectAFormFactorThatIsAnIrradiance) {
  expectOnlyRejected(
      Quantity::kFormFactor,
      checkClosedFormsBetweenAreas(multiplied(Quantity::kFormFactor, std::numbers::pi), 1, kSeed, kPromise),
      "irradiance of radiance 1 instead of a form factor");
}

TEST(ClosedFormsBetweenAreas, SeeTenDigitsLost) {
  expectOnlyRejected(Quantity::kFormFactor,
                     checkClosedFormsBetweenAreas(multiplied(Quantity::kFormFactor, 1.0 + 1e-10), 1, kSeed, kPromise),
                     "");
}

TEST(ClosedFormsBetweenAreas, DoNotTakeNoiseForAnErrorOfTheQuadrature) {
  // So noisy that the quadrature's estimate of its own error is as large as the values.
  Candidate noise = productionCandidate();
  noise.form_factor = [](const Configuration& c) { return std::sin(1e9 * c.receiver.position.sum()); };
  expectOnlyRejected(Quantity::kFormFactor, checkClosedFormsBetweenAreas(noise, 1, kSeed, kPromise), "");
}

TEST(ClosedForms, CoverTenNumbersOfHowellsCatalogue) {
  std::set<std::string> numbers;
  for (const auto& check : {checkClosedForms, checkClosedFormsBetweenAreas}) {
    for (const Verdict& verdict : check(productionCandidate(), 1, kSeed, kPromise)) {
      if (verdict.check != "closed form " + verdict.family) {
        numbers.insert(verdict.check);
      }
    }
  }
  EXPECT_GE(numbers.size(), 10U);
}

}  // namespace
}  // namespace irradiff
