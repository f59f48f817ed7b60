// `irradiff cache` and `irradiff curves` as a black box: what they write, that nothing depends on threads, that a
// killed run goes on, and what they say to wrong calls.

#include "tests/cli/program_run.h"
#include "tests/cli/running_program.h"
#include "tests/cli/small_room.h"
#include "tests/io/image_reading.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace irradiff {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

/// A lamp and a screen that hides some of it, over a grid.
constexpr const char* kPlane =
    R"({"format": "irradiff-scene", "version": 1, "dimension": 3, "description": "A lamp behind a screen.",
    "polygons": [{"name": "lamp", "radiance": 2.5, "vertices": [[0.1,0.2,1], [0.9,0.3,1], [0.8,0.7,1], [0.2,0.9,1]]},
                 {"name": "screen", "radiance": 0, "vertices": [[0.3,0.3,0.5], [0.6,0.3,0.5], [0.6,0.7,0.5]]}],
    "grid": {"origin": [0,0,0], "u": [1,0,0], "v": [0,1,0], "resolution": [16,16], "normal": [0,0,1]}})";

/// A floor between four walls, all as bright as the ceiling: the same irradiance everywhere, and no Hessian.
constexpr const char* kEven =
    R"({"format": "irradiff-scene", "version": 1, "dimension": 3, "description": "Light without a shadow.",
    "polygons": [{"name": "ceiling", "radiance": 1, "vertices": [[0,0,1], [1,0,1], [1,1,1], [0,1,1]]},
                 {"name": "south", "radiance": 1, "vertices": [[0,0,0], [1,0,0], [1,0,1], [0,0,1]]},
                 {"name": "north", "radiance": 1, "vertices": [[0,1,0], [1,1,0], [1,1,1], [0,1,1]]},
                 {"name": "west", "radiance": 1, "vertices": [[0,0,0], [0,1,0], [0,1,1], [0,0,1]]},
                 {"name": "east", "radiance": 1, "vertices": [[1,0,0], [1,1,0], [1,1,1], [1,0,1]]}],
    "grid": {"origin": [0,0,0], "u": [1,0,0], "v": [0,1,0], "resolution": [16,16], "normal": [0,0,1]}})";

class CacheCommand : public testing::Test {
 protected:
  CacheCommand() {
    writeFile(scratch_.file("plane.json"), kPlane);
    files_ = 1;
  }

  std::string path(const std::string& name) const { return scratch_.file(name).string(); }

  std::vector<std::string> call(const std::string& file, const std::string& output,
                                const std::vector<std::string>& options) const {
    std::vector<std::string> arguments{"cache", file, "--output", path(output)};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
  }

  ProgramRun cache(const std::string& output, std::vector<std::string> options) const {
    options.insert(options.end(), {"--width", "24"});
    return runProgram(call(path("plane.json"), output, options));
  }

  Json summary(const std::string& output) const {
    return Json::parse(readFile(scratch_.file(output) / "summary.json"));
  }

  /// All files but those that tell when and how they were made.
  std::map<std::string, std::string> results(const std::string& output) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(scratch_.file(output))) {
      const std::string name = fs::relative(entry.path(), scratch_.file(output)).string();
      const bool is_dated = name == "run.json" || name == "index.html";
      if (entry.is_regular_file() && !is_dated) files[name] = readFile(entry.path());
    }
    return files;
  }

  template <class Matcher>
  void expectRefusal(const ProgramRun& run, const Matcher& message) const {
    EXPECT_EQ(run.status, 2) << run.messages;
    EXPECT_THAT(run.messages, message);
    EXPECT_EQ(scratch_.fileCount(), files_);
  }

  ScratchFolder scratch_;
  std::size_t files_ = 0;
};

