// `irradiff estimate` as a black box: its output's shape, in which coordinates its numbers are, its exit status.

#include "derivatives/estimators/estimator.h"
#include "derivatives/samples/sample_hemisphere.h"
#include "experiments/io/samples_file.h"
#include "tests/cli/program_run.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;
using testing::AllOf;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kExample = "data/samples/figure5_concentric_16x16.json";
constexpr double kUnitRoundoff = 0x1p-53;

std::vector<std::string> keysOf(const OrderedJson& object) {
  std::vector<std::string> keys;
  for (const auto& field : object.items()) keys.push_back(field.key());
  return keys;
}

OrderedJson onlyResult(const ProgramRun& run) {
  EXPECT_EQ(run.status, 0) << run.messages;
  return OrderedJson::parse(run.output).at("results").at(0);
}

/// Samples of an environment given in the frame (t, b, n), as a file.
std::string recordText(Stratification stratification, GridShape shape, const SampleFrame& frame,
                       const RayQuery& query) {
  std::ostringstream text;
  writeSamples(text, sampleHemisphere(Strata(stratification, shape), SamplePattern::kJittered, 4, 0, frame, query));
  return text.str();
}

/// Something everywhere, of varied distance and radiance.
RayHit clouds(const Vector3d& d) {
  return {0.5 + 0.25 * std::sin(5.0 * d.x() + 1.0), 1.0 + std::cos(4.0 * d.y()) * d.x() + 0.5 * d.z()};
}

