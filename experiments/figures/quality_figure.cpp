#include "experiments/figures/quality_figure.h"

#include "derivatives/scene/invalid_scene.h"
#include "experiments/figures/convergence_plots.h"
#include "experiments/figures/figure_columns.h"
#include "experiments/figures/figure_page.h"
#include "experiments/figures/figure_sheet.h"
#include "experiments/figures/picture_preview.h"
#include "experiments/figures/program_fingerprint.h"
#include "experiments/figures/sampled_figure.h"
#include "experiments/io/exr_file.h"
#include "experiments/io/png_file.h"
#include "verification/report/html.h"
#include "verification/report/result_table.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace irradiff {
namespace {

/// The rays at which estimators are compared in the page's table.
constexpr std::size_t kTableRays = 4096;

nlohmann::ordered_json stepsOf(const ConvergencePlan& plan) {
  nlohmann::ordered_json steps = nlohmann::ordered_json::array();
  for (const ConvergenceStep& step : plan.steps) {
    steps.push_back({{"rays", step.rays}, {"receivers", step.receivers}, {"seeds", step.seeds}});
  }
  return steps;
}

nlohmann::ordered_json configurationOf(const FigureScene& scene, const ReceiverGrid& grid, const QualityPlan& plan,
                                       const std::vector<std::string>& others) {
  return {{"figure", 6},
          {"scene", scene.name},
          {"other_scenes", others},
          {"resolution", {grid.width, grid.height}},
          {"map_rays", kQualityRays},
          {"seed", plan.seed},
          {"curve_seed", plan.curves.first_seed},
          {"curve_steps", stepsOf(plan.curves)},
          {"split_seed", plan.splits.first_seed},
          {"split_steps", stepsOf(plan.splits)}};
}

nlohmann::ordered_json configurationOf(const QualityFigure& figure) {
  std::vector<std::string> others;
  others.reserve(figure.curves.size());
  for (std::size_t i = 1; i < figure.curves.size(); ++i) others.push_back(figure.curves[i].scene.name);
  return configurationOf(figure.analytic.scene, figure.analytic.map.grid, figure.plan, others);
}

std::string prefixOf(std::size_t rays) { return "rays" + std::to_string(rays) + '.'; }

/// The columns of the gradient at each number of rays.
struct RayColumns {
  std::size_t rays;
  std::vector<FigureColumn> columns;  ///< the truth first
};

std::vector<RayColumns> columnsOf(const QualityFigure& figure) {
  std::vector<RayColumns> all;
  all.reserve(kQualityRays.size());
  for (std::size_t i = 0; i < kQualityRays.size(); ++i) {
    std::vector<FigureColumn> columns = figureColumns(figure.analytic.map, figure.maps[i]);
    std::erase_if(columns, [](const FigureColumn& column) { return column.compared != Compared::kGradient; });
    for (FigureColumn& column : columns) {
      if (!column.errors) continue;
      const std::string prefix = prefixOf(kQualityRays[i]);
      column.picture.name = prefix + column.picture.name;
      column.picture.title += ", " + std::to_string(kQualityRays[i]) + " rays";
      column.difference->name = prefix + column.difference->name;
      column.difference->title += ", " + std::to_string(kQualityRays[i]) + " rays";
      for (std::string& channel : column.channels) channel.insert(0, prefix);
    }
    all.push_back({kQualityRays[i], std::move(columns)});
  }
  return all;
}

std::vector<MapChannel> estimatedChannels(const QualityFigure& figure) {
  std::vector<MapChannel> all;
  for (std::size_t i = 0; i < kQualityRays.size(); ++i) {
    for (MapChannel& channel : comparedChannels(figure.analytic.map, figure.maps[i])) {
      channel.name = prefixOf(kQualityRays[i]) + channel.name;
      all.push_back(std::move(channel));
    }
  }
  return all;
}

RgbImage sheetOf(const std::vector<RayColumns>& all) {
  std::vector<std::vector<SheetColumn>> rows;
  for (const RayColumns& group : all) {
    std::vector<SheetColumn>& row = rows.emplace_back();
    for (const FigureColumn& column : group.columns) {
      SheetColumn shown{
          column.errors ? column.source : std::to_string(group.rays) + " rays: analytic", {column.picture.image}, {}};
      if (column.errors) {
        shown.pictures.push_back(column.difference->image);
        shown.lines = {"median " + errorNumber(column.errors->median), "rms " + errorNumber(column.errors->rms),
                       "99th " + errorNumber(column.errors->percentile99)};
      }
      row.push_back(std::move(shown));
    }
  }
  return figureSheet(rows);
}

ResultTable curveTable(const QualityFigure& figure) {
  ResultTable table(
      {"scene", "quantity", "estimator", "rays", "seeds", "receivers", "compared", "median", "low_5", "high_95"});
  for (const QualityFigure::Curves& group : figure.curves) {
    for (const ConvergenceCurve& curve : group.curves) {
      for (const ConvergencePoint& point : curve.points) {
        table.add({group.scene.name, std::string(quantityOf(curve.compared).name), curve.estimator.label(), point.rays,
                   point.medians.size(), point.receivers, point.compared, point.median(), point.low(), point.high()});
      }
    }
  }
  return table;
}

ResultTable orderTable(const QualityFigure& figure) {
  ResultTable table({"scene", "quantity", "estimator", "order", "low_5", "high_95"});
  for (const QualityFigure::Curves& group : figure.curves) {
    for (const ConvergenceCurve& curve : group.curves) {
      table.add({group.scene.name, std::string(quantityOf(curve.compared).name), curve.estimator.label(),
                 curve.order.median, curve.order.low, curve.order.high});
    }
  }
  return table;
}

ResultTable splitTable(const QualityFigure& figure) {
  ResultTable table(
      {"scene", "quantity", "estimator", "rays", "compared", "total", "discretisation", "noise", "rounding"});
  for (const QualityFigure::Curves& group : figure.curves) {
    for (const ErrorSplitCurve& curve : group.splits) {
      for (const ErrorSplitPoint& point : curve.points) {
        const SplitError& m = point.medians;
        table.add({group.scene.name, std::string(quantityOf(curve.compared).name), curve.estimator, point.rays,
                   point.compared, m.total, m.discretisation, m.noise, m.rounding});
      }
    }
  }
  return table;
}

struct NamedPlot {
  std::string file;
  std::string title;
  std::string svg;
};

/// "plots/figure5_gradient.svg".
std::string plotFile(const std::string& scene, const std::string& content) {
  std::string file = "plots/" + std::filesystem::path(scene).stem().string();
  return file.append("_").append(content).append(".svg");
}

std::vector<NamedPlot> plotsOf(const QualityFigure& figure) {
  std::vector<NamedPlot> plots;
  for (const QualityFigure::Curves& group : figure.curves) {
    for (const Compared compared : {Compared::kGradient, Compared::kHessian}) {
      if (std::ranges::find(group.curves, compared, &ConvergenceCurve::compared) == group.curves.end()) continue;
      const std::string quantity = quantityOf(compared).name;
      plots.push_back({plotFile(group.scene.name, quantity),
                       "Error of the " + quantity + " against rays, " + group.scene.name,
                       convergencePlot(group.curves, compared)});
    }
  }
  return plots;
}

std::vector<NamedPlot> splitPlotsOf(const QualityFigure& figure) {
  std::vector<NamedPlot> plots;
  for (const QualityFigure::Curves& group : figure.curves) {
    for (const Compared compared : {Compared::kGradient, Compared::kHessian}) {
      if (std::ranges::find(group.splits, compared, &ErrorSplitCurve::compared) == group.splits.end()) continue;
      const std::string quantity = quantityOf(compared).name;
      plots.push_back({plotFile(group.scene.name, quantity + "_sources"),
                       "Where the error of the " + quantity + " comes from, " + group.scene.name,
                       errorSplitPlot(group.splits, compared)});
    }
  }
  return plots;
}

std::string plotsHtml(const std::vector<NamedPlot>& plots, const std::string& prefix) {
  std::string html;
  for (std::size_t i = 0; i < plots.size(); ++i) {
    html += element("h3", escaped(plots[i].title)) +
            element("div", inlineSvg(plots[i].svg, prefix + std::to_string(i) + '-', plots[i].title),
                    "style=\"max-width:44rem\"");
  }
  return html;
}

std::string spreadText(double median, double low, double high) {
  return errorNumber(median) + " (" + errorNumber(low) + " .. " + errorNumber(high) + ')';
}

std::string receiversText(const ConvergencePoint& point) {
  return "Over " + std::to_string(point.compared) + " of " + std::to_string(point.receivers) +
         " receivers spread evenly over the grid's rectangle, those where the truth exists and is not 0 to within its "
         "error bound. In brackets the range of 90 % of " +
         std::to_string(point.medians.size()) + " seeds.";
}

std::string tableSection(const QualityFigure& figure) {
  std::string html = element("h2", "Errors at " + std::to_string(kTableRays) + " rays, and how fast they fall");
  for (const QualityFigure::Curves& group : figure.curves) {
    std::string rows =
        element("tr", element("th", "quantity") + element("th", "estimator") + element("th", "rays") +
                          element("th", "median relative error") + element("th", "order in 1/N of N x N rays"));
    const ConvergencePoint* shown = nullptr;
    for (const ConvergenceCurve& curve : group.curves) {
      const auto last = std::ranges::find_if(curve.points.rbegin(), curve.points.rend(),
                                             [](const ConvergencePoint& p) { return p.rays <= kTableRays; });
      if (last == curve.points.rend()) continue;
      if (shown == nullptr || last->compared > shown->compared) shown = &*last;
      rows += element("tr", element("td", quantityOf(curve.compared).name) +
                                element("td", escaped(curve.estimator.label())) +
                                element("td", std::to_string(last->rays)) +
                                element("td", spreadText(last->median(), last->low(), last->high())) +
                                element("td", spreadText(curve.order.median, curve.order.low, curve.order.high)));
    }
    html += element("h3", escaped(group.scene.name)) + element("p", escaped(group.scene.scene.description)) +
            element("div", element("table", rows), "class=\"scroll\"") +
            element("p", shown == nullptr ? std::string() : receiversText(*shown), "class=\"soft\"");
  }
  return element("section", html);
}

std::string pageOf(const QualityFigure& figure, const RunRecord& record, const std::vector<RayColumns>& all,
                   const std::vector<MapChannel>& estimated, const std::vector<NamedPlot>& plots,
                   const std::vector<NamedPlot>& split_plots) {
  const DerivativeMap& truth = figure.analytic.map;
  FigurePageContent content;
  content.title = "Figure 6, error against rays";
  content.introduction =
      element(
          "p",
          "The gradient of irradiance as estimators have it from few and from many rays, and how the error falls "
          "with their number: gradient and tangential Hessian of every estimator, at equal rays. All maps, differences "
          "included, have the scale of the exact one.") +
      element("p", element("strong", escaped(figure.analytic.scene.name)) + ": " +
                       escaped(figure.analytic.scene.scene.description)) +
      element("p",
              "irradiff " + escaped(record.version) + ", " + escaped(record.date) + ", " + escaped(record.compiler) +
                  ", " + escaped(record.machine),
              "class=\"soft\"");
  content.grid = truth.grid;
  const std::vector<std::string> exact{"gradient.x", "gradient.y"};
  content.values.reserve(exact.size() + estimated.size());
  for (const std::string& name : exact) content.values.push_back(truth.channel(name));
  content.pictures.push_back({all[0].columns[0].picture, exact, ""});
  for (const RayColumns& group : all) {
    for (const FigureColumn& column : group.columns) {
      if (!column.errors) continue;
      std::vector<std::string> channels = exact;
      channels.insert(channels.end(), column.channels.begin(), column.channels.end());
      const std::string note = " Error: median " + errorNumber(column.errors->median) + ", RMS " +
                               errorNumber(column.errors->rms) + ", 99 % " + errorNumber(column.errors->percentile99) +
                               '.';
      content.pictures.push_back({column.picture, channels, note});
      content.pictures.push_back({*column.difference, channels, note});
      for (const std::string& name : column.channels) {
        content.values.push_back(*std::ranges::find(estimated, name, &MapChannel::name));
      }
    }
  }
  content.left = content.pictures.front().picture.name;
  content.right = content.pictures.at(1).picture.name;
  content.results = tableSection(figure);
  const std::string curves =
      element("h2", "Error against rays") +
      element(
          "p",
          "Medians over receivers of max|estimate - truth| / max|truth|; the line is the median over seeds, the band "
          "the range of 90 % of them. curves.csv says over how many.") +
      plotsHtml(plots, "plot");
  const std::string sources =
      element("h2", "Where the error comes from") +
      element("p",
              "Discretisation is the error with a sample in the middle of each stratum, which has no noise; noise is "
              "the standard deviation over seeds of jittered samples; rounding is what changes when the same samples "
              "are turned by half a turn, which changes no digit but the order of every sum (it cannot be told of an "
              "estimator that casts rays of its own); all is the root mean square over seeds. Each relative to "
              "max|truth|, and the median over the receivers.") +
      plotsHtml(split_plots, "split");
  content.results += element("section", curves) + element("section", sources);
  content.files =
      "<a href=\"figure.png\">figure.png</a>: the maps side by side; <a href=\"maps.exr\">maps.exr</a>: all channels "
      "as "
      "32-bit floats; <a href=\"curves.csv\">curves.csv</a>, <a href=\"orders.csv\">orders.csv</a>, <a "
      "href=\"splits.csv\">splits.csv</a>: what the plots "
      "show; "
      "plots/: the plots; a .png for each picture; <a href=\"run.json\">run.json</a>: how this was made.";
  return figurePage(content);
}

}  // namespace

