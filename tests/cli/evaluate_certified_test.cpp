// `irradiff evaluate --precision certified` as a black box.

#include "tests/cli/program_run.h"

#include <boost/multiprecision/cpp_dec_float.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

namespace irradiff {
namespace {

using Json = nlohmann::json;
using Decimal = boost::multiprecision::cpp_dec_float_100;

// E under the corner of a unit square at distance 1 is sqrt(2)/2 atan(sqrt(2)/2) times L (Howell's catalogue, B-3).
const char* const kUnitSquare =
    R"({"format": "irradiff-scene", "version": 1, "dimension": 3,
      "polygons": [{"name": "square", "vertices": [[0,0,1],[1,0,1],[1,1,1],[0,1,1]], "radiance": 2}],
      "points": [{"position": [0,0,0], "normal": [0,0,1]}]})";

Decimal underUnitSquare() {
  const Decimal root = sqrt(Decimal(2));
  return root * atan(1 / root);
}

Json resultOf(const std::string& tolerance, const std::string& scene = kUnitSquare) {
  const ProgramRun run = runProgram({"evaluate", "--precision", "certified", "--tolerance", tolerance}, scene);
  EXPECT_EQ(run.status, 0) << run.messages;
  return Json::parse(run.output).at("results").at(0);
}

TEST(EvaluateCertified, HasTheFieldsOfDoubleAndMore) {
  const Json certified = resultOf("1e-12");
  const Json plain = Json::parse(runProgram({"evaluate"}, kUnitSquare).output).at("results").at(0);
  for (const auto& [key, value] : plain.items()) EXPECT_TRUE(certified.contains(key)) << key;
  const Json& model = certified.at("model");
  for (const auto& [key, value] : plain.at("model").items()) {
    EXPECT_TRUE(model.contains(key)) << key;
    if (key == "precision") continue;
    EXPECT_EQ(model.at(key), value) << key;
  }
  EXPECT_EQ(model.at("precision"), "double");
  EXPECT_EQ(model.at("rungs").dump(), R"({"ball":0,"double":1,"extended":0})");
  EXPECT_TRUE(model.at("meets_tolerance"));
  EXPECT_FALSE(certified.contains("decimal"));
  const double error = std::abs(certified.at("irradiance").get<double>() - underUnitSquare().convert_to<double>());
  EXPECT_LE(error, certified.at("error_bound").at("irradiance").get<double>() + 0x1p-53);
}

TEST(EvaluateCertified, WritesDecimalsBeyondDouble) {
  for (const char* tolerance : {"1e-20", "1e-30", "1e-60"}) {
    const Json result = resultOf(tolerance);
    const Json& decimal = result.at("decimal");
    const Decimal value(decimal.at("irradiance").get<std::string>());
    const Decimal bound(decimal.at("error_bound").at("irradiance").get<std::string>());
    EXPECT_LE(abs(value - underUnitSquare()), bound) << tolerance;
    EXPECT_LE(bound, Decimal(tolerance) * underUnitSquare()) << tolerance;
    // The twin: the double alone is not within that bound.
    EXPECT_GT(abs(Decimal(result.at("irradiance").get<double>()) - underUnitSquare()), bound) << tolerance;
    EXPECT_EQ(decimal.at("gradient").size(), 3U);
    EXPECT_EQ(decimal.at("hessian").at(2).size(), 3U);
    EXPECT_EQ(decimal.at("tangential_hessian").at(1).size(), 2U);
  }
}

TEST(EvaluateCertified, NamesTheRungs) {
  EXPECT_EQ(resultOf("1e-20").at("model").at("precision"), "extended");
  EXPECT_EQ(resultOf("1e-40").at("model").at("precision"), "ball");
}

TEST(EvaluateCertified, KnowsFlatland) {
  // Two half-lengths at 45 degrees: E = L (sin - -sin) = sqrt(2) L.
  const char* const scene =
      R"({"format": "irradiff-scene", "version": 1, "dimension": 2,
        "segments": [{"vertices": [[-1,1],[1,1]], "radiance": 1}], "points": [{"position": [0,0], "normal": [0,1]}]})";
  const Json result = resultOf("1e-30", scene);
  const Decimal value(result.at("decimal").at("irradiance").get<std::string>());
  const Decimal bound(result.at("decimal").at("error_bound").at("irradiance").get<std::string>());
  EXPECT_LE(abs(value - sqrt(Decimal(2))), bound);
  EXPECT_EQ(result.at("decimal").at("hessian").at(0).size(), 2U);
}

