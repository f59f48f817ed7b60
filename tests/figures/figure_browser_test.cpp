// The page of Figure 5 in a headless browser: choosing, pointing and enlarging as a reader does. What is looked at is
// written into a copy of the page, by a script that acts like a reader; what it found is compared with maps.exr.

#include "experiments/figures/sampled_figure.h"
#include "experiments/io/scene_file.h"
#include "tests/cli/program_run.h"
#include "tests/io/image_reading.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

using Json = nlohmann::json;
using testing::Contains;
using testing::IsEmpty;

constexpr std::size_t kCells = 16;  // along each side of the map
constexpr const char* kScene =
    R"({"format": "irradiff-scene", "version": 1, "dimension": 3, "description": "A lamp behind a screen.",
    "polygons": [{"name": "lamp", "radiance": 2.5, "vertices": [[0.1,0.2,1], [0.9,0.3,1], [0.8,0.7,1], [0.2,0.9,1]]},
                 {"name": "screen", "radiance": 0, "vertices": [[0.3,0.3,0.5], [0.6,0.3,0.5], [0.6,0.7,0.5]]}],
    "grid": {"origin": [0,0,0], "u": [1,0,0], "v": [0,1,0], "resolution": [16,16], "normal": [0,0,1]}})";

constexpr const char* kLeft = "gradient.triangulated";
constexpr const char* kRight = "gradient.ward-heckbert.difference";

/// What both scripts begin with. at(i, j) is the middle of a cell of the stage, counted from the upper left; events go
/// to what is on top there.
constexpr const char* kHands = R"js(
const el = id => document.getElementById(id);
const box = () => el("stage").getBoundingClientRect();
const at = (i, j) => ({clientX: box().left + (i + 0.5) / 16 * box().width,
                       clientY: box().top + (j + 0.5) / 16 * box().height, bubbles: true, cancelable: true});
const send = event => (document.elementFromPoint(event.clientX, event.clientY).dispatchEvent(event), event);
const point = (i, j, more) => send(new PointerEvent("pointermove", {...at(i, j), ...more}));
const hold = (i, j) => send(new PointerEvent("pointerdown", {...at(i, j), buttons: 1}));
const turn = (i, j, amount) => send(new WheelEvent("wheel", {...at(i, j), deltaY: amount}));
const press = (key, more) => {
  const event = new KeyboardEvent("keydown", {key, bubbles: true, cancelable: true, ...more});
  el("stage").dispatchEvent(event);
  return event.defaultPrevented;
};
const choose = (side, name) => { el(side).value = name; el(side).dispatchEvent(new Event("change")); };
const divideAt = share => { el("divide").value = share; el("divide").dispatchEvent(new Event("input")); };
)js";

constexpr const char* kReader = R"js(
window.addEventListener("load", () => {
  const report = {};
  el("stage").scrollIntoView();
  const value = name => el("value-" + name).textContent;
  const mark = () => {
    const cross = el("cross").getBoundingClientRect();
    return [(cross.left + cross.right) / 2 - box().left, (cross.top + cross.bottom) / 2 - box().top];
  };
  const state = () => ({over: el("over").style.transform, under: el("under").style.transform,
                        clip: el("clip").style.clipPath, place: el("place").textContent, mark: mark(),
                        scale: el("scale").textContent});
  const pictureOf = name => document.querySelector(`figure[data-name="${name}"] img`).src;
  report.visible = !el("compare").hidden;
  report.loaded = [...document.images].every(image => image.complete && image.naturalWidth !== 0);
  report.fetched = performance.getEntriesByType("resource").map(entry => entry.name)
    .filter(name => !name.startsWith("data:"));
  report.choices = [...el("left").options].map(option => option.value);
  report.limits = {};
  for (const figure of document.querySelectorAll("figure[data-name]")) {
    report.limits[figure.dataset.name] = [...figure.querySelectorAll(".ticks")].map(ticks => ticks.textContent);
  }
  choose("left", "gradient.triangulated");
  choose("right", "gradient.ward-heckbert.difference");
  report.over = el("over").src === pictureOf("gradient.triangulated");
  report.under = el("under").src === pictureOf("gradient.ward-heckbert.difference");
  report.scales = ["left", "right"].map(side =>
    [...el("scale-" + side).querySelectorAll(".ticks")].map(ticks => ticks.textContent));
  point(3, 5);
  report.values = {};
  for (const dd of document.querySelectorAll("dd")) {
    if (dd.getClientRects().length !== 0) report.values[dd.id] = dd.textContent;
  }
  divideAt(25);
  report.before = state();
  report.scrolls = !turn(3, 5, 100).defaultPrevented;
  report.enlarges = turn(3, 5, -700).defaultPrevented;
  point(3, 5);
  report.enlarged = state();
  point(15, 5);
  report.aside = state();
  hold(9, 8);
  report.held = state();
  point(6, 7, {buttons: 1});
  point(6, 7);
  report.dragged = state();
  for (let i = 0; i !== 12; ++i) press("ArrowUp");
  report.followed = state();
  report.size = [box().width, box().height];
  report.leaves = !press("0", {ctrlKey: true}) && state().over === report.followed.over;
  report.uses = press("0");
  point(15, 5);
  report.whole = state();
  press("ArrowLeft");
  report.stepped = state();
  el("nearer").click();
  report.nearer = state();
  el("farther").click();
  report.farther = state();
  const result = document.createElement("pre");
  result.id = "report";
  result.textContent = JSON.stringify(report);
  document.body.append(result);
});
)js";

