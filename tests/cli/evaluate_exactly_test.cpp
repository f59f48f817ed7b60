// `irradiff evaluate --method exact` as a black box: its enclosures against the production path, and what it refuses.

#include "tests/cli/program_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>

namespace irradiff {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;
using testing::AllOf;
using testing::HasSubstr;

const char* const kSquare =
    R"({"format": "irradiff-scene", "version": 1, "dimension": 3,
      "polygons": [{"name": "square", "vertices": [[0,0,1],[1,0,1],[1,1,1],[0,1,1]], "radiance": 2}],
      "points": [{"position": [0,0,0], "normal": [0,0,1]}]})";
const char* const kSegment =
    R"({"format": "irradiff-scene", "version": 1, "dimension": 2,
      "segments": [{"vertices": [[-1,1],[1,1]], "radiance": 1}], "points": [{"position": [0,0], "normal": [0,1]}]})";
const char* const kPartlyHidden =
    R"({"format": "irradiff-scene", "version": 1, "dimension": 3,
      "polygons": [{"name": "lamp", "vertices": [[-1,-1,2],[1,-1,2],[1,1,2],[-1,1,2]], "radiance": 2},
                   {"name": "screen", "vertices": [[0.25,-2,1],[2,-2,1.5],[2,0.5,1.5],[0.25,0.5,1]], "radiance": 0}],
      "points": [{"position": [0.1,0.2,0], "normal": [0,0,1]}]})";

OrderedJson onlyResult(const std::string& output) { return OrderedJson::parse(output).at("results").at(0); }

TEST(EvaluateExactly, EnclosesWhatTheProductionPathFinds) {
  const ProgramRun exact_run = runProgram({"evaluate", "--method", "exact"}, kPartlyHidden);
  ASSERT_EQ(exact_run.status, 0) << exact_run.messages;
  const OrderedJson exact = onlyResult(exact_run.output);
  const OrderedJson other = onlyResult(runProgram({"evaluate"}, kPartlyHidden).output);
  EXPECT_EQ(exact["model"].dump(), R"({"occlusion":true,"horizon":false,"apparent_vertices":2,"precision":"ball"})");
  EXPECT_EQ(other["model"]["precision"], "double");
  const auto isWithin = [&](const std::string& quantity, double a, double b) {
    const double bound = exact["error_bound"][quantity].get<double>() + other["error_bound"][quantity].get<double>();
    return std::abs(a - b) <= bound;
  };
  EXPECT_TRUE(isWithin("irradiance", exact["irradiance"], other["irradiance"]));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(isWithin("gradient", exact["gradient"][i], other["gradient"][i])) << i;
    EXPECT_TRUE(isWithin("rotational_gradient", exact["rotational_gradient"][i], other["rotational_gradient"][i])) << i;
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_TRUE(isWithin("hessian", exact["hessian"][i][j], other["hessian"][i][j])) << i << j;
    }
  }
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_TRUE(isWithin("tangential_hessian", exact["tangential_hessian"][i][j], other["tangential_hessian"][i][j]));
    }
  }
  // Nothing is left but the rounding to double.
  EXPECT_LT(exact["error_bound"]["irradiance"], 0x1p-52 * exact["irradiance"].get<double>());
  EXPECT_LT(exact["error_bound"]["hessian"], other["error_bound"]["hessian"]);
}

TEST(EvaluateExactly, RefusesWhatIsNotExactlyPlanarAndFlatland) {
  Json scene = Json::parse(kSquare);
  scene["polygons"][0]["vertices"][2][2] = 1.0 + 1e-13;
  const ProgramRun run = runProgram({"evaluate", "--method", "exact"}, scene.dump());
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(Json::parse(run.output).at("error").get<std::string>(),
              AllOf(HasSubstr("\"square\""), HasSubstr("vertex 3"), HasSubstr("must be exactly in it")));
  EXPECT_EQ(runProgram({"evaluate"}, scene.dump()).status, 0);
  const ProgramRun flatland = runProgram({"evaluate", "--method", "exact"}, kSegment);
  EXPECT_EQ(flatland.status, 1);
  EXPECT_THAT(Json::parse(flatland.output).at("error").get<std::string>(),
              AllOf(HasSubstr("dimension: 2"), HasSubstr("exact visibility")));
}

TEST(EvaluateExactly, SaysWhyADerivativeIsMissing) {
  // The screen's corner lies over the lamp's lower edge.
  Json scene = Json::parse(kPartlyHidden);
  scene["points"][0]["position"] = {0, 0, 0};
  scene["polygons"][1]["vertices"] = {{0.25, -0.5, 1}, {2, -0.5, 1}, {2, 0.25, 1}, {0.25, 0.25, 1}};
  for (const char* method : {"exact", "boundary"}) {
    const OrderedJson result = onlyResult(runProgram({"evaluate", "--method", method}, scene.dump()).output);
    EXPECT_TRUE(result["hessian"].is_null()) << method;
    EXPECT_TRUE(result.contains("reason")) << method;
  }
}

}  // namespace
}  // namespace irradiff
