#include "experiments/figures/sampled_figure.h"

#include "experiments/figures/figure_columns.h"
#include "experiments/figures/figure_sheet.h"
#include "experiments/figures/picture_preview.h"
#include "experiments/figures/program_fingerprint.h"
#include "experiments/figures/sampled_page.h"
#include "experiments/figures/scene_picture.h"
#include "experiments/io/exr_file.h"
#include "experiments/io/png_file.h"
#include "verification/report/result_table.h"

#include <nlohmann/json.hpp>

#include <stdexcept>

namespace irradiff {
namespace {

/// What the results depend on; not the number of threads.
nlohmann::ordered_json configurationOf(const FigureScene& scene, const ReceiverGrid& grid, const SamplingPlan& plan,
                                       const std::vector<std::string>& estimators) {
  return {{"figure", 5},
          {"part", "sampled"},
          {"scene", scene.name},
          {"resolution", {grid.width, grid.height}},
          {"stratification", "concentric"},
          {"shape", {plan.shape.rows, plan.shape.columns}},
          {"pattern", "jittered"},
          {"seed", plan.seed},
          {"estimators", estimators}};
}

std::vector<std::string> namesOf(const SampledFigure& figure) {
  std::vector<std::string> names;
  names.reserve(figure.estimates.size());
  for (const EstimateMap& map : figure.estimates) names.push_back(map.estimator);
  return names;
}

nlohmann::ordered_json configurationOf(const SampledFigure& figure) {
  return configurationOf(figure.analytic.scene, figure.analytic.map.grid, figure.plan, namesOf(figure));
}

ResultTable errorTable(const std::vector<FigureColumn>& columns) {
  ResultTable table(
      {"quantity", "estimator", "compared", "no_truth", "zero_truth", "no_estimate", "median", "percentile_99", "rms"});
  for (const FigureColumn& column : columns) {
    if (!column.errors) continue;
    const ErrorSummary& e = *column.errors;
    table.add({std::string(quantityOf(column.compared).name), column.source, e.compared, e.no_truth, e.zero_truth,
               e.no_estimate, e.median, e.percentile99, e.rms});
  }
  return table;
}

RgbImage sheetOf(const std::vector<FigureColumn>& columns, const RgbImage& scene) {
  std::vector<std::vector<SheetColumn>> rows;
  for (const FigureColumn& column : columns) {
    if (!column.errors) {
      rows.emplace_back();
      // The scene stands at the head of the first row alone, and leaves its place empty below.
      if (rows.size() == 1) {
        rows.back().push_back({"scene", {scene}, {}});
      } else {
        rows.back().push_back({"", {}, {}});
      }
    }
    SheetColumn shown{column.source, {column.picture.image}, {}};
    if (!column.errors) shown.title = std::string(quantityOf(column.compared).name) + ": analytic";
    if (column.difference) shown.pictures.push_back(column.difference->image);
    if (column.errors) {
      shown.lines = {"median " + errorNumber(column.errors->median), "rms " + errorNumber(column.errors->rms),
                     "99th " + errorNumber(column.errors->percentile99)};
    }
    rows.back().push_back(std::move(shown));
  }
  return figureSheet(rows);
}

}  // namespace

SamplingPlan figurePlan(std::size_t rays, std::uint64_t seed) {
  std::size_t side = 1;
  while ((side + 1) * (side + 1) <= rays) ++side;
  return {Stratification::kConcentric, {side, side}, SamplePattern::kJittered, seed};
}

std::string figureFingerprint(const FigureScene& scene, const ReceiverGrid& grid, const SamplingPlan& plan,
                              const std::vector<std::string>& estimators) {
  nlohmann::ordered_json all = configurationOf(scene, grid, plan, estimators);
  all["scene_text"] = scene.text;
  all["program"] = programFingerprint();
  return all.dump();
}

SampledFigure sampledFigure(AnalyticFigure analytic, const SamplingPlan& plan,
                            const std::vector<std::string>& estimators, unsigned threads, const TileStore* finished,
                            const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<EstimateMap> estimates =
      estimateMaps(analytic.scene.scene.polygons, analytic.map.grid, plan, estimators, threads, finished, 0, progress);
  return {std::move(analytic), plan, std::move(estimates)};
}

void writeFigure(const SampledFigure& figure, const RunRecord& record, const ResultFolder& folder,
                 const std::filesystem::path& subfolder) {
  const DerivativeMap& truth = figure.analytic.map;
  const std::vector<FigureColumn> columns = figureColumns(truth, figure.estimates);
  const std::vector<MapChannel> estimated = comparedChannels(truth, figure.estimates);
  const RgbImage scene = scenePicture(figure.analytic.scene.scene, truth, kSheetPicture);
  ExrImage image = exrImage(truth, estimated);
  image.attributes = {{"configuration", configurationOf(figure).dump()}, {"scene", figure.analytic.scene.text}};
  folder.write(subfolder / "maps.exr", exrFile(image));
  folder.write(subfolder / "scene.png", pngFile(scene));
  folder.write(subfolder / "figure.png", pngFile(sheetOf(columns, scene)));
  for (const FigureColumn& column : columns) {
    folder.write(subfolder / (column.picture.name + ".png"), pngFile(preview(column.picture)));
    if (column.difference)
      folder.write(subfolder / (column.difference->name + ".png"), pngFile(preview(*column.difference)));
  }
  const ResultTable errors = errorTable(columns);
  folder.write(subfolder / "errors.csv", errors.csv());
  folder.write(subfolder / "errors.json", errors.json());
  folder.write(subfolder / "index.html", sampledPage(figure, record, columns, estimated, scene));
  nlohmann::ordered_json configuration = configurationOf(figure);
  configuration.erase("seed");
  configuration["threads"] = record.threads;
  folder.write(subfolder / "run.json", runJson(record, configuration, figure.plan.seed,
                                               {{"errors", nlohmann::ordered_json::parse(errors.json())}}));
}

}  // namespace irradiff