/// Leaves nothing but the stage, 320 pixels wide in the upper left corner, enlarged four times about that corner: each
/// cell is 80 pixels wide, and the slider ends the left picture between the first and the second.
constexpr const char* kPose = R"js(
document.head.insertAdjacentHTML("beforeend",
  "<style>#stage{position:fixed;left:0;top:0;width:320px;border:0;z-index:9} #cross,#divider{display:none}</style>");
window.addEventListener("load", () => {
  choose("left", "gradient.triangulated");
  choose("right", "gradient.ward-heckbert.difference");
  divideAt(25);
  turn(-0.5, -0.5, -500 * Math.log(4));
});
)js";
constexpr std::size_t kPosedCell = 80;

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
  for (const char* name : {"chromium-headless-shell", "chromium", "google-chrome"}) {
    if (!outputOf(std::string("command -v ") + name).empty()) return name;
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

/// Throws std::runtime_error where there is nothing to replace: a twin that is not broken would prove nothing.
std::string replaced(std::string text, const std::string& part, const std::string& other) {
  const std::size_t at = text.find(part);
  if (at == std::string::npos) throw std::runtime_error("the page has no " + part);
  return text.replace(at, part.size(), other);
}

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t at = text.find(begin);
  if (at == std::string::npos) return "";
  const std::size_t start = at + begin.size();
  return text.substr(start, text.find(end, start) - start);
}

/// A figure in a folder, and a browser that looks at copies of its page.
class Visitor {
 public:
  Visitor() : program_(browser()) {
    if (program_.empty()) return;
    FigureScene scene{"lamp.json", kScene, parseScene(kScene)};
    const ReceiverGrid grid = *scene.scene.grid;
    AnalyticFigure exact = analyticFigure(std::move(scene), grid, 2);
    ResultFolder exact_folder(scratch_.file("exact"), "figure");
    writeFigure(exact, {}, exact_folder);
    exact_folder.commit();
    exact_page = readFile(scratch_.file("exact") / "index.html");
    const SampledFigure figure =
        sampledFigure(std::move(exact), figurePlan(64, 1), {"ward-heckbert", "triangulated"}, 2, nullptr);
    ResultFolder folder(scratch_.file("out"), "figure");
    writeFigure(figure, {}, folder);
    folder.commit();
    maps = readExr(readFile(scratch_.file("out") / "maps.exr"));
    page = readFile(scratch_.file("out") / "index.html");
  }

  bool hasBrowser() const { return !program_.empty(); }

  /// What a script leaves in the element `report`; empty where it does not come to its end.
  std::string report(const std::string& shown_page, const std::string& script) const {
    return unescaped(between(open(shown_page, script, "--dump-dom"), "<pre id=\"report\">", "</pre>"));
  }
  /// What the browser told its console.
  std::string console() const {
    std::string lines;
    const std::string log = readFile(scratch_.file("log"));
    for (std::size_t at = 0; at < log.size();) {
      const std::size_t end = std::min(log.find('\n', at), log.size());
      const std::string line = log.substr(at, end - at);
      if (line.find(":CONSOLE") != std::string::npos) lines += line + '\n';
      at = end + 1;
    }
    return lines;
  }
  RgbImage drawn(const std::string& shown_page) const {
    open(shown_page, kPose, "--hide-scrollbars --screenshot=" + scratch_.file("drawn.png").string());
    return readPng(readFile(scratch_.file("drawn.png")));
  }

  float value(const std::string& channel, std::size_t i, std::size_t j) const {
    return maps.channels.at(channel).at(j * kCells + i);
  }
  RgbImage picture(const std::string& name) const {
    const std::string figure = between(page, "<figure data-name=\"" + name + '"', "</figure>");
    return readPng(bytesOfBase64(between(figure, "base64,", "\"")));
  }

