// The page of Figure 5 in a headless browser: choosing, pointing and zooming as a reader does.

#include "experiments/figures/sampled_figure.h"
#include "experiments/io/scene_file.h"
#include "tests/cli/program_run.h"
#include "tests/io/image_reading.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using Json = nlohmann::json;

constexpr const char* kScene =
    R"({"format": "irradiff-scene", "version": 1, "dimension": 3, "description": "A lamp behind a screen.",
    "polygons": [{"name": "lamp", "radiance": 2.5, "vertices": [[0.1,0.2,1], [0.9,0.3,1], [0.8,0.7,1], [0.2,0.9,1]]},
                 {"name": "screen", "radiance": 0, "vertices": [[0.3,0.3,0.5], [0.6,0.3,0.5], [0.6,0.7,0.5]]}],
    "grid": {"origin": [0,0,0], "u": [1,0,0], "v": [0,1,0], "resolution": [16,16], "normal": [0,0,1]}})";

/// Runs after the page's own script. `at(x, y)` is the middle of a cell, counted from the upper left; `report` becomes
/// the result.
constexpr const char* kReader = R"js(
const report = {};
window.addEventListener("load", () => {
  const el = id => document.getElementById(id);
  const box = () => el("stage").getBoundingClientRect();
  const at = (i, j) => ({clientX: box().left + (i + 0.5) / 16 * box().width,
                         clientY: box().top + (j + 0.5) / 16 * box().height, bubbles: true, cancelable: true});
  const point = (i, j) => el("stage").dispatchEvent(new PointerEvent("pointermove", at(i, j)));
  const choose = (side, name) => { el(side).value = name; el(side).dispatchEvent(new Event("change")); };
  const value = name => el("value-" + name).textContent;
  const state = () => ({over: el("over").style.transform, under: el("under").style.transform,
                        clip: el("clip").style.clipPath, place: el("place").textContent});
  report.visible = !el("compare").hidden;
  report.loaded = [...document.images].every(image => image.complete && image.naturalWidth !== 0);
  choose("left", "gradient.triangulated");
  choose("right", "gradient.ward-heckbert.difference");
  report.over = el("over").src === document.querySelector('figure[data-name="gradient.triangulated"] img').src;
  report.under = el("under").src ===
      document.querySelector('figure[data-name="gradient.ward-heckbert.difference"] img').src;
  point(3, 5);
  report.x = value("triangulated.gradient.x");
  report.exact = value("gradient.x");
  report.error = value("triangulated.error.gradient");
  report.other = value("ward-heckbert.gradient.y");
  report.shown = [...document.querySelectorAll("dd")].filter(dd => !dd.hidden).map(dd => dd.id);
  report.drawn = [...document.querySelectorAll("dd")].filter(dd => dd.getClientRects().length !== 0).length;
  el("divide").value = 25;
  el("divide").dispatchEvent(new Event("input"));
  report.before = state();
  el("stage").dispatchEvent(new WheelEvent("wheel", {...at(3, 5), deltaY: -700}));
  point(3, 5);
  report.zoomed = state();
  point(15, 5);
  report.aside = state();
  el("stage").dispatchEvent(new KeyboardEvent("keydown", {key: "0", bubbles: true}));
  point(15, 5);
  report.whole = state();
  el("stage").dispatchEvent(new KeyboardEvent("keydown", {key: "ArrowLeft", bubbles: true}));
  report.stepped = state();
  const result = document.createElement("pre");
  result.id = "report";
  result.textContent = JSON.stringify(report);
  document.body.append(result);
});
)js";

