// What the checks stand on: statistics, differences, random numbers, input families, diagnoses.

#include "verification/checks/error_diagnosis.h"
#include "verification/checks/input_families.h"
#include "verification/checks/random.h"
#include "verification/comparison/error_statistics.h"
#include "verification/finite_difference/ridders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <optional>
#include <set>

namespace irradiff {
namespace {

using Eigen::MatrixXd;
using testing::HasSubstr;

constexpr std::uint64_t kSeed = 20120806;

TEST(ErrorStatistics, PeakRootMeanSquareAndWorstInput) {
  ErrorStatistics statistics;
  EXPECT_EQ(statistics.count(), 0U);
  EXPECT_EQ(statistics.rootMeanSquare(), 0.0);
  statistics.add(3.0, 10);
  statistics.add(0.0, 11);
  statistics.add(4.0, 12);
  statistics.add(4.0, 13);
  EXPECT_EQ(statistics.count(), 4U);
  EXPECT_EQ(statistics.peak(), 4.0);
  EXPECT_DOUBLE_EQ(statistics.rootMeanSquare(), std::sqrt((9.0 + 16.0 + 16.0) / 4.0));
  EXPECT_EQ(statistics.worstInput(), 12U);
}

TEST(ErrorStatistics, NotANumberIsTheWorstWhateverFollows) {
  ErrorStatistics statistics;
  statistics.add(1.0, 0);
  statistics.add(std::numeric_limits<double>::quiet_NaN(), 1);
  statistics.add(std::numeric_limits<double>::infinity(), 2);
  EXPECT_TRUE(std::isnan(statistics.peak()));
  EXPECT_EQ(statistics.worstInput(), 1U);
}

struct KnownFunction {
  double (*value)(double);
  double (*derivative)(double);
};

const KnownFunction kKnownFunctions[] = {
    {[](double x) { return std::exp(x); }, [](double x) { return std::exp(x); }},
    {[](double x) { return std::sin(x); }, [](double x) { return std::cos(x); }},
    {[](double x) { return 1.0 / x; }, [](double x) { return -1.0 / (x * x); }},
};

/// Share of draws in which the true error of the derivative exceeds the estimate, f being disturbed by `noise`, of
/// which only `declared` is told.
double shareOfExceededEstimates(double noise, double declared, double* largest_estimate) {
  std::size_t exceeded = 0;
  std::size_t count = 0;
  for (const KnownFunction& known : kKnownFunctions) {
    KeyedRandom random(kSeed, "ridders", 0);
    for (std::size_t i = 0; i < lengthened(300); ++i) {
      const double x = random.between(0.3, 3.0);
      // Rounding of the value, and of x + h through the slope.
      const double rounding = 0x1p-53 * (2.0 * std::abs(known.value(x)) + 2.0 * x * std::abs(known.derivative(x)));
      const DifferenceResult<double> slope =
          riddersDerivative<double>([&](double h) { return known.value(x + h) + noise * random.between(-1.0, 1.0); },
                                    0.05 * x, rounding + declared);
      exceeded += std::abs(slope.value - known.derivative(x)) > slope.error ? 1 : 0;
      *largest_estimate = std::max(*largest_estimate, slope.error / std::abs(known.derivative(x) + 0.1));
      ++count;
    }
  }
  return static_cast<double>(exceeded) / static_cast<double>(count);
}

TEST(RiddersDerivative, ErrorEstimateIsHonest) {
  double largest_estimate = 0.0;
  EXPECT_EQ(shareOfExceededEstimates(0.0, 0.0, &largest_estimate), 0.0);
  // And tells something: half of the digits at least.
  EXPECT_LT(largest_estimate, 1e-8);
}

TEST(RiddersDerivative, DeclaredNoiseIsCovered) {
  double largest_estimate = 0.0;
  EXPECT_EQ(shareOfExceededEstimates(1e-9, 1e-9, &largest_estimate), 0.0);
  EXPECT_GT(largest_estimate, 1e-8);
}

TEST(RiddersDerivative, NoiseThatIsNotDeclaredExceedsTheEstimate) {
  double largest_estimate = 0.0;
  EXPECT_GT(shareOfExceededEstimates(1e-9, 0.0, &largest_estimate), 0.05);
}

TEST(KeyedRandom, SameBitsEverywhere) {
  // By another implementation of SplitMix64, which from state 1234567 gives the published 6457827717110365317.
  KeyedRandom random(kSeed, "generic", 7);
  EXPECT_EQ(random.next(), 0x7646dd0ce8aa22e4U);
  EXPECT_EQ(random.next(), 0xb30eec80daf31c21U);
  EXPECT_EQ(random.next(), 0x5eb35f34d86d7b8aU);
  KeyedRandom plain(0, "", 0);
  EXPECT_EQ(plain.next(), 0xb382a305f4414f5eU);
}

TEST(KeyedRandom, EveryPartOfTheKeyCounts) {
  std::set<std::uint64_t> first;
  for (const std::uint64_t seed : {1U, 2U}) {
    for (const char* stream : {"a", "b", "ab", "ba", ""}) {
      for (std::uint64_t index = 0; index < 100; ++index) {
        first.insert(KeyedRandom(seed, stream, index).next());
      }
    }
  }
  EXPECT_EQ(first.size(), 2U * 5U * 100U);
}

TEST(KeyedRandom, RangesAndDirections) {
  KeyedRandom random(kSeed, "ranges", 0);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  constexpr int kDraws = 10000;
  for (int i = 0; i < kDraws; ++i) {
    const double unit = random.unit();
    EXPECT_TRUE(unit >= 0.0 && unit < 1.0) << unit;
    const double decade = random.decade(-3.0, 2.0);
    EXPECT_TRUE(decade >= 1e-3 * (1.0 - 1e-15) && decade <= 100.0 * (1.0 + 1e-15)) << decade;
    EXPECT_LT(random.below(7), 7U);
    const Eigen::Vector3d direction = random.direction();
    EXPECT_NEAR(direction.norm(), 1.0, 4.0 * 0x1p-53);
    mean += direction / kDraws;
  }
  // Five standard errors of a component, whose variance is 1/3.
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 5.0 / std::sqrt(3.0 * kDraws));
}

TEST(InputFamilies, AnInputDependsOnItsIndexAlone) {
  for (const InputFamily& family : inputFamilies()) {
    const std::vector<Configuration> few = drawInputs(family, 2, kSeed);
    const std::vector<Configuration> many = drawInputs(family, 4, kSeed);
    ASSERT_EQ(many.size(), 4U);
    EXPECT_EQ(sceneLine(few[1]), sceneLine(many[1])) << family.name;
    EXPECT_NE(sceneLine(many[1]), sceneLine(many[2])) << family.name;
    EXPECT_NE(sceneLine(few[1]), sceneLine(drawInputs(family, 2, kSeed + 1)[1])) << family.name;
  }
}

TEST(InputFamilies, EveryInputIsAValidScene) {
  for (const InputFamily& family : inputFamilies()) {
    for (const Configuration& input : drawInputs(family, lengthened(50), kSeed)) {
      EXPECT_NO_THROW(validate(input.polygon, 0)) << family.name << ": " << sceneLine(input);
      EXPECT_NO_THROW(validate(input.receiver, 0)) << family.name << ": " << sceneLine(input);
    }
  }
}

TEST(InputFamilies, UnknownNameIsNamed) {
  try {
    inputFamily("no such family");
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("no such family"));
  }
}