  ReadExr maps;
  std::string page;
  std::string exact_page;  ///< of the exact maps alone

 private:
  std::string open(const std::string& shown_page, const std::string& script, const std::string& result) const {
    writeFile(scratch_.file("read.html"),
              replaced(shown_page, "</body>", std::string("<script>") + kHands + script + "</script>\n</body>"));
    // No name is found: what a page would take from a network is missing.
    return outputOf("timeout 60 " + program_ +
                    " --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --window-size=1000,1200 "
                    "--force-device-scale-factor=1 "
                    "--host-resolver-rules='MAP * ~NOTFOUND' --enable-logging=stderr --user-data-dir=" +
                    scratch_.file("profile").string() + ' ' + result + " file://" +
                    scratch_.file("read.html").string() + " 2>" + scratch_.file("log").string());
  }

  std::string program_;
  ScratchFolder scratch_;
};

/// The first number of a text, such as "0.123 W/m^3".
double numberOf(const Json& text) { return std::stod(text.get<std::string>()); }

/// As the page writes it: five digits.
double rounded(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.5g", value);
  return std::stod(text.data());
}

/// The relative error of the gradient by its definition. `owner` is the estimator and a point.
double relativeError(const Visitor& visitor, const std::string& owner, std::size_t i, std::size_t j) {
  double error = 0.0;
  double size = 0.0;
  for (const std::string component : {"gradient.x", "gradient.y"}) {
    const double truth = visitor.value(component, i, j);
    error = std::max(error, std::abs(visitor.value(owner + component, i, j) - truth));
    size = std::max(size, std::abs(truth));
  }
  return error / size;
}

/// Collects what does not hold, by name.
class Verdict {
 public:
  void check(bool holds, const std::string& name) {
    if (!holds) complaints.push_back(name);
  }
  std::vector<std::string> complaints;
};

void checkValues(const Json& report, const Visitor& visitor, Verdict& verdict) {
  const Json& values = report.at("values");
  std::set<std::string> expected{"value-gradient.x", "value-gradient.y"};
  for (const std::string component : {"gradient.x", "gradient.y"}) {
    for (const std::string owner : {"", "triangulated.", "ward-heckbert."}) {
      const std::string channel = owner + component;
      const std::string id = "value-" + channel;
      expected.insert(id);
      verdict.check(values.contains(id) && numberOf(values[id]) == rounded(visitor.value(channel, 3, 5)),
                    "values under the pointer");
    }
  }
  for (const std::string owner : {"triangulated.", "ward-heckbert."}) {
    const std::string id = "value-" + owner + "error.gradient";
    expected.insert(id);
    // Five digits, of values in single precision.
    const double error = relativeError(visitor, owner, 3, 5);
    verdict.check(values.contains(id) && std::abs(numberOf(values[id]) - error) <= 1e-4 * error,
                  "errors under the pointer");
  }
  std::set<std::string> shown;
  for (const auto& [id, value] : values.items()) shown.insert(id);
  verdict.check(shown == expected, "values of these two columns and no others");
}

void checkZoom(const Json& report, Verdict& verdict) {
  const Json& before = report.at("before");
  const Json& enlarged = report.at("enlarged");
  for (const char* state : {"enlarged", "dragged", "followed", "whole", "nearer", "farther"}) {
    verdict.check(report.at(state).at("over") == report.at(state).at("under"), "linked zoom");
  }
  verdict.check(enlarged.at("over") != before.at("over") && enlarged.at("scale") == "4.06 x", "the wheel enlarges");
  verdict.check(report.at("scrolls") && report.at("enlarges"), "the wheel scrolls where there is nothing to enlarge");
  verdict.check(enlarged.at("place") == before.at("place"), "what is under the pointer stays there");
  verdict.check(enlarged.at("clip") == before.at("clip"), "the slider stays");
  // Twelve cells to the right of the pointer on the screen are three in the picture: 3.5 + 12 / 4.055 = 6.46.
  const auto isAt = [&](const char* state, const char* place) {
    return report.at(state).at("place").get<std::string>().starts_with(std::string("At ") + place);
  };
  verdict.check(isAt("aside", "(0.4063, 0.6563,"), "values in the enlarged picture");
  verdict.check(report.at("held").at("place") == report.at("dragged").at("place") &&
                    report.at("held").at("over") != report.at("dragged").at("over"),
                "what is held stays under the pointer");
  const auto isInside = [&](std::size_t axis) {
    const double mark = report.at("followed").at("mark").at(axis);
    return mark >= 0 && mark <= report.at("size").at(axis);
  };
  verdict.check(isInside(0) && isInside(1) && report.at("followed").at("over") != report.at("dragged").at("over"),
                "the enlarged part follows the arrow keys");
  verdict.check(report.at("leaves") && report.at("uses"), "keys, but not those of the browser");
  verdict.check(report.at("whole").at("over") == before.at("over") && isAt("whole", "(0.9688, 0.6563,"), "0 shows all");
  verdict.check(isAt("stepped", "(0.9063, 0.6563,"), "arrow keys move by a receiver");
  verdict.check(report.at("nearer").at("scale") == "1.50 x" && report.at("farther").at("over") == before.at("over"),
                "buttons enlarge and reduce");
  const auto shift = [&](std::size_t axis) {
    return std::abs(report.at("nearer").at("mark").at(axis).get<double>() -
                    report.at("stepped").at("mark").at(axis).get<double>());
  };
  verdict.check(shift(0) < 0.1 && shift(1) < 0.1, "buttons enlarge about the place");
}

