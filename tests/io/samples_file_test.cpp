// Hemisphere samples as users bring them: what is read, what is refused and in which words, and that no number that is
// not finite gets through.

#include "experiments/io/samples_file.h"

#include "derivatives/samples/sample_hemisphere.h"
#include "tests/cli/program_run.h"
#include "tests/io/example_samples.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double kUnitRoundoff = 0x1p-53;

/// One stratum in each quadrant: a hit above each but the last.
Json goodRecord() {
  return Json::parse(R"({"format": "irradiff-samples", "version": 1, "position": [0,0,0], "normal": [0,0,1],
    "tangent": [1,0,0], "bitangent": [0,1,0], "stratification": "concentric", "shape": [2,2],
    "hits": [[-1,-1,1], [2,-2,2], [-1,1,3], null], "radiance": [1, 0.5, 0, null]})");
}

HemisphereSamples readOne(const std::string& text) {
  std::istringstream stream(text);
  SamplesReader reader(stream);
  std::optional<HemisphereSamples> samples = reader.next();
  if (!samples) throw std::runtime_error("no record");
  return *std::move(samples);
}

/// What the reader says of a record; empty if it reads it.
std::string refusal(const std::string& text) {
  try {
    readOne(text);
  } catch (const SceneFileError& error) {
    return error.what();
  }
  return "";
}

std::string refusalAfter(const std::function<void(Json&)>& change) {
  Json record = goodRecord();
  change(record);
  return refusal(record.dump());
}

TEST(SamplesFile, GivesDirectionsAndInverseDistances) {
  const HemisphereSamples samples = readOne(goodRecord().dump());
  EXPECT_EQ(samples.stratification, Stratification::kConcentric);
  EXPECT_EQ(samples.shape, (GridShape{2, 2}));
  EXPECT_EQ(samples.frame.axes(), Eigen::Matrix3d::Identity());
  const std::vector<Vector3d> hits = {{-1, -1, 1}, {2, -2, 2}, {-1, 1, 3}};
  for (std::size_t k = 0; k < hits.size(); ++k) {
    EXPECT_LE((samples.direction(k) - hits[k] / hits[k].norm()).norm(), 4 * kUnitRoundoff);
    EXPECT_NEAR(samples.inverse_distance[k], 1.0 / hits[k].norm(), 4 * kUnitRoundoff);
  }
  // A ray that hit nothing: infinitely far, in the middle of its stratum.
  EXPECT_EQ(samples.inverse_distance[3], 0.0);
  EXPECT_LE((samples.direction(3) - Vector3d(0.5, 0.5, std::sqrt(1.5)).normalized()).norm(), 0.2);
  EXPECT_EQ(samples.direction(3), Strata(Stratification::kConcentric, {2, 2}).direction({1, 1, 0.5, 0.5}));
  EXPECT_EQ(samples.radiance, (std::vector<double>{1, 0.5, 0, 0}));
}

TEST(SamplesFile, TakesTheRadianceThatAMissIsGiven) {
  Json record = goodRecord();
  record["radiance"][3] = 7.5;
  EXPECT_EQ(readOne(record.dump()).radiance[3], 7.5);
}

TEST(SamplesFile, ReadsFieldsInAnyOrderAndOverAnyNumberOfLines) {
  const HemisphereSamples expected = readOne(goodRecord().dump());
  EXPECT_EQ(readOne(goodRecord().dump(2)).direction_t, expected.direction_t);
  const Json record = goodRecord();
  std::vector<std::string> fields;
  for (const auto& field : record.items()) fields.push_back(Json(field.key()).dump() + ":" + field.value().dump());
  std::string reversed = "{" + fields.back();
  for (std::size_t i = fields.size() - 1; i-- > 0;) reversed += "," + fields[i];
  reversed += "}";
  EXPECT_EQ(readOne(reversed).direction_t, expected.direction_t);
  EXPECT_EQ(readOne(reversed).radiance, expected.radiance);
}

