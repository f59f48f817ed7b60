#include "experiments/figures/analytic_page.h"

#include "experiments/figures/figure_page.h"
#include "verification/report/bar_chart.h"
#include "verification/report/html.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>

namespace irradiff {
namespace {

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
  return element("p",
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

std::string analyticPage(const AnalyticFigure& figure, const RunRecord& record,
                         const std::vector<MapPicture>& pictures) {
  FigurePageContent content;
  content.title = "Figure 5, the analytic part";
  content.introduction = introduction(figure, record);
  content.grid = figure.map.grid;
  content.values = figure.map.channels;
  for (const MapPicture& picture : pictures) {
    content.pictures.push_back({picture, {}, ""});
  }
  content.left = "E";
  content.right = "eigenvalues";
  content.appendix = element("section", gapFillingSection(figure.map));
  content.files =
      "<a href=\"maps.exr\">maps.exr</a>: all channels as 32-bit floats, the scene in its header; a .png for each "
      "picture; <a href=\"run.json\">run.json</a>: how this was made.";
  return figurePage(content);
}

}  // namespace irradiff