const SampleFrame kUpright{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

Vector3d vectorOf(const OrderedJson& json) {
  return Vector3d(json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>());
}

Matrix3d matrixOf(const OrderedJson& json) {
  Matrix3d matrix;
  for (int i = 0; i < 3; ++i) matrix.row(i) = vectorOf(json.at(static_cast<std::size_t>(i)));
  return matrix;
}

TEST(Estimate, WritesTheFieldsOfEvaluateWithTheEstimatorsName) {
  const ProgramRun run = runProgram({"estimate", kExample, "--estimator", "radiometric"});
  EXPECT_EQ(run.messages, "");
  EXPECT_EQ(std::ranges::count(run.output, '\n'), 1);
  EXPECT_THAT(keysOf(OrderedJson::parse(run.output)), ElementsAre("results"));
  const OrderedJson result = onlyResult(run);
  EXPECT_THAT(keysOf(result), ElementsAre("estimator", "irradiance", "gradient", "gradient_normal_component", "hessian",
                                          "tangential_hessian", "rotational_gradient", "error_bound", "reason"));
  EXPECT_EQ(result["estimator"], "radiometric");
  EXPECT_EQ(result["gradient"].size(), 3);
  EXPECT_TRUE(result["gradient_normal_component"].is_number());
  for (const OrderedJson& row : result["hessian"]) EXPECT_EQ(row.size(), 3);
  EXPECT_EQ(result["tangential_hessian"].size(), 2);
  for (const OrderedJson& row : result["tangential_hessian"]) EXPECT_EQ(row.size(), 2);
  EXPECT_EQ(result["rotational_gradient"].size(), 3);
  EXPECT_THAT(keysOf(result["error_bound"]),
              ElementsAre("irradiance", "gradient", "hessian", "tangential_hessian", "rotational_gradient"));
  for (const auto& bound : result["error_bound"].items()) EXPECT_TRUE(bound.value().is_null());
  EXPECT_EQ(result["reason"], "an estimate from samples has no error bound");
}

TEST(Estimate, SaysWhyWhatAnEstimatorCannotKnowIsNull) {
  const OrderedJson walls = onlyResult(runProgram({"estimate", kExample, "--estimator", "ward-heckbert"}));
  EXPECT_EQ(walls["gradient"].size(), 3);
  EXPECT_EQ(walls["gradient"][2], 0) << "in the tangent plane";
  EXPECT_TRUE(walls["gradient_normal_component"].is_null());
  EXPECT_TRUE(walls["hessian"].is_null());
  EXPECT_TRUE(walls["tangential_hessian"].is_null());
  EXPECT_EQ(walls["reason"],
            "ward-heckbert knows the gradient in the tangent plane only, and \"gradient\" is that part of it; "
            "ward-heckbert gives no Hessian; an estimate from samples has no error bound");
  const OrderedJson bound = onlyResult(runProgram({"estimate", kExample, "--estimator", "geometric"}));
  EXPECT_TRUE(bound["gradient"].is_null());
  EXPECT_TRUE(bound["gradient_normal_component"].is_null());
  EXPECT_TRUE(bound["hessian"].is_null());
  EXPECT_EQ(bound["tangential_hessian"].size(), 2);
  EXPECT_EQ(bound["reason"],
            "geometric gives no gradient; geometric gives no Hessian but the tangential one; an estimate from samples "
            "has no error bound");
}

TEST(Estimate, FindsTheIrradianceOfAConstantSky) {
  const auto sky = [](const Vector3d&) { return RayHit{0.0, 2.5}; };
  for (const auto& [stratification, shape, estimator] : std::vector<std::tuple<Stratification, GridShape, const char*>>{
           {Stratification::kPolar, {4, 13}, "ward-heckbert"},
           {Stratification::kConcentric, {1, 1}, "radiometric"},
           {Stratification::kHemicube, {24, 8}, "hemicube"}}) {
    const OrderedJson result = onlyResult(
        runProgram({"estimate", "-", "--estimator", estimator}, recordText(stratification, shape, kUpright, sky)));
    // Weights that are right to 24 u, and their sum.
    const double tolerance = (24.0 + static_cast<double>(shape.size())) * kUnitRoundoff * 2.5 * std::numbers::pi;
    EXPECT_NEAR(result["irradiance"].get<double>(), 2.5 * std::numbers::pi, tolerance) << estimator;
  }
}

// What is seen turns with the receiver: so must all that is in world coordinates, and nothing else.
TEST(Estimate, GivesGradientsAndHessianInWorldCoordinates) {
  const Matrix3d turn =
      (Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()) * Eigen::AngleAxisd(2.0, Vector3d(0, 0, 1)))
          .toRotationMatrix();
  SampleFrame turned{{3, -2, 5}, turn.col(0), turn.col(1), turn.col(2)};
  const auto estimate = [](const SampleFrame& frame, const std::string& estimator) {
    return onlyResult(runProgram({"estimate", "-", "--estimator", estimator},
                                 recordText(Stratification::kConcentric, {12, 12}, frame, clouds)));
  };
  // Hits are about 3 m away and up to 9 m from the origin: their rounding turns directions by a few units, and a
  // gradient sums 144 strata of size 1.
  const double tolerance = 144 * 64 * kUnitRoundoff;
  const OrderedJson upright = estimate(kUpright, "radiometric");
  const OrderedJson result = estimate(turned, "radiometric");
  EXPECT_LE((vectorOf(result["gradient"]) - turn * vectorOf(upright["gradient"])).norm(), tolerance);
  EXPECT_LE((vectorOf(result["rotational_gradient"]) - turn * vectorOf(upright["rotational_gradient"])).norm(),
            tolerance);
  EXPECT_LE((matrixOf(result["hessian"]) - turn * matrixOf(upright["hessian"]) * turn.transpose()).norm(), tolerance);
  EXPECT_NEAR(result["gradient_normal_component"].get<double>(), turned.normal.dot(vectorOf(result["gradient"])),
              tolerance);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_NEAR(result["tangential_hessian"][i][j].get<double>(), upright["tangential_hessian"][i][j].get<double>(),
                  tolerance);
    }
  }
  EXPECT_GT((vectorOf(result["gradient"]) - vectorOf(upright["gradient"])).norm(), 0.1) << "the turn shows nothing";
  EXPECT_GT((matrixOf(result["hessian"]) - matrixOf(upright["hessian"])).norm(), 0.1) << "the turn shows nothing";

  const OrderedJson in_plane = estimate(turned, "ward-heckbert");
  EXPECT_NEAR(turned.normal.dot(vectorOf(in_plane["gradient"])), 0.0, tolerance);
  EXPECT_LE((vectorOf(in_plane["gradient"]) - turn * vectorOf(estimate(kUpright, "ward-heckbert")["gradient"])).norm(),
            tolerance);
}