TEST(SamplesFile, ReadsOneStratum) {
  const std::string text = R"({"format": "irradiff-samples", "version": 1, "position": [1,2,3], "normal": [0,0,1],
    "tangent": [1,0,0], "bitangent": [0,1,0], "stratification": "polar", "shape": [1,1],
    "hits": [[1,2,5]], "radiance": [3]})";
  const HemisphereSamples samples = readOne(text);
  EXPECT_EQ(samples.direction(0), Vector3d(0, 0, 1));
  EXPECT_EQ(samples.inverse_distance[0], 0.5);
}

// ---------------------------------------------------------------------------------------------------- what is refused

TEST(SamplesFile, RefusesWhatIsNoSamplesFile) {
  EXPECT_THAT(refusal("[]"), AllOf(StartsWith("samples: expected an object"), HasSubstr("an array")));
  EXPECT_THAT(refusal("12 "), StartsWith("samples: expected an object, got 12"));
  EXPECT_THAT(refusal("{\"format\": \"irradiff-samples\", "), StartsWith("not JSON: "));
  EXPECT_THAT(refusal("{}"), HasSubstr("field \"format\" is missing"));
  EXPECT_THAT(refusalAfter([](Json& r) { r["format"] = "irradiff-scene"; }),
              HasSubstr("format: expected \"irradiff-samples\", got \"irradiff-scene\""));
  EXPECT_THAT(refusalAfter([](Json& r) { r["version"] = 2; }), HasSubstr("version: expected 1, got 2"));
  EXPECT_THAT(refusalAfter([](Json& r) { r["hit"] = 2; }), HasSubstr("samples: unknown field \"hit\", must be one of"));
  for (const char* name :
       {"position", "normal", "tangent", "bitangent", "stratification", "shape", "hits", "radiance"}) {
    EXPECT_THAT(refusalAfter([name](Json& r) { r.erase(name); }),
                HasSubstr("field \"" + std::string(name) + "\" is missing"));
  }
  const std::string good = goodRecord().dump();
  EXPECT_THAT(refusal("{\"version\":1," + good.substr(1)), HasSubstr("field \"version\" given twice"));
}

TEST(SamplesFile, RefusesAWrongShape) {
  EXPECT_THAT(refusalAfter([](Json& r) {
                r["shape"] = {2, 3};
              }),
              StartsWith("hits: has 4 entries, must have 6, one for each stratum of shape 2 x 3"));
  EXPECT_THAT(refusalAfter([](Json& r) { r["radiance"].push_back(1); }),
              StartsWith("radiance: has 5 entries, must have 4"));
  EXPECT_THAT(refusalAfter([](Json& r) { r["shape"] = {4}; }), StartsWith("shape: expected 2 whole numbers, got 1"));
  EXPECT_THAT(refusalAfter([](Json& r) { r["shape"] = {2, 2.5}; }), StartsWith("shape[1]: expected a whole number"));
  EXPECT_THAT(refusalAfter([](Json& r) { r["shape"] = {2, 0}; }), StartsWith("shape[1]: expected a whole number"));
  EXPECT_THAT(refusalAfter([](Json& r) { r["shape"] = {65537, 1}; }), HasSubstr("shape 65537 x 1: must have from 1"));
  EXPECT_THAT(refusalAfter([](Json& r) { r["stratification"] = "hemicube"; }),
              HasSubstr("shape 2 x 2: must be 3 n rows by n columns"));
  EXPECT_THAT(refusalAfter([](Json& r) { r["stratification"] = "spiral"; }),
              StartsWith("stratification: expected \"concentric\", \"polar\" or \"hemicube\", got \"spiral\""));
  EXPECT_THAT(refusalAfter([](Json& r) { r["hits"] = 4; }), StartsWith("hits: expected an array, got 4"));
}