TEST(EvaluateCertified, KeepsDecimalsOfTinyNumbers) {
  // E = sqrt(2) L.
  for (const char* radiance : {"1e-290", "1e-305"}) {
    const std::string scene =
        R"({"format": "irradiff-scene", "version": 1, "dimension": 2,
          "segments": [{"vertices": [[-1,1],[1,1]], "radiance": )" +
        std::string(radiance) + R"(}], "points": [{"position": [0,0], "normal": [0,1]}]})";
    const Decimal truth = sqrt(Decimal(2)) * Decimal(std::stod(radiance));
    const Json result = resultOf("1e-50", scene);
    const Decimal value(result.at("decimal").at("irradiance").get<std::string>());
    const Decimal bound(result.at("decimal").at("error_bound").at("irradiance").get<std::string>());
    EXPECT_LE(abs(value - truth), bound) << radiance;
    EXPECT_LE(bound, Decimal("1e-50") * truth) << radiance;
  }
  // A quarter of the circle, E = L, in balls without any error; the gradient is below the range of double.
  const Json exact = resultOf("1e-50", R"({"format": "irradiff-scene", "version": 1, "dimension": 2,
      "segments": [{"vertices": [[0,1e120],[-1e120,-1e120]], "radiance": 1e-300}],
      "points": [{"position": [0,0], "normal": [0,1]}]})");
  const Decimal value(exact.at("decimal").at("irradiance").get<std::string>());
  EXPECT_LE(abs(value / Decimal(1e-300) - 1), Decimal("1e-50"));
}

TEST(EvaluateCertified, MeetsTheToleranceWhereTermsAreBeyondDouble) {
  // Both ends add the same to the tangential Hessian but for 1e-16 of it, and together more than 1.8e308.
  const Json result = resultOf("1e-12", R"({"format": "irradiff-scene", "version": 1, "dimension": 2,
      "segments": [{"vertices": [[9.335305797318287e-05, 0.0001220703125], [3.662109375e-05, 0.0001220703125]], "radiance": 2e300}],
      "points": [{"position": [0,0], "normal": [0,1]}]})");
  EXPECT_TRUE(result.at("model").at("meets_tolerance"));
  EXPECT_LE(result.at("error_bound").at("tangential_hessian").get<double>(),
            1e-12 * std::abs(result.at("tangential_hessian").at(0).at(0).get<double>()));
}

TEST(EvaluateCertified, DerivativesOfAnEvenSkyVanishAtEveryScale) {
  // Two segments of one radiance that fill the half circle; in metres, the terms of the Hessian are below 1e-324.
  const Json result = resultOf("1e-12", R"({"format": "irradiff-scene", "version": 1, "dimension": 2,
      "segments": [{"vertices": [[-5e148,-1.5e148],[7e147,-9e146]], "radiance": 1e-30},
                   {"vertices": [[2.7e150,-6.6e149],[-1.9e150,2.8e150]], "radiance": 1e-30}],
      "points": [{"position": [0,0], "normal": [1,0]}]})");
  EXPECT_EQ(result.at("irradiance"), 2e-30);
  EXPECT_EQ(result.at("hessian").dump(), "[[0,0],[0,0]]");
  EXPECT_TRUE(result.at("model").at("meets_tolerance"));
}

TEST(EvaluateCertified, EveryHardCaseMeetsTheTolerance) {
  for (const auto& entry : std::filesystem::directory_iterator("data/hard_cases")) {
    if (entry.path().extension() != ".json") continue;
    for (const char* tolerance : {"1e-12", "1e-30"}) {
      const ProgramRun run =
          runProgram({"evaluate", entry.path().string(), "--precision", "certified", "--tolerance", tolerance}, "");
      ASSERT_EQ(run.status, 0) << entry.path() << run.messages;
      const Json output = Json::parse(run.output);
      for (const Json& result : output.at("results")) {
        EXPECT_TRUE(result.at("model").at("meets_tolerance")) << entry.path() << tolerance;
      }
    }
  }
}

TEST(EvaluateCertified, GivesAReasonInsteadOfADerivativeThatDoesNotExist) {
  const ProgramRun run = runProgram({"evaluate", "data/hard_cases/edge_on.json", "--precision", "certified"}, "");
  const Json result = Json::parse(run.output).at("results").at(0);
  EXPECT_TRUE(result.at("hessian").is_null());
  EXPECT_TRUE(result.at("error_bound").at("hessian").is_null());
  EXPECT_THAT(result.at("reason").get<std::string>(), testing::HasSubstr("edge-on"));
}

}  // namespace
}  // namespace irradiff
