// The reference values again: all of them by differences of the contour formula, a part by the integrals that made
// them, and one family by the program.

#include "verification/enclosure/contour_integral.h"
#include "verification/enclosure/flatland_integral.h"
#include "verification/enclosure/polar_integral.h"
#include "verification/reference/reference_data.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace irradiff {
namespace {

const std::filesystem::path kFolder = "data/reference";

/// What a file says, as a ball: the decimal and its stated error.
Ball stated(const ReferenceNumber& number, const std::string& error) {
  Ball ball = Ball::fromDecimal(number.decimal);
  arb_add_error(ball.get(), Ball::fromDecimal(error).get());
  return ball;
}

/// n x g, in flatland (J n).g, of a gradient g with respect to the normal.
std::vector<Ball> turned(const Eigen::Vector3d& n, const BallVector& g) {
  return {Ball(n(1)) * g(2) - Ball(n(2)) * g(1), Ball(n(2)) * g(0) - Ball(n(0)) * g(2),
          Ball(n(0)) * g(1) - Ball(n(1)) * g(0)};
}
std::vector<Ball> turned(const Eigen::Vector2d& n, const Eigen::Matrix<Ball, 2, 1>& g) {
  return {Ball(n(0)) * g(1) - Ball(n(1)) * g(0)};
}

/// The components of `computed` that do not meet what the file says, by name. The two agree when there is none.
template <class Case, class Enclosure>
std::vector<std::string> disagreements(const Case& reference, const Enclosure& computed) {
  const WorkingPrecision scope(precisionForDigits(300));
  std::vector<std::string> names;
  if (!computed.value.overlaps(stated(reference.value, reference.error.value))) names.emplace_back("value");
  for (Eigen::Index i = 0; i < computed.gradient.size(); ++i) {
    const std::string index = "[" + std::to_string(i) + "]";
    if (!computed.gradient(i).overlaps(stated(reference.gradient(i), reference.error.gradient))) {
      names.push_back("gradient" + index);
    }
    for (Eigen::Index j = 0; j < computed.gradient.size(); ++j) {
      if (!computed.hessian(i, j).overlaps(stated(reference.hessian(i, j), reference.error.hessian))) {
        names.push_back("hessian" + index + "[" + std::to_string(j) + "]");
      }
    }
  }
  const std::vector<Ball> rotational = turned(reference.receiver.normal, computed.normal_gradient);
  for (std::size_t i = 0; i < rotational.size(); ++i) {
    const ReferenceNumber& number = reference.rotational_gradient(static_cast<Eigen::Index>(i));
    if (!rotational[i].overlaps(stated(number, reference.error.rotational_gradient))) {
      names.push_back("rotational_gradient[" + std::to_string(i) + "]");
    }
  }
  return names;
}

template <class Case, class Enclosure>
void expectAgreement(const Case& reference, const Enclosure& computed) {
  for (const std::string& name : disagreements(reference, computed)) {
    ADD_FAILURE() << reference.family << "/" << reference.name << ": " << name;
  }
}

/// The number with its digit at `position` (1 is the first significant one) changed by one.
ReferenceNumber withDigitChanged(ReferenceNumber number, int position) {
  bool significant = false;
  for (char& c : number.decimal) {
    if (c == 'e') break;
    if (c < '0' || c > '9') continue;
    significant = significant || c != '0';
    if (significant && --position == 0) {
      c = c == '9' ? '8' : static_cast<char>(c + 1);
      return number;
    }
  }
  ADD_FAILURE() << number.decimal << " has too few digits";
  return number;
}

TEST(Regeneration, EveryPolygonAgreesWithDifferencesOfTheContour) {
  for (const ReferenceCase& reference : readReferenceData(kFolder)) {
    expectAgreement(reference, differenceContour(reference.polygon, reference.receiver));
  }
}

TEST(Regeneration, EverySegmentAgreesWithDifferencesOfTheClosedForm) {
  for (const FlatlandReferenceCase& reference : readFlatlandReferenceData(kFolder)) {
    expectAgreement(reference, differenceFlatland(reference.segment, reference.receiver));
  }
}

TEST(Regeneration, TheFirstOfEachFamilyAgreesWithItsIntegral) {
  std::set<std::string> families;
  for (const ReferenceCase& reference : readReferenceData(kFolder)) {
    if (!families.insert(reference.family).second) continue;
    expectAgreement(reference, enclosePolar(reference.polygon, reference.receiver, 45));
  }
  for (const FlatlandReferenceCase& reference : readFlatlandReferenceData(kFolder)) {
    expectAgreement(reference, encloseFlatland(reference.segment, reference.receiver, 45));
  }
}

TEST(Regeneration, AChangeInThe38thDigitIsFound) {
  const ReferenceCase reference = readReferenceFile(kFolder / "generic.json").front();
  const FormFactorEnclosure computed = enclosePolar(reference.polygon, reference.receiver, 45);
  ASSERT_TRUE(disagreements(reference, computed).empty());
  ReferenceCase twin = reference;
  twin.value = withDigitChanged(twin.value, 38);
  EXPECT_EQ(disagreements(twin, computed), std::vector<std::string>{"value"});
  twin = reference;
  twin.gradient(1) = withDigitChanged(twin.gradient(1), 38);
  EXPECT_EQ(disagreements(twin, computed), std::vector<std::string>{"gradient[1]"});
  twin = reference;
  twin.hessian(2, 0) = withDigitChanged(twin.hessian(2, 0), 38);
  EXPECT_EQ(disagreements(twin, computed), std::vector<std::string>{"hessian[2][0]"});
  twin = reference;
  twin.rotational_gradient(1) = withDigitChanged(twin.rotational_gradient(1), 38);
  EXPECT_EQ(disagreements(twin, computed), std::vector<std::string>{"rotational_gradient[1]"});
}

TEST(Regeneration, TheProgramMakesTheFileAgain) {
  const char* program = std::getenv("IRRADIFF_GENERATE_REFERENCE");
  ASSERT_NE(program, nullptr) << "IRRADIFF_GENERATE_REFERENCE must name the program generate_reference";
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "irradiff_regenerated";
  std::filesystem::remove_all(folder);
  const std::string command =
      "\"" + std::string(program) + "\" --only tiny_at_horizon --output \"" + folder.string() + "\"";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const auto again = readReferenceFile(folder / "tiny_at_horizon.json");
  const auto reference = readReferenceFile(kFolder / "tiny_at_horizon.json");
  std::filesystem::remove_all(folder);
  ASSERT_EQ(again.size(), reference.size());
  for (std::size_t i = 0; i < again.size(); ++i) {
    EXPECT_EQ(again[i].name, reference[i].name);
    EXPECT_EQ(again[i].polygon.vertices, reference[i].polygon.vertices);
    EXPECT_EQ(again[i].receiver.position, reference[i].receiver.position);
    EXPECT_EQ(again[i].receiver.normal, reference[i].receiver.normal);
    EXPECT_EQ(again[i].value.decimal, reference[i].value.decimal);
    for (Eigen::Index j = 0; j < 3; ++j) {
      EXPECT_EQ(again[i].gradient(j).decimal, reference[i].gradient(j).decimal);
      EXPECT_EQ(again[i].rotational_gradient(j).decimal, reference[i].rotational_gradient(j).decimal);
      for (Eigen::Index k = 0; k < 3; ++k)
        EXPECT_EQ(again[i].hessian(j, k).decimal, reference[i].hessian(j, k).decimal);
    }
  }
}

}  // namespace
}  // namespace irradiff
