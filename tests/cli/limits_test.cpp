// Time and memory of the program on large input.

#include "derivatives/samples/strata.h"
#include "tests/cli/program_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <numbers>
#include <string>

namespace irradiff {
namespace {

/// A scene of `quads` lamps side by side, and five receivers under them.
std::string lampScene(int number, int quads) {
  nlohmann::json scene = nlohmann::json::parse(
      R"({"format": "irradiff-scene", "version": 1, "dimension": 3, "polygons": [], "points": []})");
  for (int i = 0; i < quads; ++i) {
    const double x = i + 1e-3 * number;
    scene["polygons"].push_back({{"name", "lamp " + std::to_string(i)},
                                 {"vertices", {{x, 0, 2}, {x + 0.5, 0, 2}, {x + 0.5, 0.5, 2}, {x, 0.5, 2}}},
                                 {"radiance", 1.5}});
  }
  for (int i = 0; i < 5; ++i) scene["points"].push_back({{"position", {0.25 * i, 0.125, 0}}, {"normal", {0, 0, 1}}});
  return scene.dump() + "\n";
}

TEST(Limits, AThousandScenesTakeLessThanASecond) {
  std::string input;
  for (int i = 0; i < 1000; ++i) input += lampScene(i, 4);
  const ProgramRun run = runProgram({"evaluate"}, input);
  EXPECT_EQ(run.status, 0) << run.messages;
  EXPECT_EQ(jsonLines(run.output).size(), 1000);
  std::cout << "1000 scenes of 4 quads and 5 receivers: " << run.seconds << " s\n";
  EXPECT_LT(run.seconds, 1.0);
}

TEST(Limits, ALineOf100MegabytesIsRefusedInBoundedMemoryAndTheRestEvaluated) {
  const ScratchFolder scratch;
  {
    std::ofstream file(scratch.file("input"));
    file << lampScene(0, 1) << R"({"format": "irradiff-scene", "description": ")";
    const std::string chunk(1000000, 'x');
    for (int i = 0; i < 100; ++i) file << chunk;
    file << "\"}\n" << lampScene(1, 1);
  }
  const ProgramRun run = runProgramBetween({"evaluate"}, scratch.file("input"), scratch.file("output"));
  EXPECT_EQ(run.status, 1);
  const std::vector<nlohmann::json> lines = jsonLines(readFile(scratch.file("output")));
  ASSERT_EQ(lines.size(), 3);
  EXPECT_TRUE(lines[0].contains("results"));
  EXPECT_THAT(lines[1].at("error").get<std::string>(), testing::HasSubstr("longer than 67108864 bytes"));
  EXPECT_TRUE(lines[2].contains("results"));
  std::cout << "line of 100 MB: " << run.seconds << " s, " << run.peak_kilobytes / 1024 << " MiB\n";
  // 64 MiB of text are kept while it is not clear that there is more; a growing string may need three times that.
  EXPECT_LE(run.peak_kilobytes, 256 * 1024);
  EXPECT_LT(run.seconds, 10.0);
}

/// Receivers at (i + 0.5, j + 0.5, 0), looking up, i and j below `width`, under one triangle.
std::string gridScene(int width, const std::string& triangle) {
  const std::string size = std::to_string(width);
  return R"({"format": "irradiff-scene", "version": 1, "dimension": 3, "polygons": [{"name": "lamp", "radiance": 1,
    "vertices": )" +
         triangle + R"(}], "grid": {"origin": [0,0,0], "u": [)" + size + R"(,0,0], "v": [0,)" + size +
         R"(,0], "resolution": [)" + size + "," + size + R"(], "normal": [0,0,1]}})";
}

TEST(Limits, AGridIsEvaluatedInLessMemoryThanItsResultsTake) {
  const ScratchFolder scratch;
  writeFile(scratch.file("input"), gridScene(640, "[[0,0,50],[640,0,50],[0,640,60]]"));
  const ProgramRun run = runProgramBetween({"evaluate"}, scratch.file("input"), scratch.file("output"));
  EXPECT_EQ(run.status, 0) << run.messages;
  const auto size = static_cast<long>(std::filesystem::file_size(scratch.file("output")) / 1024);
  std::cout << "grid of 640 x 640: " << run.seconds << " s, " << run.peak_kilobytes / 1024 << " MiB for " << size / 1024
            << " MiB of results\n";
  EXPECT_LT(run.peak_kilobytes, 160 * 1024);
  ASSERT_GT(size, 256 * 1024) << "too few results to show anything";
  const std::string line = readFile(scratch.file("output"));
  EXPECT_TRUE(line.starts_with("{\"results\":[{\"irradiance\":"));
  EXPECT_TRUE(line.ends_with("}]}\n"));
  EXPECT_EQ(std::ranges::count(line, '\n'), 1);
  std::size_t results = 0;
  for (std::size_t at = 0; (at = line.find("\"irradiance\":", at)) != std::string::npos; ++at) ++results;
  EXPECT_EQ(results, 2 * 640 * 640) << "of each receiver its irradiance and that one's bound";
}