QualityPlan quickQualityPlan(std::uint64_t seed) {
  QualityPlan plan;
  plan.seed = plan.curves.first_seed = plan.splits.first_seed = seed;
  for (std::size_t rays = 16; rays <= 4096; rays *= 4) {
    plan.curves.steps.push_back({rays, 128, 5});
    plan.splits.steps.push_back({rays, 64, 4});
  }
  return plan;
}

QualityPlan standardQualityPlan(std::uint64_t seed) {
  QualityPlan plan;
  plan.seed = plan.curves.first_seed = plan.splits.first_seed = seed;
  // More than 1000 of the receivers have a truth that is not 0.
  for (std::size_t rays = 16; rays <= 4096; rays *= 4) {
    plan.curves.steps.push_back({rays, 1100, 20});
    plan.splits.steps.push_back({rays, 550, 10});
  }
  // Four times as many rays cost as much again with half the receivers and half the seeds.
  plan.curves.steps.push_back({16384, 550, 10});
  plan.curves.steps.push_back({65536, 275, 5});
  plan.splits.steps.push_back({16384, 275, 5});
  return plan;
}

std::vector<std::string> qualityEstimators() {
  std::vector<std::string> names;
  const std::vector<std::string> known = estimatorsFor(Stratification::kConcentric);
  for (const char* name : {"ward-heckbert", "triangulated", "discontinuity"}) {
    if (std::ranges::find(known, name) != known.end()) names.emplace_back(name);
  }
  return names;
}