TEST(Estimate, AnswersEachRecordWithALine) {
  const std::string good = recordText(Stratification::kConcentric, {4, 4}, kUpright, clouds);
  Json bad = Json::parse(good);
  bad["radiance"][7] = -1;
  const ProgramRun run = runProgram({"estimate", "-", "--estimator", "ward-heckbert"},
                                    Json::parse(good).dump() + "\n" + bad.dump() + "\n" + good);
  EXPECT_EQ(run.status, 1);
  const std::vector<Json> lines = jsonLines(run.output);
  ASSERT_EQ(lines.size(), 3);
  EXPECT_EQ(lines[0], lines[2]);
  EXPECT_TRUE(lines[0].contains("results"));
  EXPECT_EQ(lines[1].at("error"), "radiance[7]: is -1, must be >= 0");
  EXPECT_EQ(
      run.messages,
      "irradiff estimate: 1 of 3 records could not be estimated from; first record 1: radiance[7]: is -1, must be "
      ">= 0\n");
}

TEST(Estimate, NamesNaNByItsIndexAndHasNoneInItsOutput) {
  std::string record = Json::parse(recordText(Stratification::kConcentric, {4, 4}, kUpright, clouds)).dump();
  const std::size_t radiance = record.find("\"radiance\":[") + 12;
  record.replace(radiance, record.find(',', radiance) - radiance, "NaN");
  const ProgramRun run = runProgram({"estimate", "-", "--estimator", "radiometric"}, record);
  EXPECT_EQ(run.status, 1);
  ASSERT_EQ(jsonLines(run.output).size(), 1);
  EXPECT_EQ(jsonLines(run.output)[0].at("error"), "radiance[0]: is NaN, must be a finite number that fits in a double");
}

/// One sample of a good record made strange, in ways that the format allows.
struct StrangeSample {
  std::string name;
  std::function<void(Json& record, std::size_t sample)> make;
};

/// The hit of a sample at another distance, in metres.
void moveHit(Json& record, std::size_t sample, double distance) {
  const Json hit = record["hits"][sample];
  const Vector3d toward = Vector3d(hit[0].get<double>(), hit[1].get<double>(), hit[2].get<double>()).normalized();
  record["hits"][sample] = {distance * toward.x(), distance * toward.y(), distance * toward.z()};
}

std::vector<StrangeSample> strangeSamples() {
  std::vector<StrangeSample> strange;
  for (const double distance : {1e-300, 1e-150, 1e-20, 1e20, 1e150, 1e300}) {
    strange.push_back({"distance " + std::to_string(distance),
                       [distance](Json& record, std::size_t sample) { moveHit(record, sample, distance); }});
  }
  strange.push_back({"radiance", [](Json& record, std::size_t sample) { record["radiance"][sample] = 1e308; }});
  strange.push_back({"bright and near", [](Json& record, std::size_t sample) {
                       moveHit(record, sample, 1e-150);
                       record["radiance"][sample] = 1e200;
                     }});
  strange.push_back({"a miss", [](Json& record, std::size_t sample) { record["hits"][sample] = nullptr; }});
  return strange;
}

bool isFiniteOrNull(const Json& value) {
  if (value.is_array()) return std::ranges::all_of(value, isFiniteOrNull);
  return value.is_null() || (value.is_number() && std::isfinite(value.get<double>()));
}