TEST(SamplesFile, RefusesAFrameThatIsNotRightHandedOrthonormal) {
  EXPECT_THAT(refusalAfter([](Json& r) {
                r["tangent"] = {2, 0, 0};
              }),
              StartsWith("tangent: (2, 0, 0) has length 2, must be 1 within 1e-12"));
  EXPECT_THAT(refusalAfter([](Json& r) { r["normal"] = {0, 0, 1 + 1e-9}; }), HasSubstr("must be 1 within 1e-12"));
  EXPECT_THAT(refusalAfter([](Json& r) { r["normal"] = {0, 0, 0}; }), HasSubstr("normal: (0, 0, 0) has length 0"));
  EXPECT_THAT(refusalAfter([](Json& r) {
                r["tangent"] = {0.6, 0.8, 0};
              }),
              StartsWith("tangent: (0.6, 0.8, 0) and bitangent (0, 1, 0) have the dot product 0.8, must be 0 within"));
  EXPECT_THAT(refusalAfter([](Json& r) { r["bitangent"] = {0, 0.8, 0.6}; }), HasSubstr("and normal (0, 0, 1)"));
  EXPECT_THAT(refusalAfter([](Json& r) {
                r["bitangent"] = {0, -1, 0};
              }),
              AllOf(StartsWith("bitangent: (0, -1, 0) makes a left-handed frame"), HasSubstr("normal x tangent")));
  EXPECT_THAT(refusalAfter([](Json& r) { r["position"] = {0, 0}; }), StartsWith("position: expected 3 numbers, got 2"));
  EXPECT_THAT(refusalAfter([](Json& r) { r["position"][1] = "x"; }), StartsWith("position[1]: expected a number"));
}

TEST(SamplesFile, RefusesAWrongSampleByItsIndex) {
  const auto hit = [](std::size_t index, const Json& value) {
    return refusalAfter([&](Json& r) { r["hits"][index] = value; });
  };
  EXPECT_THAT(hit(1, {0, 0, 0}), StartsWith("hits[1]: (0, 0, 0) is at the position (0, 0, 0), must be elsewhere"));
  EXPECT_THAT(hit(1, {4e-324, 0, 0}), HasSubstr("is at the position"));
  EXPECT_THAT(hit(2, {-1, 1, -0.5}),
              AllOf(StartsWith("hits[2]: (-1, 1, -0.5) is below the horizon"), HasSubstr(">= 0")));
  EXPECT_THAT(hit(0, {1, -1, 1}), AllOf(StartsWith("hits[0]: (1, -1, 1) is outside its stratum (row 0, column 0) by"),
                                        HasSubstr("in row 0, column 1: must be inside within")));
  EXPECT_THAT(hit(0, {-1.7e308, -1.7e308, 1.7e308}), HasSubstr("hits[0]: (-1.7e+308, -1.7e+308, 1.7e+308) is farther"));
  EXPECT_THAT(hit(0, {-1, -1}), StartsWith("hits[0]: expected 3 numbers, got 2"));
  EXPECT_THAT(hit(0, {-1, -1, 1, 1}), StartsWith("hits[0]: expected 3 numbers, got 4"));
  EXPECT_THAT(hit(3, 5), StartsWith("hits[3]: expected 3 numbers or null, got 5"));
  EXPECT_THAT(hit(3, {{"x", 1}}), StartsWith("hits[3]: expected 3 numbers or null, got an object"));
  EXPECT_THAT(hit(3, {1, nullptr, 1}), StartsWith("hits[3][1]: expected a number, got null"));
  EXPECT_THAT(hit(3, {1, "one", 1}), StartsWith("hits[3][1]: expected a number, got the string \"one\""));
  EXPECT_THAT(hit(3, {{1}, 1, 1}), StartsWith("hits[3][0]: expected a number, got an array"));
  const auto radiance = [](std::size_t index, const Json& value) {
    return refusalAfter([&](Json& r) { r["radiance"][index] = value; });
  };
  EXPECT_THAT(radiance(2, -1), StartsWith("radiance[2]: is -1, must be >= 0"));
  EXPECT_THAT(radiance(2, nullptr), StartsWith("radiance[2]: is null, must be given where a ray hit something"));
  EXPECT_THAT(radiance(2, true), StartsWith("radiance[2]: expected a number, got true"));
  EXPECT_THAT(radiance(3, {1}), StartsWith("radiance[3]: expected a number, got an array"));
}