TEST_F(CacheCommand, WritesImagesRecordsSummaryPageAndRecord) {
  const ProgramRun run = cache("out", {"--records", "60"});
  ASSERT_EQ(run.status, 0) << run.messages;
  EXPECT_EQ(run.messages, "") << "no progress in a pipe";
  EXPECT_THAT(run.output, AllOf(HasSubstr("of occlusion-hessian for 576 receivers"), HasSubstr("index.html")));
  EXPECT_EQ(scratch_.fileCount(), 2U) << "the scene and the results, nothing aside";
  for (const char* name : {"irradiance.exr", "irradiance.png", "footprints.png", "radii.png", "error.png",
                           "records.csv", "summary.json", "run.json"}) {
    EXPECT_TRUE(fs::exists(scratch_.file("out") / name)) << name;
  }
  const Json found = summary("out");
  EXPECT_NEAR(found.at("records").get<double>(), 60.0, 1.2);
  EXPECT_EQ(found.at("served_receivers"), 576);
  EXPECT_EQ(found.at("rays"), 0) << "derivatives are exact";
  const std::string records = readFile(scratch_.file("out") / "records.csv");
  EXPECT_EQ(std::ranges::count(records, '\n'), 1 + found.at("records").get<int>());
  EXPECT_THAT(records, HasSubstr("half_axis1,half_axis2,d2E_dxx,d2E_dxy,d2E_dxz,d2E_dyy,d2E_dyz,d2E_dzz\r\n"));
  const Json record = Json::parse(readFile(scratch_.file("out") / "run.json"));
  EXPECT_EQ(record.at("command").at(1), "cache");
  EXPECT_TRUE(record.at("seed").is_null()) << "nothing is random";
  EXPECT_EQ(record.at("configuration").at("metric"), "occlusion-hessian");
  EXPECT_EQ(record.at("configuration").at("known_geometry"), false);
  EXPECT_EQ(record.at("configuration").at("black_pixels"), 2.0) << "24/12";
  EXPECT_THAT(readFile(scratch_.file("out") / "index.html"), HasSubstr("A lamp behind a screen."));
}

// The errors that are told are those of the image.
TEST_F(CacheCommand, TellsTheErrorsOfItsImage) {
  ASSERT_EQ(cache("out", {"--records", "40", "--metric", "split-sphere"}).status, 0);
  const ReadExr image = readExr(readFile(scratch_.file("out") / "irradiance.exr"));
  const auto& irradiance = image.channels.at("irradiance");
  const auto& reference = image.channels.at("reference");
  double sum = 0.0;
  double mean = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < irradiance.size(); ++i) {
    const double error = irradiance[i] - reference[i];
    sum += error * error;
    mean += reference[i] / static_cast<double>(irradiance.size());
    largest = std::max(largest, std::abs(error));
  }
  const double rms = std::sqrt(sum / static_cast<double>(irradiance.size())) / mean;
  const Json found = summary("out");
  // Single precision of values near the mean.
  EXPECT_NEAR(found.at("rms").get<double>(), rms, 1e-5 * rms + 1e-6);
  EXPECT_NEAR(found.at("maximum").get<double>(), largest / mean, 1e-6);
  EXPECT_GT(rms, 1e-4);
}

TEST_F(CacheCommand, TakesTheThresholdThatIsGiven) {
  ASSERT_EQ(cache("coarse", {"--threshold", "1e-3"}).status, 0);
  ASSERT_EQ(cache("fine", {"--threshold", "1e-5"}).status, 0);
  EXPECT_EQ(summary("coarse").at("threshold"), 1e-3);
  EXPECT_LT(summary("coarse").at("records"), summary("fine").at("records"));
  ASSERT_EQ(cache("round", {"--threshold", "1e-5", "--aspect", "1"}).status, 0);
  EXPECT_LT(summary("fine").at("records"), summary("round").at("records")) << "circles cover less";
  for (const char* measure : {"total", "mean"}) {
    const ProgramRun run = cache(
        "other", {"--threshold", "1e-3", "--measure", measure, "--scale", "absolute", "--ellipse", "equal-error-exact",
                  "--order", "rows", "--no-overture", "--clamp-neighbours", "--passes", "2"});
    EXPECT_EQ(run.status, 0) << run.messages;
  }
}