std::string outputOf(const std::string& command) {
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  std::string output;
  std::array<char, 65536> buffer{};
  for (std::size_t count = 0; (count = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    output.append(buffer.data(), count);
  }
  pclose(pipe);
  return output;
}

/// Empty where there is none.
std::string browser() {
  for (const char* name : {"chromium-headless-shell", "chromium"}) {
    const std::string path = outputOf(std::string("command -v ") + name);
    if (!path.empty()) return name;
  }
  return "";
}

std::string unescaped(std::string text) {
  const std::array<std::pair<std::string, std::string>, 3> entities{{{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}}};
  for (const auto& [entity, character] : entities) {
    for (std::size_t at = text.find(entity); at != std::string::npos; at = text.find(entity, at + 1)) {
      text.replace(at, entity.size(), character);
    }
  }
  return text;
}

/// What kReader reports of a page, and what is in the maps beside it.
class FigureInBrowser : public testing::Test {
 protected:
  void SetUp() override {
    const std::string program = browser();
    if (program.empty()) {
      GTEST_SKIP() << "no headless browser: install Debian's chromium-headless-shell for this test";
    }
    FigureScene scene{"lamp.json", kScene, parseScene(kScene)};
    const ReceiverGrid grid = *scene.scene.grid;
    const SampledFigure figure = sampledFigure(analyticFigure(std::move(scene), grid, 2), figurePlan(64, 1),
                                               {"ward-heckbert", "triangulated"}, 2, nullptr);
    {
      ResultFolder folder(scratch_.file("out"), "figure");
      writeFigure(figure, {}, folder);
      folder.commit();
    }
    maps_ = readExr(readFile(scratch_.file("out") / "maps.exr"));
    std::string page = readFile(scratch_.file("out") / "index.html");
    page.insert(page.find("</body>"), std::string("<script>") + kReader + "</script>\n");
    writeFile(scratch_.file("read.html"), page);
    const std::string dom = outputOf(program + " --headless --no-sandbox --disable-gpu --window-size=1000,800" +
                                     " --user-data-dir=" + scratch_.file("profile").string() + " --dump-dom file://" +
                                     scratch_.file("read.html").string() + " 2>/dev/null");
    const std::string begin = "<pre id=\"report\">";
    const std::size_t at = dom.find(begin);
    ASSERT_NE(at, std::string::npos) << "the page's script did not come to its end";
    const std::size_t start = at + begin.size();
    report_ = Json::parse(unescaped(dom.substr(start, dom.find("</pre>", start) - start)));
  }

  /// As the page writes it.
  std::string shown(const std::string& channel, std::size_t i, std::size_t j) const {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.5g", static_cast<double>(maps_.channels.at(channel).at(j * 16 + i)));
    return text.data();
  }

  ScratchFolder scratch_;
  ReadExr maps_;
  Json report_;
};

TEST_F(FigureInBrowser, ComparesAnyTwoColumns) {
  EXPECT_TRUE(report_.at("visible").get<bool>());
  EXPECT_TRUE(report_.at("loaded").get<bool>());
  EXPECT_TRUE(report_.at("over").get<bool>());
  EXPECT_TRUE(report_.at("under").get<bool>());
  EXPECT_THAT(report_.at("before").at("clip").get<std::string>(), testing::HasSubstr("75%"));
}

TEST_F(FigureInBrowser, TellsValueAndErrorUnderThePointer) {
  const auto number = [&](const char* key) { return std::stod(report_.at(key).get<std::string>()); };
  // Trailing zeros aside, five digits each.
  EXPECT_EQ(number("x"), std::stod(shown("triangulated.gradient.x", 3, 5)));
  EXPECT_EQ(number("exact"), std::stod(shown("gradient.x", 3, 5)));
  EXPECT_EQ(number("error"), std::stod(shown("triangulated.error.gradient", 3, 5)));
  EXPECT_EQ(number("other"), std::stod(shown("ward-heckbert.gradient.y", 3, 5)));
  const std::vector<std::string> expected{"value-gradient.x",
                                          "value-gradient.y",
                                          "value-triangulated.gradient.x",
                                          "value-triangulated.gradient.y",
                                          "value-triangulated.error.gradient",
                                          "value-ward-heckbert.gradient.x",
                                          "value-ward-heckbert.gradient.y",
                                          "value-ward-heckbert.error.gradient"};
  EXPECT_THAT(report_.at("shown").get<std::vector<std::string>>(), testing::UnorderedElementsAreArray(expected));
  EXPECT_EQ(report_.at("drawn").get<std::size_t>(), expected.size()) << "hidden is hidden";
}

TEST_F(FigureInBrowser, ZoomsBothPicturesAboutThePointer) {
  const Json& before = report_.at("before");
  const Json& zoomed = report_.at("zoomed");
  EXPECT_EQ(zoomed.at("over"), zoomed.at("under"));
  EXPECT_NE(zoomed.at("over"), before.at("over"));
  EXPECT_THAT(zoomed.at("over").get<std::string>(), testing::HasSubstr("scale(4.05"));  // exp(1.4)
  EXPECT_EQ(zoomed.at("place"), before.at("place")) << "what is under the pointer stays there";
  EXPECT_EQ(zoomed.at("clip"), before.at("clip")) << "and so does the slider";
  // Twelve cells to the right of the pointer on the screen are three in the picture: 3.5 + 12 / 4.055 = 6.46.
  EXPECT_THAT(report_.at("aside").at("place").get<std::string>(), testing::HasSubstr("(0.4063, 0.6563,"));
  EXPECT_EQ(report_.at("whole").at("over"), before.at("over"));
  EXPECT_THAT(report_.at("whole").at("place").get<std::string>(), testing::HasSubstr("(0.9688, 0.6563,"));
  EXPECT_THAT(report_.at("stepped").at("place").get<std::string>(), testing::HasSubstr("(0.9063, 0.6563,"));
}

}  // namespace
}  // namespace irradiff
