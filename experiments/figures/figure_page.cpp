#include "experiments/figures/figure_page.h"

#include "derivatives/scene/number_text.h"
#include "experiments/figures/figure_page_script.h"
#include "experiments/figures/figure_page_style.h"
#include "experiments/io/base64.h"
#include "experiments/io/png_file.h"
#include "verification/report/bar_chart.h"
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

/// "W/m^2" with a raised digit, in UTF-8.
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

std::string mapData(const DerivativeMap& map) {
  const ReceiverGrid& grid = map.grid;
  const std::size_t columns = std::min(grid.width, kPageValues);
  const std::size_t rows = std::min(grid.height, kPageValues);
  const auto array = [](const Eigen::Vector3d& vector) { return std::array{vector.x(), vector.y(), vector.z()}; };
  nlohmann::ordered_json data = {{"width", grid.width}, {"height", grid.height},        {"columns", columns},
                                 {"rows", rows},        {"origin", array(grid.origin)}, {"u", array(grid.u)},
                                 {"v", array(grid.v)}};
  for (const MapChannel& channel : map.channels) {
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
  return (bar.label.empty() ? "" : element("div", escaped(bar.label), "class=\"soft\"")) +
         element("div", "", "class=\"bar\" style=\"background: linear-gradient(to right" + stops + ")\"") +
         element("div", tick(bar.low) + middle + tick(bar.high), "class=\"ticks\"") + '\n';
}

std::string pictureHtml(const MapPicture& picture) {
  std::string content = "<img src=\"data:image/png;base64," + base64(pngFile(picture.image)) + "\" alt=\"" +
                        escaped("map of " + picture.title) + "\">\n";
  for (const ColourBar& bar : picture.bars) {
    content += barHtml(bar, picture.unit);
  }
  content += element("figcaption", element("strong", escaped(picture.name)) + ": " + escaped(picture.title) + ". " +
                                       escaped(picture.scaling));
  return element("figure", content, "data-name=\"" + escaped(picture.name) + '"') + '\n';
}

std::string compareSection(const DerivativeMap& map) {
  std::string values;
  for (const MapChannel& channel : map.channels) {
    values += element("dt", escaped(channel.name)) + element("dd", "", "id=\"value-" + escaped(channel.name) + '"');
  }
  const std::string choices = element("label", "Left: " + element("select", "", "id=\"left\"")) +
                              element("label", "Right: " + element("select", "", "id=\"right\""));
  const std::string stage =
      "<img id=\"under\" alt=\"the picture on the right\"><img id=\"over\" alt=\"the picture on the left\">" +
      element("div", "", "id=\"divider\"") + element("div", "", "id=\"cross\"");
  return element("h2", "Compare") + element("div", choices, "class=\"choices\"") +
         element("div",
                 element("div", element("div", stage,
                                        "id=\"stage\" tabindex=\"0\" role=\"application\" "
                                        "aria-label=\"the two pictures; arrow keys move the receiver\"") +
                                    "<input type=\"range\" id=\"divide\" min=\"0\" max=\"100\" value=\"50\" "
                                    "aria-label=\"where the left picture ends\">") +
                     element("div", element("p", "", "id=\"place\" class=\"soft\"") + element("dl", values)),
                 "class=\"compared\"") +
         element("p",
                 "Move over the picture, or touch it, for the values there: single precision, of every receiver or, on "
                 "a large "
                 "map, of those in the middles of " +
                     std::to_string(kPageValues) + " x " + std::to_string(kPageValues) +
                     " parts. maps.exr has all of them.",
                 "class=\"soft\"");
}

/// A sentence on the largest error of a quantity anywhere.
std::string boundText(const DerivativeMap& map, const char* name, const std::string& quantity) {
  const MapChannel& channel = map.channel(name);
  double largest = 0.0;
  bool exists = false;
  for (const double value : channel.values) {
    exists = exists || !std::isnan(value);
    largest = std::isnan(value) ? largest : std::max(largest, value);
  }
  if (!exists) {
    return quantity + " exists at none of them. ";
  }
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%.1e", largest);
  return quantity + " is off by at most " + text.data() + ' ' + unitText(channel.unit) + ". ";
}

std::string introduction(const AnalyticFigure& figure, const RunRecord& record) {
  const ReceiverGrid& grid = figure.map.grid;
  const auto events = std::ranges::count(figure.map.channel("event").values, 1.0);
  return element("h1", "Figure 5, the analytic part") +
         element("p",
                 "Irradiance over a plane with its gradient and its Hessian, computed exactly from what each receiver "
                 "sees: "
                 "the truth that estimators from hemisphere samples are measured against.") +
         element("p", element("strong", escaped(figure.scene.name)) + ": " + escaped(figure.scene.scene.description)) +
         element("p",
                 std::to_string(grid.width) + " x " + std::to_string(grid.height) + " receivers; at " +
                     std::to_string(events) +
                     " of them a visibility event passes on the way to a neighbour, and there the Hessian jumps. " +
                     boundText(figure.map, "bound.E", "E") + boundText(figure.map, "bound.gradient", "The gradient") +
                     boundText(figure.map, "bound.tangential_hessian", "The tangential Hessian") +
                     boundText(figure.map, "bound.hessian", "The Hessian in space")) +
         element("p",
                 "irradiff " + escaped(record.version) + ", " + escaped(record.date) + ", " + escaped(record.compiler) +
                     ", " + escaped(record.machine),
                 "class=\"soft\"");
}

std::string lossText(double loss) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%.2g", loss);
  return text.data();
}

