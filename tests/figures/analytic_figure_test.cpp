#include "experiments/figures/analytic_figure.h"

#include "experiments/figures/map_pictures.h"
#include "experiments/figures/picture_preview.h"
#include "tests/cli/program_run.h"
#include "tests/figures/small_maps.h"
#include "tests/io/image_reading.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

namespace irradiff {
namespace {

namespace fs = std::filesystem;

/// A figure with a value that does not exist, written into `folder`.
AnalyticFigure writtenFigure(const fs::path& folder) {
  AnalyticFigure figure{{"room.json", R"({"format": "irradiff-scene"})", {}}, plainMap(7, 5)};
  figure.map.channels[1].values[3] = std::numeric_limits<double>::quiet_NaN();
  figure.map.channels.back().values[6] = 1.0;
  RunRecord record;
  record.command = {"irradiff", "figure", "5"};
  record.threads = 3;
  ResultFolder result(folder, "figure");
  writeFigure(figure, record, result);
  result.commit();
  return figure;
}

TEST(AnalyticFigure, WritesEveryChannelFromTheTop) {
  const ScratchFolder scratch;
  const AnalyticFigure figure = writtenFigure(scratch.file("out"));
  const ReadExr read = readExr(readFile(scratch.file("out") / "maps.exr"));
  EXPECT_EQ(read.channels.size(), figure.map.channels.size());
  for (const MapChannel& channel : figure.map.channels) {
    const std::vector<float>& values = read.channels.at(channel.name);
    for (std::size_t j = 0; j < 5; ++j) {
      for (std::size_t i = 0; i < 7; ++i) {
        const float value = values.at((4 - j) * 7 + i);
        const double expected = channel.values[j * 7 + i];
        EXPECT_TRUE(value == static_cast<float>(expected) || (std::isnan(value) && std::isnan(expected)))
            << channel.name << " at " << i << ", " << j << ": " << value << " instead of " << expected;
      }
    }
  }
  EXPECT_EQ(read.texts.at("scene"), figure.scene.text);
  const nlohmann::json configuration = nlohmann::json::parse(read.texts.at("configuration"));
  EXPECT_EQ(configuration.at("figure"), 5);
  EXPECT_EQ(configuration.at("scene"), "room.json");
  EXPECT_EQ(configuration.at("resolution"), nlohmann::json({7, 5}));
}

TEST(AnalyticFigure, WritesAPreviewOfEachPictureAndTheRest) {
  const ScratchFolder scratch;
  const AnalyticFigure figure = writtenFigure(scratch.file("out"));
  std::set<std::string> expected{"maps.exr", "index.html", "run.json"};
  for (const MapPicture& picture : mapPictures(figure.map)) {
    expected.insert(picture.name + ".png");
    const RgbImage image = readPng(readFile(scratch.file("out") / (picture.name + ".png")));
    EXPECT_EQ(image.pixels, preview(picture).pixels) << picture.name;
  }
  std::set<std::string> found;
  for (const auto& entry : fs::directory_iterator(scratch.file("out"))) {
    found.insert(entry.path().filename());
  }
  EXPECT_EQ(found, expected);
  const nlohmann::json run = nlohmann::json::parse(readFile(scratch.file("out") / "run.json"));
  EXPECT_EQ(run.at("format"), "irradiff-run");
  EXPECT_EQ(run.at("command"), nlohmann::json({"irradiff", "figure", "5"}));
  EXPECT_EQ(run.at("configuration").at("threads"), 3);
  EXPECT_EQ(run.at("receivers_beside_an_event"), 1);
  for (const char* field : {"seed", "version", "compiler", "machine", "wall_seconds"}) {
    EXPECT_TRUE(run.contains(field)) << field;
  }
}

TEST(AnalyticFigure, GoesIntoASubfolderToo) {
  const ScratchFolder scratch;
  const AnalyticFigure figure{{"room.json", "{}", {}}, plainMap(2, 2)};
  ResultFolder result(scratch.file("report"), "report");
  writeFigure(figure, {}, result, "figure5");
  result.commit();
  EXPECT_TRUE(fs::exists(scratch.file("report") / "figure5" / "index.html"));
  EXPECT_FALSE(fs::exists(scratch.file("report") / "index.html"));
}

TEST(AnalyticFigure, KeepsCellsNearlySquare) {
  const auto sizeOf = [](double u, double v, std::size_t resolution) {
    ReceiverGrid grid = unitGrid(3, 3);
    grid.u *= u;
    grid.v *= v;
    const ReceiverGrid result = withResolution(grid, resolution);
    EXPECT_EQ(result.u, grid.u);
    return std::pair{result.width, result.height};
  };
  EXPECT_EQ(sizeOf(4, 4, 256), (std::pair<std::size_t, std::size_t>{256, 256}));
  EXPECT_EQ(sizeOf(4, 1, 100), (std::pair<std::size_t, std::size_t>{100, 25}));
  EXPECT_EQ(sizeOf(1, 3, 10), (std::pair<std::size_t, std::size_t>{3, 10}));
  EXPECT_EQ(sizeOf(1000, 1, 10), (std::pair<std::size_t, std::size_t>{10, 1}));
}

}  // namespace
}  // namespace irradiff
