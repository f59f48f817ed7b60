#include "experiments/figures/figure_page.h"

#include "derivatives/scene/number_text.h"
#include "experiments/figures/figure_page_script.h"
#include "experiments/figures/figure_page_style.h"
#include "experiments/io/base64.h"
#include "experiments/io/png_file.h"
#include "verification/report/html.h"
#include "verification/report/page_style.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace irradiff {
namespace {

/// Little-endian single precision, as browsers' machines have it.
std::string floatBytes(const std::vector<double>& values) {
  std::string bytes;
  bytes.reserve(4 * values.size());
  for (const double value : values) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    for (unsigned shift = 0; shift < 32; shift += 8) {
      bytes += static_cast<char>((bits >> shift) & 0xffU);
    }
  }
  return bytes;
}

/// The receivers nearest to the middles of columns x rows equal parts of the map.
std::vector<double> sampled(const MapChannel& channel, const ReceiverGrid& grid, std::size_t columns,
                            std::size_t rows) {
  const auto place = [](std::size_t index, std::size_t count, std::size_t all) {
    return (2 * index + 1) * all / (2 * count);
  };
  std::vector<double> values;
  values.reserve(columns * rows);
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      values.push_back(channel.values[place(j, rows, grid.height) * grid.width + place(i, columns, grid.width)]);
    }
  }
  return values;
}

std::string mapData(const FigurePageContent& content) {
  const ReceiverGrid& grid = content.grid;
  const std::size_t columns = std::min(grid.width, kPageValues);
  const std::size_t rows = std::min(grid.height, kPageValues);
  const auto array = [](const Eigen::Vector3d& vector) { return std::array{vector.x(), vector.y(), vector.z()}; };
  nlohmann::ordered_json data = {{"width", grid.width}, {"height", grid.height},        {"columns", columns},
                                 {"rows", rows},        {"origin", array(grid.origin)}, {"u", array(grid.u)},
                                 {"v", array(grid.v)},  {"left", content.left},         {"right", content.right}};
  for (const MapChannel& channel : content.values) {
    data["channels"].push_back({{"name", channel.name},
                                {"unit", unitText(channel.unit)},
                                {"values", base64(floatBytes(sampled(channel, grid, columns, rows)))}});
  }
  return data.dump();
}

std::string hexColour(const Rgb& colour) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", static_cast<unsigned>(colour.red),
                static_cast<unsigned>(colour.green), static_cast<unsigned>(colour.blue));
  return text.data();
}

std::string barHtml(const ColourBar& bar, const std::string& unit) {
  std::string stops;
  const bool is_flag = bar.colours.size() == 2;
  for (std::size_t i = 0; i < bar.colours.size(); ++i) {
    stops += ", " + hexColour(bar.colours[i]) + (is_flag ? (i == 0 ? " 0 50%" : " 50% 100%") : "");
  }
  const auto tick = [&](double value) {
    return element("span", numberText(value) + (unit.empty() ? "" : ' ' + unitText(unit)));
  };
  const std::string middle = is_flag ? "" : tick(0.5 * (bar.low + bar.high));
  return element("div",
                 (bar.label.empty() ? "" : element("div", escaped(bar.label), "class=\"soft\"")) +
                     element("div", "", "class=\"bar\" style=\"background: linear-gradient(to right" + stops + ")\"") +
                     element("div", tick(bar.low) + middle + tick(bar.high), "class=\"ticks\""),
                 "class=\"scale\"") +
         '\n';
}