TEST(Limits, AnErrorAtTheLastReceiverOfAGridTakesThePlaceOfAllItsResults) {
  // The last receiver is on the triangle's first vertex.
  const std::string input = gridScene(300, "[[299.5,299.5,0],[400,299.5,1],[400,400,1]]") + "\n";
  const ProgramRun run = runProgram({"evaluate"}, input);
  EXPECT_EQ(run.status, 1);
  const std::vector<nlohmann::json> lines = jsonLines(run.output);
  ASSERT_EQ(lines.size(), 1);
  EXPECT_THAT(lines[0].at("error").get<std::string>(),
              testing::AllOf(testing::HasSubstr("\"lamp\""), testing::HasSubstr("[299.5, 299.5, 0]")));
}

/// A record of `width` x `width` concentric samples, each a hit in the middle of its stratum in whole units of 10
/// micrometres, on the unit hemisphere; of the radiance that is given for each sample's number.
void writeManySamples(const std::filesystem::path& path, std::size_t width,
                      const std::function<std::size_t(std::size_t)>& radiance) {
  const Strata strata(Stratification::kConcentric, {width, width});
  std::ofstream file(path);
  file << R"({"format": "irradiff-samples", "version": 1, "position": [0,0,0], "normal": [0,0,1], "tangent": [1,0,0],
    "bitangent": [0,1,0], "stratification": "concentric", "shape": [)"
       << width << ',' << width << R"(], "hits": [)";
  for (std::size_t row = 0; row < width; ++row) {
    std::string line = row > 0 ? ",\n" : "\n";
    for (std::size_t column = 0; column < width; ++column) {
      const Eigen::Vector3d hit = 1e5 * strata.direction({row, column, 0.5, 0.5});
      line += (column > 0 ? ",[" : "[") + std::to_string(std::lround(hit.x())) + ',' +
              std::to_string(std::lround(hit.y())) + ',' + std::to_string(std::lround(hit.z())) + ']';
    }
    file << line;
  }
  file << R"(], "radiance": [)" << radiance(0);
  for (std::size_t i = 1; i < width * width; ++i) file << ',' << radiance(i);
  file << "]}";
}

/// Irradiance and gradient; the program must stay within 2 GB.
nlohmann::json estimateInLittleMemory(const ScratchFolder& scratch, const std::string& estimator) {
  const ProgramRun run = runProgram({"estimate", scratch.file("samples").string(), "--estimator", estimator});
  EXPECT_EQ(run.status, 0) << run.messages;
  std::cout << "4096 x 4096 samples, " << estimator << ": " << run.seconds << " s, " << run.peak_kilobytes / 1024
            << " MiB\n";
  EXPECT_LT(run.peak_kilobytes, 2'000'000'000 / 1024) << estimator;
  return jsonLines(run.output).at(0).at("results").at(0);
}

TEST(Limits, SixteenMillionSamplesFitIn2Gigabytes) {
  const ScratchFolder scratch;
  writeManySamples(scratch.file("samples"), 4096, [](std::size_t) { return 2; });
  const nlohmann::json result = estimateInLittleMemory(scratch, "ward-heckbert");
  // 2 pi, to the rounding of a sum of 2^24 terms.
  EXPECT_NEAR(result.at("irradiance").get<double>(), 2.0 * std::numbers::pi, 2.0 * std::numbers::pi * 0x1p-53 * 0x1p24);
  for (const nlohmann::json& component : result.at("gradient")) EXPECT_EQ(component, 0.0) << "nothing varies";
}

// The estimator that keeps most beside the samples, where no neighbours are alike.
TEST(Limits, SixteenMillionDifferentSamplesFitIn2Gigabytes) {
  const ScratchFolder scratch;
  constexpr std::size_t kRange = 1U << 20U;
  writeManySamples(scratch.file("samples"), 4096, [](std::size_t i) { return i * 2654435761U % kRange; });
  const nlohmann::json result = estimateInLittleMemory(scratch, "discontinuity");
  // 2^24 numbers spread evenly: an odd factor permutes those below a power of two.
  const double mean = 0.5 * (kRange - 1);
  EXPECT_NEAR(result.at("irradiance").get<double>(), std::numbers::pi * mean,
              std::numbers::pi * mean * 0x1p-53 * 0x1p24);
}

}  // namespace
}  // namespace irradiff