/// How the losses by gap filling are distributed over the receivers: a bar for each decade.
std::string gapFillingSection(const DerivativeMap& map) {
  constexpr int kFirstDecade = -6;
  constexpr int kLastDecade = 0;
  std::array<std::size_t, kLastDecade - kFirstDecade + 2> counts{};  // the first for what is less, 0 included
  std::vector<double> losses;
  for (const double loss : map.channel("gap.hessian").values) {
    if (std::isnan(loss)) continue;
    losses.push_back(loss);
    const double decade = loss > 0.0 ? std::floor(std::log10(loss)) : kFirstDecade - 1.0;
    const int bar = static_cast<int>(std::clamp<double>(decade, kFirstDecade - 1, kLastDecade)) - (kFirstDecade - 1);
    ++counts[static_cast<std::size_t>(bar)];
  }
  const std::string heading = element("h2", "What filling gaps loses of the Hessian");
  if (losses.empty()) return heading + element("p", "The Hessian in space exists at none of the receivers.");
  std::ranges::sort(losses);
  const auto shareText = [&](std::size_t count) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%.1f %%",
                  100.0 * static_cast<double>(count) / static_cast<double>(losses.size()));
    return std::string(text.data());
  };
  const auto above = [&](double limit) {
    return static_cast<std::size_t>(losses.end() - std::ranges::upper_bound(losses, limit));
  };
  std::vector<Bar> bars;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::string label = i == 0 ? "less" : "10^" + std::to_string(kFirstDecade + static_cast<int>(i) - 1);
    bars.push_back({label, static_cast<double>(counts[i]), shareText(counts[i])});
  }
  return heading +
         element("p",
                 "The paper's section 4.1 fills the gaps behind silhouettes. That keeps E and its gradient, and loses "
                 "the motion of the places where one edge passes behind another: more than a tenth of the Hessian at " +
                     shareText(above(0.1)) + " of the receivers, more than a hundredth at " + shareText(above(0.01)) +
                     ", at most " + lossText(losses.back()) + " of it.") +
         barChart(bars, "receivers by loss") +
         element("p", "Receivers by max|dH|/max|H|: each bar from its power of ten to the next.", "class=\"soft\"");
}

}  // namespace

std::string figurePage(const AnalyticFigure& figure, const RunRecord& record, const std::vector<MapPicture>& pictures) {
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  page += element("title", "irradiff: Figure 5, the analytic part") + '\n';
  page += element("style", std::string(kPageStyle) + std::string(kFigurePageStyle)) + "\n</head>\n<body>\n";
  page += introduction(figure, record) + '\n';
  page += element("section", compareSection(figure.map), "id=\"compare\" class=\"screen\" hidden") + '\n';
  page += element("h2", "Pictures") + '\n';
  page +=
      element("p",
              "x runs to the right, y upwards, as the sides of the grid do. Grey (black where several channels share a "
              "picture) is where a quantity does not exist; it is NaN in maps.exr.") +
      '\n';
  std::string all;
  for (const MapPicture& picture : pictures) {
    all += pictureHtml(picture);
  }
  page += element("div", '\n' + all, "class=\"pictures\"") + '\n';
  page += element("section", gapFillingSection(figure.map)) + '\n';
  page += element("h2", "Files") + '\n';
  page +=
      element("p",
              "<a href=\"maps.exr\">maps.exr</a>: all channels as 32-bit floats, the scene in its header; a .png for "
              "each picture; <a href=\"run.json\">run.json</a>: how this was made.") +
      '\n';
  page += element("script", mapData(figure.map), "type=\"application/json\" id=\"map-data\"") + '\n';
  page += element("script", kFigurePageScript) + "\n</body>\n</html>\n";
  return page;
}

}  // namespace irradiff