TEST(Estimate, NoSingleSampleMakesARecordNaN) {
  const std::vector<StrangeSample> strange = strangeSamples();
  const Json polar = Json::parse(recordText(Stratification::kPolar, {3, 8}, kUpright, clouds));
  const Json concentric = Json::parse(recordText(Stratification::kConcentric, {5, 5}, kUpright, clouds));
  const Json single = Json::parse(recordText(Stratification::kConcentric, {1, 1}, kUpright, clouds));
  const Json hemicube = Json::parse(recordText(Stratification::kHemicube, {12, 4}, kUpright, clouds));
  for (const EstimatorDescription& estimator : estimatorDescriptions()) {
    const std::string name(estimator.name);
    std::string input;
    std::size_t count = 0;
    const auto add = [&](const Json& record) {
      for (const StrangeSample& change : strange) {
        for (const std::size_t sample : {std::size_t{0}, record["hits"].size() / 2, record["hits"].size() - 1}) {
          Json changed = record;
          change.make(changed, sample);
          input += changed.dump() + "\n";
          ++count;
        }
      }
    };
    for (const Json* record : {&polar, &concentric, &single, &hemicube}) add(*record);
    const ProgramRun run = runProgram({"estimate", "-", "--estimator", name}, input);
    const std::vector<Json> lines = jsonLines(run.output);
    ASSERT_EQ(lines.size(), count) << name << ": " << run.messages;
    std::size_t estimated = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (lines[i].contains("error")) {
        // Of what is beyond the range of double the sample is named.
        EXPECT_THAT(lines[i]["error"].get<std::string>(), AnyOf(HasSubstr("sample"), HasSubstr("takes"))) << name;
        continue;
      }
      ++estimated;
      const Json& result = lines[i].at("results").at(0);
      for (const char* field : {"irradiance", "gradient", "gradient_normal_component", "hessian", "tangential_hessian",
                                "rotational_gradient"}) {
        EXPECT_TRUE(isFiniteOrNull(result.at(field))) << name << ", record " << i << ": " << result.dump();
      }
      EXPECT_TRUE(result.at("irradiance").is_number()) << name << ", record " << i << ": " << result.dump();
    }
    EXPECT_GT(estimated, count / 8) << name << " refuses nearly everything: " << run.messages;
  }
}

TEST(Estimate, RefusesStrataThatTheEstimatorDoesNotTake) {
  const ProgramRun run = runProgram({"estimate", kExample, "--estimator", "hemicube"});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(jsonLines(run.output).at(0).at("error").get<std::string>(),
              AllOf(HasSubstr("hemicube"), HasSubstr("concentric")));
}

TEST(Estimate, RefusesAnEmptyFile) {
  const ProgramRun run = runProgram({"estimate", "-", "--estimator", "hemicube"}, " \n");
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.output, "");
  EXPECT_THAT(run.messages, HasSubstr("standard input is empty, must hold at least one record of samples"));
}

TEST(Estimate, RefusesAWrongCallWithStatusTwo) {
  const auto refusal = [](const std::vector<std::string>& arguments) {
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.output, "");
    return run.messages;
  };
  EXPECT_THAT(refusal({"estimate", kExample}), HasSubstr("--estimator is required"));
  EXPECT_THAT(refusal({"estimate", "--estimator", "hemicube"}), HasSubstr("FILE is required"));
  EXPECT_THAT(refusal({"estimate", kExample, "--estimator", "guess"}),
              AllOf(HasSubstr("unknown estimator guess, must be one of"), HasSubstr("ward-heckbert, hemicube-texel")));
  EXPECT_THAT(refusal({"estimate", "no_such_file", "--estimator", "hemicube"}), HasSubstr("no_such_file"));
  EXPECT_THAT(refusal({"estimate", "data", "--estimator", "hemicube"}), HasSubstr("data is a folder"));
  EXPECT_THAT(refusal({"estimate", kExample, "--estimator", "hemicube", "--output", ""}), HasSubstr("--output"));
}

TEST(Estimate, WritesAWholeFile) {
  const ScratchFolder scratch;
  const std::vector<std::string> call = {"estimate", kExample, "--estimator", "ward-heckbert"};
  std::vector<std::string> call_with_output = call;
  call_with_output.insert(call_with_output.end(), {"--output", scratch.file("result").string()});
  const ProgramRun run = runProgram(call_with_output);
  EXPECT_EQ(run.status, 0) << run.messages;
  EXPECT_EQ(run.output, "");
  EXPECT_EQ(readFile(scratch.file("result")), runProgram(call).output);
  EXPECT_EQ(scratch.fileCount(), 1);
}

TEST(Estimate, FailsWhereStandardOutputIsFull) {
  const ProgramRun run =
      runProgramBetween({"estimate", kExample, "--estimator", "ward-heckbert"}, "/dev/null", "/dev/full");
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.messages, HasSubstr("cannot write standard output"));
}

}  // namespace
}  // namespace irradiff