/// What is wrong with a page. Throws nothing: what cannot be read is a complaint.
std::vector<std::string> complaints(const Visitor& visitor, const std::string& page) {
  Verdict verdict;
  const std::string text = visitor.report(page, kReader);
  verdict.check(visitor.console().empty(), "silent console");
  if (text.empty()) {
    verdict.check(false, "the scripts come to their end");
    return verdict.complaints;
  }
  const Json report = Json::parse(text);
  verdict.check(report.at("visible") && report.at("loaded"), "pictures load");
  verdict.check(report.at("fetched").empty(), "nothing from elsewhere");
  verdict.check(report.at("choices").size() == report.at("limits").size() && report.at("choices").size() >= 8,
                "every picture can be chosen");
  verdict.check(report.at("over") && report.at("under"), "the chosen pictures are shown");
  verdict.check(report.at("before").at("clip") == "inset(0px 75% 0px 0px)", "the slider splits");
  std::map<std::string, std::set<Json>> limits;
  for (const auto& [name, ticks] : report.at("limits").items()) limits[name.substr(0, name.find('.'))].insert(ticks);
  for (const auto& [quantity, different] : limits) verdict.check(different.size() == 1, "the same exposure for all");
  verdict.check(report.at("scales").at(0) == report.at("limits").at(kLeft) &&
                    report.at("scales").at(1) == report.at("limits").at(kRight),
                "scales of the two pictures");
  checkValues(report, visitor, verdict);
  checkZoom(report, verdict);
  return verdict.complaints;
}

/// Of the cells that kPose shows, those that are not drawn in one colour, that of the left picture in the first column
/// and of the right picture in the others.
std::size_t wrongCells(const Visitor& visitor, const std::string& page) {
  const RgbImage drawn = visitor.drawn(page);
  const RgbImage left = visitor.picture(kLeft);
  const RgbImage right = visitor.picture(kRight);
  std::size_t wrong = 0;
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 4; ++i) {
      const Rgb& expected = (i == 0 ? left : right).at(i, j);
      bool is_right = true;
      // The very border between two cells may be blended.
      for (std::size_t y = 2; y < kPosedCell - 2; ++y) {
        for (std::size_t x = 2; x < kPosedCell - 2; ++x) {
          is_right = is_right && drawn.at(i * kPosedCell + x, j * kPosedCell + y) == expected;
        }
      }
      wrong += is_right ? 0 : 1;
    }
  }
  return wrong;
}

class FigureInBrowser : public testing::Test {
 protected:
  static void SetUpTestSuite() { visitor_ = new Visitor; }
  static void TearDownTestSuite() {
    delete visitor_;
    visitor_ = nullptr;
  }
  void SetUp() override {
    if (!visitor_->hasBrowser()) {
      GTEST_SKIP() << "no headless browser: install Debian's chromium-headless-shell for this test";
    }
  }

  static Visitor* visitor_;
};
Visitor* FigureInBrowser::visitor_ = nullptr;

TEST_F(FigureInBrowser, ComparesColumnsWithLinkedZoomAndValues) {
  EXPECT_THAT(complaints(*visitor_, visitor_->page), IsEmpty());
}