/// The good record with the first `what` replaced by `with`.
std::string changedText(const std::string& what, const std::string& with) {
  std::string text = goodRecord().dump();
  const std::size_t at = text.find(what);
  if (at == std::string::npos) throw std::logic_error("no " + what + " in " + text);
  return text.replace(at, what.size(), with);
}

TEST(SamplesFile, RefusesNumbersThatNoDoubleHoldsByTheirIndex) {
  for (const std::string word : {"NaN", "nan", "-nan", "Infinity", "-Infinity", "inf", "1e999", "-1e999"}) {
    const std::string rule = "is " + word + ", must be a finite number that fits in a double";
    EXPECT_THAT(refusal(changedText("[1,0.5,0,null]", "[1," + word + ",0,null]")), StartsWith("radiance[1]: " + rule));
    EXPECT_THAT(refusal(changedText("[-1,1,3]", "[-1,1," + word + "]")), StartsWith("hits[2][2]: " + rule));
    EXPECT_THAT(refusal(changedText("\"position\":[0,0,0]", "\"position\":[0," + word + ",0]")),
                StartsWith("position[1]: " + rule));
  }
  EXPECT_THAT(refusal(changedText("[1,0.5,0,null]", "[1,nothing,0,null]")), StartsWith("not JSON: "));
}

// ------------------------------------------------------------------------------------------------- one after the other

std::vector<std::string> refusalsOf(const std::string& text) {
  std::istringstream stream(text);
  SamplesReader reader(stream);
  std::vector<std::string> refusals;
  while (true) {
    try {
      if (!reader.next()) return refusals;
      refusals.emplace_back();
    } catch (const SceneFileError& error) {
      refusals.emplace_back(error.what());
    }
  }
}

TEST(SamplesFile, GoesOnBehindARecordThatIsWrong) {
  const std::string good = goodRecord().dump() + "\n";
  std::string left_handed = goodRecord().dump(1) + "\n";
  left_handed.replace(left_handed.find("-1"), 2, "1");
  const std::string text = good + changedText("[1,0.5", "[1,nan") + "\n" + good + changedText("null", "{\"a\":[[]]}") +
                           " " + goodRecord().dump(3) + left_handed + good + "{\"format\": \"irr\n" + good;
  const std::vector<std::string> refusals = refusalsOf(text);
  ASSERT_EQ(refusals.size(), 9);
  EXPECT_EQ(refusals[0], "");
  EXPECT_THAT(refusals[1], StartsWith("radiance[1]: is nan"));
  EXPECT_EQ(refusals[2], "");
  EXPECT_THAT(refusals[3], StartsWith("hits[3]: expected 3 numbers or null, got an object"));
  EXPECT_EQ(refusals[4], "");
  EXPECT_THAT(refusals[5], HasSubstr("outside its stratum"));
  EXPECT_EQ(refusals[6], "");
  EXPECT_THAT(refusals[7], StartsWith("not JSON: "));
  EXPECT_EQ(refusals[8], "");
}

TEST(SamplesFile, IsEmptyWhereTheStreamIs) {
  EXPECT_TRUE(refusalsOf("").empty());
  EXPECT_TRUE(refusalsOf(" \n\t\r\n").empty());
}

// -------------------------------------------------------------------------------------------- what renderers write

struct Grid {
  Stratification stratification;
  GridShape shape;
};

