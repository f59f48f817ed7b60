#include "verification/reference/reference_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace irradiff {
namespace {

const std::filesystem::path kFolder = "data/reference";

/// Significant digits of a decimal such as "-0.00123e-5".
std::size_t significantDigits(const std::string& decimal) {
  std::size_t count = 0;
  bool significant = false;
  for (const char c : decimal.substr(0, decimal.find('e'))) {
    if (c < '0' || c > '9') continue;
    significant = significant || c != '0';
    if (significant) ++count;
  }
  return count;
}

// The error in units of the norm; as logarithms, because the error need not be a double where the norm is 1e-300.
long double correctDigits(double norm, const std::string& error) {
  return error == "0" ? 1000 : std::log10(static_cast<long double>(norm)) - std::log10(std::stold(error));
}

template <class Case>
void expectAtLeastFortyDigits(const Case& reference) {
  const std::string where = reference.family + "/" + reference.name;
  double gradient_norm = 0;
  double hessian_norm = 0;
  for (Eigen::Index i = 0; i < reference.gradient.size(); ++i) {
    gradient_norm = std::max(gradient_norm, std::abs(reference.gradient(i).high));
    for (Eigen::Index j = 0; j < reference.gradient.size(); ++j) {
      const ReferenceNumber& entry = reference.hessian(i, j);
      hessian_norm = std::max(hessian_norm, std::abs(entry.high));
      EXPECT_EQ(entry.decimal, reference.hessian(j, i).decimal) << where;
      EXPECT_TRUE(entry.decimal == "0" || significantDigits(entry.decimal) >= 40) << where << " " << entry.decimal;
    }
  }
  ASSERT_GT(gradient_norm, 0) << where;
  ASSERT_GT(hessian_norm, 0) << where;
  EXPECT_TRUE(reference.value.high == 0 || correctDigits(std::abs(reference.value.high), reference.error.value) >= 45)
      << where;
  EXPECT_GE(correctDigits(gradient_norm, reference.error.gradient), 45) << where;
  EXPECT_GE(correctDigits(hessian_norm, reference.error.hessian), 45) << where;
  double rotational_norm = 0;
  for (const ReferenceNumber& component : reference.rotational_gradient) {
    rotational_norm = std::max(rotational_norm, std::abs(component.high));
  }
  // It vanishes where the polygon is straight ahead.
  EXPECT_TRUE(rotational_norm == 0 || correctDigits(rotational_norm, reference.error.rotational_gradient) >= 45)
      << where;
}

TEST(ReferenceData, EveryCaseHasFortyDigitsAndAName) {
  const auto cases = readReferenceData(kFolder);
  const auto flatland = readFlatlandReferenceData(kFolder);
  EXPECT_GE(cases.size(), 80U);
  EXPECT_GE(flatland.size(), 15U);
  std::set<std::string> names;
  for (const ReferenceCase& reference : cases) {
    EXPECT_TRUE(names.insert(reference.family + "/" + reference.name).second) << reference.name;
    EXPECT_FALSE(reference.reason.empty()) << reference.name;
    expectAtLeastFortyDigits(reference);
  }
  for (const FlatlandReferenceCase& reference : flatland) {
    EXPECT_TRUE(names.insert(reference.family + "/" + reference.name).second) << reference.name;
    expectAtLeastFortyDigits(reference);
  }
}

TEST(ReferenceData, EveryFamilyIsThere) {
  std::set<std::string> families;
  for (const ReferenceCase& reference : readReferenceData(kFolder)) families.insert(reference.family);
  const std::set<std::string> expected = {"edge_over_distance",
                                          "generic",
                                          "gradient_near_plane",
                                          "horizon",
                                          "near_edge",
                                          "near_plane",
                                          "near_radial",
                                          "near_vertex",
                                          "scaled",
                                          "sliver",
                                          "tiny_at_horizon",
                                          "translated",
                                          "winding"};
  EXPECT_EQ(families, expected);
}

TEST(ReferenceData, ThePairIsTheDecimalToThirtyDigits) {
  for (const ReferenceCase& reference : readReferenceFile(kFolder / "generic.json")) {
    const long double pair = static_cast<long double>(reference.value.high) + reference.value.low;
    EXPECT_NEAR(static_cast<double>((std::stold(reference.value.decimal) - pair) / pair), 0, 0x1p-62) << reference.name;
    EXPECT_LE(std::abs(reference.value.low), std::ldexp(std::abs(reference.value.high), -53)) << reference.name;
    EXPECT_NE(reference.value.low, 0) << reference.name;
    EXPECT_EQ(reference.value.errorOf(reference.value.high), -reference.value.low);
    EXPECT_EQ(reference.value.errorOf(std::nextafter(reference.value.high, 1.0)),
              (std::nextafter(reference.value.high, 1.0) - reference.value.high) - reference.value.low);
  }
}

class BrokenFile : public testing::Test {
 protected:
  BrokenFile() {
    std::ifstream stream(kFolder / "sliver.json");
    text_.assign(std::istreambuf_iterator<char>(stream), {});
  }
  ~BrokenFile() override { std::filesystem::remove(path_); }

  void replace(const std::string& from, const std::string& to) {
    const std::size_t at = text_.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text_.replace(at, from.size(), to);
  }
  void expectError(const std::string& part) {
    std::ofstream(path_) << text_;
    try {
      readReferenceFile(path_);
      FAIL() << "accepted; expected an error with " << part;
    } catch (const InvalidReference& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }

  std::string text_;
  std::filesystem::path path_ = std::filesystem::temp_directory_path() / "irradiff_broken_reference.json";
};

TEST_F(BrokenFile, Truncated) {
  text_.resize(text_.size() / 2);
  expectError("is not JSON");
}

TEST_F(BrokenFile, MissingField) {
  replace("\"hessian\"", "\"Hessian\"");
  expectError("case 0 \"triangle_1e-06\": field \"hessian\" is missing");
}

TEST_F(BrokenFile, DecimalInput) {
  replace("\"0x1p-2\"", "\"0.25\"");
  expectError("\"0.25\" is not a finite hexadecimal float");
}

TEST_F(BrokenFile, NormalNotUnit) {
  replace("\"normal\": [\n    \"0x0p+0\"", "\"normal\": [\n    \"0x1p+0\"");
  expectError("case 0 \"triangle_1e-06\"");
}

TEST_F(BrokenFile, ValueNotANumber) {
  replace("\"value\": \"", "\"value\": \"x");
  expectError("is not a decimal number");
}

TEST_F(BrokenFile, OtherVersion) {
  replace("\"version\": 1", "\"version\": 2");
  expectError("version must be 1");
}

TEST_F(BrokenFile, OtherDimension) {
  EXPECT_THROW(readFlatlandReferenceFile(kFolder / "sliver.json"), InvalidReference);
}

TEST(ReferenceFolder, EmptyIsAnError) {
  EXPECT_THROW(readReferenceData("tests/reference"), InvalidReference);
  EXPECT_THROW(readReferenceData("no/such/folder"), InvalidReference);
}

}  // namespace
}  // namespace irradiff