// Of exact maps alone, there are no columns of estimators; all values are read with every picture.
TEST_F(FigureInBrowser, ReadsExactMaps) {
  constexpr const char* kGlance = R"js(
window.addEventListener("load", () => {
  el("stage").scrollIntoView();
  choose("right", "E");
  point(3, 5);
  const result = document.createElement("pre");
  result.id = "report";
  result.textContent = JSON.stringify([...document.querySelectorAll("dd")].map(dd => [dd.id, dd.textContent, dd.hidden]));
  document.body.append(result);
});
)js";
  const Json values = Json::parse(visitor_->report(visitor_->exact_page, kGlance));
  EXPECT_EQ(visitor_->console(), "");
  EXPECT_EQ(values.size(), 16U);
  for (const Json& value : values) {
    const std::string channel = value.at(0).get<std::string>().substr(std::string("value-").size());
    const float expected = visitor_->value(channel, 3, 5);
    const std::string text = value.at(1);
    EXPECT_FALSE(value.at(2).get<bool>()) << channel;
    if (channel == "event") {
      EXPECT_EQ(text, expected == 1.0F ? "yes" : "no");
    } else if (std::isnan(expected)) {
      EXPECT_EQ(text, "does not exist here") << channel;
    } else {
      EXPECT_EQ(numberOf(text), rounded(expected)) << channel;
    }
  }
}

TEST_F(FigureInBrowser, IsFoundBrokenWhereItIs) {
  struct Twin {
    const char* part;
    const char* other;
    const char* complaint;
  };
  const std::array twins{
      Twin{"Object.values(sides)", "[sides.left]", "linked zoom"},
      Twin{"zoom.left += x / zoom.scale", "zoom.left += 0.1 + x / zoom.scale", "what is under the pointer stays there"},
      Twin{"row * data.columns + column", "column * data.columns + row", "values under the pointer"},
      Twin{"atob(text), c =>", "atob(text).slice(8), c =>", "errors under the pointer"},
      Twin{"!isRead(channel.name)", "false", "values of these two columns and no others"},
      Twin{"class=\"ticks\"><span>-", "class=\"ticks\"><span>-9", "the same exposure for all"},
      Twin{"<h1>", "<img src=\"http://pictures.example/lamp.png\"><h1>", "pictures load"},
      Twin{"<style>", "<link rel=\"stylesheet\" href=\"http://pictures.example/a.css\"><style>",
           "nothing from elsewhere"},
      Twin{"byId(\"nearer\")", "byId(\"nowhere\")", "silent console"}};
  for (const Twin& twin : twins) {
    EXPECT_THAT(complaints(*visitor_, replaced(visitor_->page, twin.part, twin.other)), Contains(twin.complaint))
        << twin.part << " -> " << twin.other;
  }
}

TEST_F(FigureInBrowser, DrawsSharpCellsOfBothPictures) {
  EXPECT_EQ(wrongCells(*visitor_, visitor_->page), 0U);
  EXPECT_GE(wrongCells(*visitor_, replaced(visitor_->page, "byId(\"clip\").style.clipPath", "byId(\"clip\").title")),
            8U);
  EXPECT_GE(wrongCells(*visitor_,
                       replaced(visitor_->page, "image-rendering: pixelated; transform-origin", "transform-origin")),
            8U);
}

// Red is dE/dx, from 0 at minus the limit to 255 at the limit; it clips there.
TEST_F(FigureInBrowser, ExposesEveryPictureByTheSameLimit) {
  const auto differing = [&](const std::string& owner, double limit) {
    const RgbImage picture = visitor_->picture("gradient." + owner);
    const RgbImage difference = visitor_->picture("gradient." + owner + ".difference");
    const std::string channel = owner + ".gradient.x";
    const auto differs = [limit](const Rgb& colour, double shown) {
      return std::abs(colour.red - 127.5 * (1.0 + std::clamp(shown / limit, -1.0, 1.0))) > 0.51;
    };
    std::size_t count = 0;
    for (std::size_t j = 0; j < kCells; ++j) {
      for (std::size_t i = 0; i < kCells; ++i) {
        const double value = visitor_->value(channel, i, j);
        const double truth = visitor_->value("gradient.x", i, j);
        count += differs(picture.at(i, j), value) ? 1 : 0;
        count += differs(difference.at(i, j), value - truth) ? 1 : 0;
      }
    }
    return count;
  };
  const std::string figure = between(visitor_->page, "<figure data-name=\"gradient.analytic\"", "</figure>");
  const double limit = -std::stod(between(figure, "class=\"ticks\"><span>", " "));
  ASSERT_GT(limit, 0.0);
  for (const std::string owner : {"triangulated", "ward-heckbert"}) {
    EXPECT_EQ(differing(owner, limit), 0U) << owner;
    EXPECT_GE(differing(owner, 1.1 * limit), 100U) << owner;
  }
}

}  // namespace
}  // namespace irradiff