/// Sets IRRADIFF_TEST_MULTIPLIER for as long as it lives.
class Multiplier {
 public:
  explicit Multiplier(const char* value) {
    if (const char* before = std::getenv(kName)) {
      before_ = before;
    }
    if (value != nullptr) {
      setenv(kName, value, 1);
    } else {
      unsetenv(kName);
    }
  }
  ~Multiplier() {
    if (before_) {
      setenv(kName, before_->c_str(), 1);
    } else {
      unsetenv(kName);
    }
  }
  Multiplier(const Multiplier&) = delete;
  Multiplier& operator=(const Multiplier&) = delete;

 private:
  static constexpr const char* kName = "IRRADIFF_TEST_MULTIPLIER";
  std::optional<std::string> before_;
};

std::size_t lengthenedBy(const char* multiplier, std::size_t count) {
  const Multiplier set(multiplier);
  return lengthened(count);
}

TEST(Lengthened, MultipliesAndNeverVanishes) {
  EXPECT_EQ(lengthenedBy(nullptr, 100), 100U);
  EXPECT_EQ(lengthenedBy("1", 100), 100U);
  EXPECT_EQ(lengthenedBy("2.5", 100), 250U);
  EXPECT_EQ(lengthenedBy("1e-6", 100), 1U);
}

TEST(Lengthened, RejectsWhatIsNoPositiveNumber) {
  for (const char* wrong : {"", "0", "-1", "abc", "2x", "nan", "inf", "1e10"}) {
    try {
      lengthenedBy(wrong, 100);
      ADD_FAILURE() << "accepted \"" << wrong << '"';
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("IRRADIFF_TEST_MULTIPLIER"), HasSubstr(std::string("\"") + wrong),
                                      HasSubstr("must be")));
    }
  }
}

TEST(Diagnose, RecognisesTheUsualMistakes) {
  constexpr double kPi = std::numbers::pi;
  MatrixXd right(3, 3);
  right << 1.0, 0.2, -0.4, 0.2, -2.0, 0.3, -0.4, 0.3, 0.5;
  EXPECT_THAT(diagnose(right, -right), HasSubstr("sign is flipped"));
  EXPECT_THAT(diagnose(right, 2.0 * right), HasSubstr("a factor 2 too much"));
  EXPECT_THAT(diagnose(right, 0.5 * right), HasSubstr("a factor 2 is missing"));
  EXPECT_THAT(diagnose(right, kPi * right), HasSubstr("divide by pi"));
  EXPECT_THAT(diagnose(right, right / kPi), HasSubstr("a factor pi is missing"));
  EXPECT_THAT(diagnose(right, 2.0 * kPi * right), HasSubstr("a factor 2 pi too much"));
  EXPECT_THAT(diagnose(right, right / (2.0 * kPi)), HasSubstr("a factor 2 pi is missing"));
  EXPECT_THAT(diagnose(right, 1.25 * right), HasSubstr("factor 1.25"));
  EXPECT_THAT(diagnose(right, (1.0 + 1e-10) * right), HasSubstr("digits are lost"));
  EXPECT_THAT(diagnose(MatrixXd::Zero(3, 3), right), HasSubstr("should vanish"));
  MatrixXd wrong = right;
  wrong(0, 2) = 0.4;
  EXPECT_THAT(diagnose(right, wrong), HasSubstr("not symmetric"));
  wrong(1, 1) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(diagnose(right, wrong), HasSubstr("not finite"));
  EXPECT_EQ(diagnose(right, right + MatrixXd::Identity(3, 3)), "");
}

}  // namespace
}  // namespace irradiff
