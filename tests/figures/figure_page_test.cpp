#include "experiments/figures/figure_page.h"

#include "experiments/figures/analytic_page.h"
#include "experiments/figures/map_pictures.h"
#include "tests/figures/small_maps.h"
#include "tests/io/image_reading.h"
#include "tests/report/report_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace irradiff {
namespace {

using testing::HasSubstr;
using testing::Not;

AnalyticFigure figureOf(std::size_t width, std::size_t height) {
  AnalyticFigure figure{{"lamps & <lamps>.json", "{}", {}}, plainMap(width, height)};
  figure.scene.scene.description = "Why \"this\" <scene> is here";
  for (MapChannel& channel : figure.map.channels) {
    if (channel.name == "hessian.xy") {
      channel.values[0] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return figure;
}

std::string pageOf(const AnalyticFigure& figure) {
  RunRecord record;
  record.machine = "a <machine>";
  return analyticPage(figure, record, mapPictures(figure.map));
}

/// What stands between `begin` and `end`, for each time that `begin` does.
std::vector<std::string> between(const std::string& text, const std::string& begin, const std::string& end) {
  std::vector<std::string> found;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
    at += begin.size();
    found.push_back(text.substr(at, text.find(end, at) - at));
  }
  return found;
}

nlohmann::json dataOf(const std::string& page) {
  return nlohmann::json::parse(between(page, "<script type=\"application/json\" id=\"map-data\">", "</script>").at(0));
}

std::vector<float> floatsOf(const std::string& base64_text) {
  const std::string bytes = bytesOfBase64(base64_text);
  std::vector<float> floats;
  for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4) {
    std::uint32_t bits = 0;
    for (std::size_t k = 4; k-- > 0;) {
      bits = (bits << 8U) | static_cast<unsigned char>(bytes[i + k]);
    }
    floats.push_back(std::bit_cast<float>(bits));
  }
  return floats;
}

TEST(FigurePage, StandsByItself) {
  const std::string page = pageOf(figureOf(6, 4));
  EXPECT_EQ(unbalancedTag(page), "");
  for (const char* outside : {"http:", "https:", "<link", "@import", "src=\"//", "url("}) {
    EXPECT_THAT(page, Not(HasSubstr(outside)));
  }
  for (const std::string& source : between(page, " src=\"", "\"")) {
    EXPECT_TRUE(source.starts_with("data:image/png;base64,")) << source.substr(0, 40);
  }
  EXPECT_THAT(page, HasSubstr("width=device-width"));
  EXPECT_THAT(page, HasSubstr("@media print"));
}

TEST(FigurePage, EscapesWhatComesFromTheScene) {
  const std::string page = pageOf(figureOf(2, 2));
  EXPECT_THAT(page, HasSubstr("lamps &amp; &lt;lamps&gt;.json"));
  EXPECT_THAT(page, HasSubstr("Why &quot;this&quot; &lt;scene&gt; is here"));
  EXPECT_THAT(page, HasSubstr("a &lt;machine&gt;"));
}

TEST(FigurePage, ShowsEachPictureAsItIs) {
  const AnalyticFigure figure = figureOf(6, 4);
  const std::string page = pageOf(figure);
  const std::vector<MapPicture> pictures = mapPictures(figure.map);
  const std::vector<std::string> images = between(page, "data:image/png;base64,", "\"");
  const std::vector<std::string> names = between(page, "<figure data-name=\"", "\"");
  ASSERT_EQ(images.size(), pictures.size());
  ASSERT_EQ(names.size(), pictures.size());
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    EXPECT_EQ(names[i], pictures[i].name);
    EXPECT_EQ(readPng(bytesOfBase64(images[i])).pixels, pictures[i].image.pixels) << names[i];
    EXPECT_THAT(page, HasSubstr(pictures[i].scaling));
  }
}

TEST(FigurePage, HoldsTheValues) {
  const AnalyticFigure figure = figureOf(6, 4);
  const nlohmann::json data = dataOf(pageOf(figure));
  EXPECT_EQ(data.at("columns"), 6);
  EXPECT_EQ(data.at("rows"), 4);
  ASSERT_EQ(data.at("channels").size(), figure.map.channels.size());
  for (std::size_t c = 0; c < figure.map.channels.size(); ++c) {
    const MapChannel& channel = figure.map.channels[c];
    EXPECT_EQ(data["channels"][c].at("name"), channel.name);
    const std::vector<float> values = floatsOf(data["channels"][c].at("values"));
    ASSERT_EQ(values.size(), channel.values.size()) << channel.name;
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_TRUE(values[i] == static_cast<float>(channel.values[i]) ||
                  (std::isnan(values[i]) && std::isnan(channel.values[i])))
          << channel.name << ' ' << i;
    }
  }
  EXPECT_EQ(data["channels"][0].at("unit"), "W/m\u00b2");
}

// Of 300 columns, the one in the middle of each of 256 parts; every row of 20. E is 10 j + i there.
TEST(FigurePage, ThinsOutALargeMap) {
  const nlohmann::json data = dataOf(pageOf(figureOf(300, 20)));
  EXPECT_EQ(data.at("columns"), kPageValues);
  EXPECT_EQ(data.at("rows"), 20);
  EXPECT_EQ(data.at("width"), 300);
  const std::vector<float> values = floatsOf(data["channels"][0].at("values"));
  ASSERT_EQ(values.size(), kPageValues * 20);
  for (std::size_t j = 0; j < 20; ++j) {
    for (std::size_t i = 0; i < kPageValues; ++i) {
      const double column = std::floor((static_cast<double>(i) + 0.5) * 300 / 256);
      EXPECT_EQ(values[j * kPageValues + i], 10 * static_cast<double>(j) + column);
    }
  }
}

TEST(FigurePage, SaysHowFarItIsOffAndWhatExistsNowhere) {
  AnalyticFigure figure = figureOf(3, 3);
  std::string page = pageOf(figure);
  EXPECT_THAT(page, HasSubstr("E is off by at most 1.0e-14 W/m\u00b2."));
  EXPECT_THAT(page, HasSubstr("The Hessian in space is off by at most 3.0e-14 W/m\u2074."));
  for (MapChannel& channel : figure.map.channels) {
    if (channel.name == "bound.hessian") {
      channel.values.assign(9, std::numeric_limits<double>::quiet_NaN());
    }
  }
  page = pageOf(figure);
  EXPECT_THAT(page, HasSubstr("The Hessian in space exists at none of them."));
  EXPECT_THAT(page, HasSubstr("The tangential Hessian is off by at most 4.0e-14"));
}

// The script finds its elements by these names.
TEST(FigurePage, HasWhatItsScriptLooksFor) {
  const AnalyticFigure figure = figureOf(3, 3);
  const std::string page = pageOf(figure);
  for (const std::string& id : between(page, "byId(\"", "\"")) {
    EXPECT_THAT(page, HasSubstr("id=\"" + id + '"'));
  }
  for (const MapChannel& channel : figure.map.channels) {
    EXPECT_THAT(page, HasSubstr("id=\"value-" + channel.name + '"'));
  }
  EXPECT_THAT(page, HasSubstr("data-name=\"E\""));
  EXPECT_THAT(page, HasSubstr("data-name=\"eigenvalues\""));
}

}  // namespace
}  // namespace irradiff