TEST_F(CacheCommand, IsTheSameForAnyNumberOfThreads) {
  for (const char* metric : {"reprojection", "oracle"}) {
    const std::vector<std::string> options{"--rays", "64", "--records", "40", "--metric", metric};
    std::vector<std::string> one = options;
    one.insert(one.end(), {"--threads", "1"});
    std::vector<std::string> two = options;
    two.insert(two.end(), {"--threads", "2"});
    ASSERT_EQ(cache("one", one).status, 0);
    ASSERT_EQ(cache("two", two).status, 0);
    EXPECT_TRUE(results("one") == results("two")) << metric;
  }
  ASSERT_EQ(cache("other", {"--rays", "64", "--records", "40", "--metric", "oracle", "--seed", "2"}).status, 0);
  EXPECT_FALSE(results("one").at("records.csv") == results("other").at("records.csv"));
}

TEST_F(CacheCommand, StopsAtTheLimitOfRecords) {
  const ProgramRun run = cache("out", {"--threshold", "1e-7", "--most-records", "7"});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.messages, AllOf(HasSubstr("limit of 7 records was reached"), HasSubstr("of 576 receivers")));
  const Json found = summary("out");
  EXPECT_EQ(found.at("records"), 7);
  EXPECT_EQ(found.at("reached_limit"), true);
  const ReadExr image = readExr(readFile(scratch_.file("out") / "irradiance.exr"));
  const auto& irradiance = image.channels.at("irradiance");
  const auto served = std::ranges::count_if(irradiance, [](double value) { return !std::isnan(value); });
  EXPECT_EQ(found.at("served_receivers"), served);
  EXPECT_LT(served, 576);
}

TEST_F(CacheCommand, SaysWhereTheNumberOfRecordsIsOutOfReach) {
  // At least a pixel, at most two: 576 receivers cannot do with 5 records.
  const ProgramRun run = cache("out", {"--metric", "bounded-split-sphere", "--records", "2"});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.messages, AllOf(HasSubstr("Asked for 2 records"), HasSubstr("bounded-split-sphere")));
  EXPECT_EQ(summary("out").at("is_within"), false);
  const ProgramRun more = cache("more", {"--records", "577"});
  EXPECT_EQ(more.status, 1);
  EXPECT_THAT(more.messages, AllOf(HasSubstr("577 records"), HasSubstr("the number of receivers, 576")));
  EXPECT_FALSE(fs::exists(scratch_.file("more")));
}

TEST_F(CacheCommand, ServesAllByOneRecordWhereNothingChanges) {
  writeFile(scratch_.file("even.json"), kEven);
  const ProgramRun run = runProgram(call(path("even.json"), "out", {"--width", "16", "--threshold", "0.01"}));
  ASSERT_EQ(run.status, 0) << run.messages;
  EXPECT_EQ(summary("out").at("records"), 1);
  EXPECT_LT(summary("out").at("maximum").get<double>(), 1e-9);
}

TEST_F(CacheCommand, KnowsTheGeometryOfRoomsWhereItIsAsked) {
  writeFile(scratch_.file("room.json"), kSmallRoom);
  const auto room = [&](const std::string& output, std::vector<std::string> options) {
    options.insert(options.end(), {"--width", "16", "--rays", "256", "--threshold", "0.01"});
    EXPECT_EQ(runProgram(call(path("room.json"), output, options)).status, 0) << output;
    return Json::parse(readFile(scratch_.file(output) / "run.json"))
        .at("configuration")
        .at("known_geometry")
        .get<bool>();
  };
  EXPECT_TRUE(room("second", {"--metric", "second-order"}));
  EXPECT_FALSE(room("samples", {"--metric", "second-order", "--no-known-geometry"}));
  EXPECT_TRUE(room("known", {"--known-geometry"}));
  // What is asked for is what is done.
  const auto isSecondOrder = [&](const std::string& output) {
    const std::string records = readFile(scratch_.file(output) / "records.csv");
    return records.find(",0,0,0,0,0,0\r\n") == std::string::npos;
  };
  EXPECT_TRUE(readFile(scratch_.file("second") / "records.csv") != readFile(scratch_.file("samples") / "records.csv"));
  EXPECT_TRUE(isSecondOrder("second"));
  EXPECT_FALSE(isSecondOrder("known")) << "occlusion-hessian extrapolates to first order";
}

