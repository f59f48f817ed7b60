#include "experiments/figures/sampled_page.h"

#include "experiments/figures/figure_page.h"
#include "experiments/io/base64.h"
#include "verification/report/html.h"

#include <algorithm>

namespace irradiff {
namespace {

std::string errorText(const ErrorSummary& e) {
  return "median " + errorNumber(e.median) + ", RMS " + errorNumber(e.rms) + ", 99 % " + errorNumber(e.percentile99);
}

std::string introduction(const SampledFigure& figure, const RunRecord& record, const RgbImage& scene) {
  const ReceiverGrid& grid = figure.analytic.map.grid;
  const GridShape& shape = figure.plan.shape;
  return element("p",
                 "Irradiance gradient and Hessian over a plane as estimators have them from hemisphere samples, "
                 "against the exact ones: every estimator from the same " +
                     std::to_string(shape.size()) + " rays at a receiver, one jittered ray in each of " +
                     std::to_string(shape.rows) + " x " + std::to_string(shape.columns) + " concentric strata, seed " +
                     std::to_string(figure.plan.seed) + '.') +
         "<img src=\"data:image/png;base64," + base64(pngFile(scene)) +
         "\" alt=\"the scene, seen from aside\" style=\"max-width:100%\">" +
         element("p", element("strong", escaped(figure.analytic.scene.name)) + ": " +
                          escaped(figure.analytic.scene.scene.description)) +
         element("p", std::to_string(grid.width) + " x " + std::to_string(grid.height) +
                          " receivers. The pictures of a quantity, differences included, all have the same scale: "
                          "the truth's.") +
         element("p",
                 "irradiff " + escaped(record.version) + ", " + escaped(record.date) + ", " + escaped(record.compiler) +
                     ", " + escaped(record.machine),
                 "class=\"soft\"");
}

std::string errorSection(const std::vector<FigureColumn>& columns) {
  std::string rows = element("tr", element("th", "quantity") + element("th", "estimator") + element("th", "median") +
                                       element("th", "99 %") + element("th", "RMS") + element("th", "receivers") +
                                       element("th", "left out"));
  for (const FigureColumn& column : columns) {
    if (!column.errors) continue;
    const ErrorSummary& e = *column.errors;
    rows += element("tr", element("td", quantityOf(column.compared).name) + element("td", escaped(column.source)) +
                              element("td", errorNumber(e.median)) + element("td", errorNumber(e.percentile99)) +
                              element("td", errorNumber(e.rms)) + element("td", std::to_string(e.compared)) +
                              element("td", std::to_string(e.no_truth + e.zero_truth + e.no_estimate)));
  }
  return element("h2", "Errors") +
         element(
             "p",
             "The relative error at a receiver is max|estimate - truth| / max|truth| over the components: of the "
             "gradient along x and y, of the tangential Hessian, of the three eigenvalues. Median and 99 % are over "
             "the receivers; RMS is the root mean square of max|estimate - truth| over that of max|truth|. Left out "
             "are receivers where the truth does not exist or is 0 to within its own error bound.") +
         element("div", element("table", rows), "class=\"scroll\"");
}

}  // namespace

std::string sampledPage(const SampledFigure& figure, const RunRecord& record, const std::vector<FigureColumn>& columns,
                        const std::vector<MapChannel>& estimated, const RgbImage& scene) {
  FigurePageContent content;
  content.title = "Figure 5, estimators against the truth";
  content.introduction = introduction(figure, record, scene);
  content.grid = figure.analytic.map.grid;
  for (const FigureColumn& column : columns) {
    // Under the pointer an estimate stands beside the truth.
    std::vector<std::string> channels = column.channels;
    if (column.errors) {
      const auto& truth = quantityOf(column.compared).truth;
      channels.insert(channels.begin(), truth.begin(), truth.end());
    }
    const std::string note = column.errors ? " Error: " + errorText(*column.errors) + '.' : "";
    content.pictures.push_back({column.picture, channels, note});
    if (column.difference) content.pictures.push_back({*column.difference, channels, note});
    for (const std::string& name : channels) {
      const auto has_name = [&name](const MapChannel& channel) { return channel.name == name; };
      if (std::ranges::any_of(content.values, has_name)) continue;
      const auto own = std::ranges::find_if(estimated, has_name);
      content.values.push_back(own == estimated.end() ? figure.analytic.map.channel(name) : *own);
    }
  }
  if (!content.pictures.empty()) {
    content.left = content.pictures.front().picture.name;
    content.right = content.pictures.at(1).picture.name;
  }
  content.results = element("section", errorSection(columns));
  content.files =
      "<a href=\"figure.png\">figure.png</a>: the columns side by side; <a href=\"maps.exr\">maps.exr</a>: all "
      "channels "
      "as 32-bit floats, the scene in its header; <a href=\"errors.csv\">errors.csv</a>, "
      "<a href=\"errors.json\">errors.json</a>: the table above; a .png for each picture; "
      "<a href=\"run.json\">run.json</a>: how this was made.";
  return figurePage(content);
}

}  // namespace irradiff