std::string compareSection(const std::vector<MapChannel>& channels) {
  std::string values;
  for (const MapChannel& channel : channels) {
    values += element("dt", escaped(channel.name)) + element("dd", "", "id=\"value-" + escaped(channel.name) + '"');
  }
  const std::string choices = element("label", "Left: " + element("select", "", "id=\"left\"")) +
                              element("label", "Right: " + element("select", "", "id=\"right\""));
  const std::string stage =
      "<img id=\"under\" alt=\"the picture on the right\" draggable=\"false\">" +
      element("div", "<img id=\"over\" alt=\"the picture on the left\" draggable=\"false\">", "id=\"clip\"") +
      element("div", "", "id=\"divider\"") + element("div", "", "id=\"cross\"");
  const std::string slider =
      "<input type=\"range\" id=\"divide\" min=\"0\" max=\"100\" value=\"50\" "
      "aria-label=\"where the left picture ends\">";
  const std::string tools = element("button", "&minus;", "id=\"farther\" aria-label=\"show more\"") +
                            element("output", "", "id=\"scale\" aria-label=\"enlargement\"") +
                            element("button", "+", "id=\"nearer\" aria-label=\"enlarge\"") +
                            element("button", "Whole", "id=\"whole\"");
  const std::string scales = element("div", "", "id=\"scale-left\"") + element("div", "", "id=\"scale-right\"");
  const std::string pictures =
      element("div", stage,
              "id=\"stage\" tabindex=\"0\" role=\"application\" "
              "aria-label=\"the two pictures; arrow keys move the receiver, + and - zoom, 0 shows all\"") +
      slider + element("div", tools, "class=\"tools\"") + element("div", scales, "class=\"scales\"");
  const std::string readings =
      element("p", "", "id=\"place\" class=\"soft\"") + element("dl", values, "aria-live=\"polite\"");
  return element("h2", "Compare") + element("div", choices, "class=\"choices\"") +
         element("div", element("div", pictures) + element("div", readings), "class=\"compared\"") +
         element("p",
                 "The wheel or the buttons enlarge both pictures, dragging moves both. Move over them, or touch them, "
                 "for the values there (with the keyboard: arrows, +, &minus; and 0): single precision, of every "
                 "receiver or, on a large map, of those in the middles of " +
                     std::to_string(kPageValues) + " x " + std::to_string(kPageValues) +
                     " parts. maps.exr has all of them.",
                 "class=\"soft\"");
}

}  // namespace

std::string unitText(const std::string& unit) {
  const std::size_t power = unit.find('^');
  if (power == std::string::npos) {
    return unit;
  }
  const std::string digit = unit.substr(power + 1);
  return unit.substr(0, power) + (digit == "2"   ? "\u00b2"
                                  : digit == "3" ? "\u00b3"
                                  : digit == "4" ? "\u2074"
                                                 : '^' + digit);
}

std::string pictureHtml(const PagePicture& shown) {
  const MapPicture& picture = shown.picture;
  std::string content = "<img src=\"data:image/png;base64," + base64(pngFile(picture.image)) + "\" alt=\"" +
                        escaped("map of " + picture.title) + "\">\n";
  for (const ColourBar& bar : picture.bars) {
    content += barHtml(bar, picture.unit);
  }
  content += element("figcaption", element("strong", escaped(picture.name)) + ": " + escaped(picture.title) + ". " +
                                       escaped(picture.scaling) + escaped(shown.note));
  std::string attributes = "data-name=\"" + escaped(picture.name) + '"';
  if (!shown.values.empty()) {
    std::string names;
    for (const std::string& name : shown.values) {
      names += (names.empty() ? "" : " ") + name;
    }
    attributes += " data-values=\"" + escaped(names) + '"';
  }
  return element("figure", content, attributes) + '\n';
}

std::string figurePage(const FigurePageContent& content) {
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  page += element("title", "irradiff: " + escaped(content.title)) + '\n';
  page += element("style", std::string(kPageStyle) + std::string(kFigurePageStyle)) + "\n</head>\n<body>\n";
  page += element("h1", escaped(content.title)) + content.introduction + '\n';
  page += element("section", compareSection(content.values), "id=\"compare\" class=\"screen\" hidden") + '\n';
  page += content.results + '\n';
  page += element("h2", "Pictures") + '\n';
  page += element("p",
                  "x runs to the right, y upwards, as the sides of the grid do. Grey (black where several channels "
                  "share a picture) is where a quantity does not exist; it is NaN in maps.exr.") +
          '\n';
  std::string all;
  for (const PagePicture& picture : content.pictures) {
    all += pictureHtml(picture);
  }
  page += element("div", '\n' + all, "class=\"pictures\"") + '\n';
  page += content.appendix + '\n';
  page += element("h2", "Files") + '\n' + element("p", content.files) + '\n';
  page += element("script", mapData(content), "type=\"application/json\" id=\"map-data\"") + '\n';
  page += element("script", kFigurePageScript) + "\n</body>\n</html>\n";
  return page;
}

}  // namespace irradiff