TEST_F(CacheCommand, RefusesWrongCalls) {
  for (const char* threshold : {"0", "-1", "nan", "inf", "much"}) {
    expectRefusal(
        cache("out", {"--threshold", threshold}),
        AllOf(HasSubstr("--threshold"), HasSubstr('"' + std::string(threshold) + '"'), HasSubstr("greater than 0")));
  }
  expectRefusal(cache("out", {"--metric", "nonsense"}),
                AllOf(HasSubstr("--metric"), HasSubstr("\"nonsense\""),
                      HasSubstr("split-sphere, bounded-split-sphere, radiometric-hessian, geometric-hessian, "
                                "occlusion-hessian, reprojection, second-order, oracle")));
  expectRefusal(cache("out", {"--threshold", "1", "--records", "10"}),
                AllOf(HasSubstr("--threshold"), HasSubstr("--records")));
  expectRefusal(cache("out", {"--records", "0"}), AllOf(HasSubstr("--records"), HasSubstr("from 1")));
  expectRefusal(cache("out", {"--scale", "some"}), AllOf(HasSubstr("--scale"), HasSubstr("absolute")));
  expectRefusal(cache("out", {"--measure", "some"}), AllOf(HasSubstr("--measure"), HasSubstr("mean")));
  expectRefusal(cache("out", {"--ellipse", "some"}), AllOf(HasSubstr("--ellipse"), HasSubstr("equal-error-exact")));
  expectRefusal(cache("out", {"--order", "some"}), AllOf(HasSubstr("--order"), HasSubstr("refining")));
  expectRefusal(cache("out", {"--aspect", "0.5"}), AllOf(HasSubstr("--aspect"), HasSubstr("from 1")));
  expectRefusal(cache("out", {"--rays", "15"}), AllOf(HasSubstr("--rays"), HasSubstr("from 16")));
  expectRefusal(cache("out", {"--threads", "0"}), HasSubstr("--threads"));
  expectRefusal(cache("out", {"--known-geometry"}),
                AllOf(HasSubstr("--known-geometry"), HasSubstr("plane.json"), HasSubstr("no room in space")));
  expectRefusal(cache("out", {"--known-geometry=much"}), HasSubstr("--known-geometry"));
  expectRefusal(cache("out", {"--known-geometry", "--no-known-geometry"}), HasSubstr("--no-known-geometry"));
  expectRefusal(runProgram({"cache", path("plane.json")}), HasSubstr("--output"));
  expectRefusal(runProgram({"cache", "--output", path("out")}), HasSubstr("FILE"));
  expectRefusal(runProgram(call(path("none.json"), "out", {})), AllOf(HasSubstr("FILE"), HasSubstr("none.json")));
}

TEST_F(CacheCommand, RefusesABlackScene) {
  std::string black = kPlane;
  black.replace(black.find("2.5"), 3, "0.0");
  writeFile(scratch_.file("black.json"), black);
  files_ = 2;
  expectRefusal(runProgram(call(path("black.json"), "out", {})),
                AllOf(HasSubstr("black.json"), HasSubstr("radiance 0"), HasSubstr("must radiate")));
  writeFile(scratch_.file("black.json"), R"({"format": "irradiff-film"})");
  expectRefusal(runProgram(call(path("black.json"), "out", {})),
                AllOf(HasSubstr("black.json"), HasSubstr("irradiff-film"), HasSubstr("irradiff-room")));
}