std::string qualityFingerprint(const FigureScene& scene, const ReceiverGrid& grid, const QualityPlan& plan,
                               const std::vector<FigureScene>& others) {
  nlohmann::ordered_json all = configurationOf(scene, grid, plan, {});
  all["scene_texts"] = {scene.text};
  for (const FigureScene& other : others) all["scene_texts"].push_back(other.text);
  all["program"] = programFingerprint();
  return all.dump();
}

QualityFigure qualityFigure(AnalyticFigure analytic, const QualityPlan& plan, std::vector<FigureScene> others,
                            unsigned threads, const TileStore* finished, const QualityProgress& progress) {
  const std::vector<double>& gradient = analytic.map.channel("gradient.x").values;
  if (std::ranges::all_of(gradient, [](double value) { return std::isnan(value); })) {
    throw InvalidScene("grid: the gradient exists at none of its receivers, must exist somewhere for Figure 6");
  }
  QualityFigure figure;
  const std::vector<Polygon>& polygons = analytic.scene.scene.polygons;
  const std::vector<std::string> estimators = qualityEstimators();
  std::size_t tile = 0;
  const auto telling = [&progress](const std::string& work) {
    return [&progress, work](std::size_t done, std::size_t all) {
      if (progress) progress(work, done, all);
    };
  };
  figure.maps.reserve(kQualityRays.size());
  for (const std::size_t rays : kQualityRays) {
    figure.maps.push_back(estimateMaps(polygons, analytic.map.grid, figurePlan(rays, plan.seed), estimators, threads,
                                       finished, tile, telling("maps of " + std::to_string(rays) + " rays")));
    tile += analytic.map.grid.height;
  }
  others.insert(others.begin(), analytic.scene);
  for (FigureScene& scene : others) {
    std::vector<ConvergenceCurve> curves =
        convergenceCurves(scene.scene.polygons, *scene.scene.grid, plan.curves, threads, finished, tile,
                          telling("curves of " + scene.name));
    tile += convergenceTiles(plan.curves);
    std::vector<ErrorSplitCurve> splits = errorSplits(scene.scene.polygons, *scene.scene.grid, plan.splits, threads,
                                                      finished, tile, telling("sources of error, " + scene.name));
    tile += errorSplitTiles(plan.splits);
    figure.curves.push_back({std::move(scene), std::move(curves), std::move(splits)});
  }
  figure.analytic = std::move(analytic);
  figure.plan = plan;
  return figure;
}