const std::vector<Grid> kGrids = {
    {Stratification::kPolar, {16, 50}}, {Stratification::kConcentric, {33, 32}}, {Stratification::kHemicube, {48, 16}}};

SampleFrame randomFrame(std::mt19937_64& random, double extent) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto vector = [&] { return Vector3d(unit(random), unit(random), unit(random)); };
  SampleFrame frame;
  frame.position = extent * vector();
  frame.normal = vector().normalized();
  frame.tangent = frame.normal.cross(vector()).normalized();
  frame.bitangent = frame.normal.cross(frame.tangent).normalized();
  return frame;
}

/// Hits at distances around 1 m, one in seven a miss.
HemisphereSamples randomSamples(const Grid& grid, const SampleFrame& frame, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  return sampleHemisphere(Strata(grid.stratification, grid.shape), SamplePattern::kJittered, seed, 1, frame,
                          [&](const Vector3d&) {
                            const double inverse_distance = unit(random) < 1.0 / 7.0 ? 0.0 : std::exp(unit(random));
                            return RayHit{inverse_distance, unit(random)};
                          });
}

std::string textOf(const HemisphereSamples& samples, const std::string& description = "") {
  std::ostringstream stream;
  writeSamples(stream, samples, description);
  return stream.str();
}

TEST(SamplesFile, ReadsBackWhatItWrites) {
  std::mt19937_64 random(8);
  for (const Grid& grid : kGrids) {
    const SampleFrame frame = randomFrame(random, 10.0);
    const HemisphereSamples samples = randomSamples(grid, frame, random());
    const std::string text = textOf(samples, "a \"description\"");
    EXPECT_EQ(Json::parse(text).at("description"), "a \"description\"");
    const HemisphereSamples read = readOne(text);
    EXPECT_EQ(read.frame.position, frame.position);
    EXPECT_EQ(read.frame.axes(), frame.axes());
    EXPECT_EQ(read.stratification, grid.stratification);
    EXPECT_EQ(read.shape, grid.shape);
    EXPECT_EQ(read.radiance, samples.radiance);
    const Strata strata(grid.stratification, grid.shape);
    for (std::size_t k = 0; k < grid.shape.size(); ++k) {
      if (samples.inverse_distance[k] == 0.0) {
        EXPECT_EQ(read.inverse_distance[k], 0.0);
        EXPECT_EQ(read.direction(k), strata.direction({k / grid.shape.columns, k % grid.shape.columns, 0.5, 0.5}));
        continue;
      }
      // Coordinates up to 14 m, a hit at least 1/e m away: each rounding of a coordinate turns by 14 e u, and there are
      // four of them, in the hit's sum and in the difference.
      const double tolerance = 4 * 14 * std::exp(1.0) * std::sqrt(3.0) * kUnitRoundoff + 16 * kUnitRoundoff;
      EXPECT_LE((read.direction(k) - samples.direction(k)).norm(), tolerance);
      EXPECT_LE(std::abs(read.inverse_distance[k] / samples.inverse_distance[k] - 1.0), tolerance);
    }
  }
}

TEST(SamplesFile, TheExampleIsWhatItsProgramMakes) {
  const std::string example = readFile("data/samples/figure5_concentric_16x16.json");
  EXPECT_EQ(example, exampleSamplesText());
  EXPECT_EQ(refusal(example), "");
}

TEST(SamplesFile, TheWriterNamesWhatJsonCannotExpress) {
  std::mt19937_64 random(9);
  HemisphereSamples samples = randomSamples({Stratification::kPolar, {2, 2}}, randomFrame(random, 1.0), 3);
  samples.radiance[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { textOf(samples); }, testing::ThrowsMessage<std::domain_error>(HasSubstr("radiance[2] is nan")));
}