TEST_F(CacheCommand, LeavesForeignFoldersAlone) {
  fs::create_directory(scratch_.file("mine"));
  writeFile(scratch_.file("mine") / "notes.txt", "mine");
  const ProgramRun run = cache("mine", {"--records", "20"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.messages, AllOf(HasSubstr("--output"), HasSubstr("is not a cache of irradiff")));
  EXPECT_EQ(readFile(scratch_.file("mine") / "notes.txt"), "mine");
}

TEST_F(CacheCommand, GoesOnAfterItWasKilled) {
  const std::vector<std::string> options{"--width", "32", "--rays", "4096", "--records", "50", "--threads", "1"};
  const fs::path unfinished = scratch_.file("out.part");
  {
    RunningProgram run(call(path("plane.json"), "out", options));
    while (tilesIn(unfinished) < 3) {
      ASSERT_TRUE(run.isRunning()) << "it ended before it could be killed";
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    run.kill();
  }
  ASSERT_FALSE(fs::exists(scratch_.file("out")));
  ASSERT_GE(tilesIn(unfinished), 3U);
  ASSERT_EQ(runProgram(call(path("plane.json"), "out", options)).status, 0);
  EXPECT_FALSE(fs::exists(unfinished));
  ASSERT_EQ(runProgram(call(path("plane.json"), "whole", options)).status, 0);
  EXPECT_TRUE(results("out") == results("whole"));
}

class CurvesCommand : public CacheCommand {
 protected:
  ProgramRun curves(const std::string& output, const std::vector<std::string>& options) const {
    std::vector<std::string> arguments{"curves", path("plane.json"), "--output",          path(output), "--effort",
                                       "quick",  "--metric",         "occlusion-hessian", "--metric",   "oracle"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return runProgram(arguments);
  }
};

TEST_F(CurvesCommand, WritesCurvesRatiosPlotsPageAndRecord) {
  const ProgramRun run = curves("out", {"--threads", "1"});
  ASSERT_EQ(run.status, 0) << run.messages;
  EXPECT_EQ(run.messages, "");
  EXPECT_EQ(scratch_.fileCount(), 2U) << "the scene and the results, nothing aside";
  const auto files = results("out");
  for (const char* name : {"curves.csv", "curves.json", "slopes.csv", "ratios.csv", "table.csv", "figures.csv",
                           "plane_curves.svg", "plane_ratios.svg", "plane/oracle.footprints.png", "metrics.md"}) {
    EXPECT_TRUE(files.contains(name)) << name;
  }
  std::map<std::string, std::map<int, double>> rms;
  for (const Json& row : Json::parse(files.at("curves.json"))) {
    EXPECT_EQ(row.at("is_within"), true) << row;
    rms[row.at("metric")][row.at("asked_records")] = row.at("rms");
  }
  ASSERT_EQ(rms.size(), 2U);
  for (const auto& [metric, curve] : rms) EXPECT_LT(curve.rbegin()->second, 0.5 * curve.begin()->second) << metric;
  for (const Json& row : Json::parse(files.at("ratios.json"))) {
    if (row.at("metric") != "oracle" || row.at("ratio") != "radius") continue;
    EXPECT_EQ(row.at("low_5"), 1.0);
    EXPECT_EQ(row.at("high_95"), 1.0);
  }
  EXPECT_THAT(readFile(scratch_.file("out") / "index.html"), AllOf(HasSubstr("<svg"), HasSubstr("What we conclude")));
  ASSERT_EQ(curves("two", {"--threads", "2"}).status, 0);
  EXPECT_TRUE(files == results("two"));
}

TEST_F(CurvesCommand, RefusesWrongCalls) {
  expectRefusal(curves("out", {"--metric", "nonsense"}), AllOf(HasSubstr("\"nonsense\""), HasSubstr("reprojection")));
  expectRefusal(curves("out", {"--effort", "huge"}), HasSubstr("quick, standard or full"));
  expectRefusal(runProgram({"curves"}), HasSubstr("--output"));
  expectRefusal(runProgram({"curves", path("none.json"), "--output", path("out")}), HasSubstr("none.json"));
}

}  // namespace
}  // namespace irradiff