void writeFigure(const QualityFigure& figure, const RunRecord& record, const ResultFolder& folder,
                 const std::filesystem::path& subfolder) {
  const std::vector<RayColumns> all = columnsOf(figure);
  const std::vector<MapChannel> estimated = estimatedChannels(figure);
  const std::vector<NamedPlot> plots = plotsOf(figure);
  const std::vector<NamedPlot> split_plots = splitPlotsOf(figure);
  ExrImage image = exrImage(figure.analytic.map, estimated);
  image.attributes = {{"configuration", configurationOf(figure).dump()}, {"scene", figure.analytic.scene.text}};
  folder.write(subfolder / "maps.exr", exrFile(image));
  folder.write(subfolder / "figure.png", pngFile(sheetOf(all)));
  folder.write(subfolder / (all[0].columns[0].picture.name + ".png"), pngFile(preview(all[0].columns[0].picture)));
  for (const RayColumns& group : all) {
    for (const FigureColumn& column : group.columns) {
      if (!column.errors) continue;
      folder.write(subfolder / (column.picture.name + ".png"), pngFile(preview(column.picture)));
      folder.write(subfolder / (column.difference->name + ".png"), pngFile(preview(*column.difference)));
    }
  }
  const ResultTable orders = orderTable(figure);
  folder.write(subfolder / "curves.csv", curveTable(figure).csv());
  folder.write(subfolder / "orders.csv", orders.csv());
  folder.write(subfolder / "splits.csv", splitTable(figure).csv());
  for (const NamedPlot& plot : plots) folder.write(subfolder / plot.file, plot.svg);
  for (const NamedPlot& plot : split_plots) folder.write(subfolder / plot.file, plot.svg);
  folder.write(subfolder / "index.html", pageOf(figure, record, all, estimated, plots, split_plots));
  nlohmann::ordered_json configuration = configurationOf(figure);
  configuration.erase("seed");
  configuration["threads"] = record.threads;
  folder.write(subfolder / "run.json", runJson(record, configuration, figure.plan.seed,
                                               {{"orders", nlohmann::ordered_json::parse(orders.json())}}));
}

}  // namespace irradiff