/// A record with hits and position in single precision, as renderers have them; `shift` columns to the right.
std::string inSinglePrecision(const HemisphereSamples& samples, std::size_t shift) {
  Json record = Json::parse(textOf(samples));
  const auto round = [](Json& vector) {
    for (Json& number : vector) number = static_cast<double>(static_cast<float>(number.get<double>()));
  };
  round(record["position"]);
  const std::size_t columns = samples.shape.columns;
  const Json hits = record["hits"];
  for (std::size_t k = 0; k < samples.shape.size(); ++k) {
    Json& hit = record["hits"][k / columns * columns + (k % columns + shift) % columns];
    hit = hits[k];
    if (!hit.is_null())
      round(hit);
    else if (shift > 0)
      record["radiance"][k / columns * columns + (k % columns + shift) % columns] = 0;
  }
  return record.dump();
}

TEST(SamplesFile, AcceptsWhatSinglePrecisionDoesToDirections) {
  std::mt19937_64 random(10);
  for (const double extent : {1.0, 100.0, 10000.0}) {
    for (int trial = 0; trial < 20; ++trial) {
      for (const Grid& grid : kGrids) {
        const HemisphereSamples samples = randomSamples(grid, randomFrame(random, extent), random());
        EXPECT_EQ(refusal(inSinglePrecision(samples, 0)), "") << extent;
        if (extent > 1000.0) continue;  // there, a float tells 1 m only to 1 mm
        EXPECT_THAT(refusal(inSinglePrecision(samples, 1)), HasSubstr("outside its stratum")) << extent;
      }
    }
  }
}

TEST(SamplesFile, AcceptsNeighboursThatCoincideOnTheirBorder) {
  Json record = goodRecord();
  record["hits"] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 2}, {0, 0, 1}};
  record["radiance"] = {1, 1, 1, 1};
  EXPECT_EQ(refusal(record.dump()), "");
  record["hits"] = {{-1, 0, 1}, {1, 0, 0}, {-1, 0, 1}, {1, 0, -1e-9}};
  const HemisphereSamples samples = readOne(record.dump());
  EXPECT_EQ(samples.direction(0), samples.direction(2));
  EXPECT_EQ(samples.direction(3), Vector3d(1, 0, 0)) << "taken to the horizon";
  // Beyond what single precision explains.
  record["hits"][3] = {1, 0, -1e-5};
  EXPECT_THAT(refusal(record.dump()), HasSubstr("hits[3]: (1, 0, -1e-05) is below the horizon"));
}

TEST(SamplesFile, LetsNoNumberThroughThatIsNotFinite) {
  std::mt19937_64 random(11);
  const std::vector<double> extremes = {0, -0.0, 1, -1, 5e-324, -1e-310, 1e-200, 1e200, -1.7e308, 1.7e308, 0.25};
  std::uniform_int_distribution<std::size_t> pick(0, extremes.size() - 1), sample(0, 3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int accepted = 0;
  int refused = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Json record = goodRecord();
    record["position"] = {extremes[pick(random)], extremes[pick(random)], extremes[pick(random)]};
    if (trial % 2 == 0) record["position"] = {0, 0, 0};
    record["shape"] = {1, 1};
    record["hits"] = {{extremes[pick(random)], unit(random) * extremes[pick(random)], extremes[pick(random)]}};
    record["radiance"] = {std::abs(extremes[pick(random)])};
    try {
      const HemisphereSamples samples = readOne(record.dump());
      ++accepted;
      const Vector3d d = samples.direction(0);
      ASSERT_TRUE(std::abs(d.norm() - 1.0) <= 4 * kUnitRoundoff && d.z() >= 0.0) << record.dump();
      ASSERT_TRUE(std::isfinite(samples.inverse_distance[0]) && samples.inverse_distance[0] >= 0.0) << record.dump();
      ASSERT_TRUE(std::isfinite(samples.radiance[0])) << record.dump();
    } catch (const SceneFileError& error) {
      ++refused;
      ASSERT_THAT(error.what(), StartsWith("hits[0]: "));
    }
  }
  EXPECT_GT(accepted, 1000);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace irradiff
