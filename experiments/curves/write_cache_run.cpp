#include "derivatives/scene/number_text.h"
#include "experiments/curves/cache_run.h"
#include "experiments/curves/placement_pictures.h"
#include "experiments/curves/region_ratios.h"
#include "experiments/figures/figure_page.h"
#include "experiments/figures/figure_page_style.h"
#include "experiments/figures/picture_preview.h"
#include "experiments/io/exr_file.h"
#include "experiments/io/png_file.h"
#include "verification/report/html.h"
#include "verification/report/page_style.h"
#include "verification/report/result_table.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace irradiff {

namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
/// Of the radii, that are beyond each end of their scale.
constexpr double kShareBeyond = 0.02;

/// Values at their pixels, NaN where there is none.
std::vector<double> channelOf(const RecordField& field, const std::vector<double>& values) {
  std::vector<double> channel(field.width * field.height, kNoNumber);
  for (std::size_t i = 0; i < values.size(); ++i) channel[field.pixels[i]] = values[i];
  return channel;
}

ResultTable recordTable(const CacheRun& run) {
  ResultTable table({"pixel",   "face",    "x",       "y",       "z",          "normal_x",   "normal_y",   "normal_z",
                     "E",       "dE_dx",   "dE_dy",   "dE_dz",   "rotation_x", "rotation_y", "rotation_z", "axis1_x",
                     "axis1_y", "axis1_z", "axis2_x", "axis2_y", "axis2_z",    "half_axis1", "half_axis2", "d2E_dxx",
                     "d2E_dxy", "d2E_dxz", "d2E_dyy", "d2E_dyz", "d2E_dzz"});
  for (std::size_t r = 0; r < run.placement.records.size(); ++r) {
    const CacheRecord& record = run.placement.records[r];
    const std::size_t receiver = run.placement.record_receivers[r];
    std::vector<ResultTable::Cell> cells{run.field->pixels[receiver], run.field->faces[receiver]};
    const auto add = [&cells](const Eigen::Vector3d& vector) {
      for (const double component : vector) cells.emplace_back(component);
    };
    add(record.receiver.position);
    add(record.receiver.normal);
    cells.emplace_back(record.irradiance);
    add(record.gradient);
    add(record.rotational_gradient);
    add(record.first_axis);
    add(record.second_axis);
    cells.emplace_back(record.half_axes.x());
    cells.emplace_back(record.half_axes.y());
    for (int row = 0; row < 3; ++row) {
      for (int column = row; column < 3; ++column) cells.emplace_back(record.hessian(row, column));
    }
    table.add(std::move(cells));
  }
  return table;
}

nlohmann::ordered_json summaryOf(const CacheRun& run, const RecordScene& scene) {
  const ImageError error = run.error();
  nlohmann::ordered_json summary = {{"scene", scene.name},
                                    {"metric", run.choice.metric},
                                    {"threshold", run.choice.threshold},
                                    {"records", run.placement.records.size()},
                                    {"receivers", run.field->receivers.size()},
                                    {"rays", run.placement.records.size() * run.field->rays_per_record},
                                    {"rms", error.rms},
                                    {"percentile_99", error.percentile_99},
                                    {"maximum", error.maximum},
                                    {"reference_error", run.field->reference_error},
                                    {"unlimited_records", run.unlimitedRecords()},
                                    {"reached_limit", run.placement.reached_limit},
                                    {"served_receivers", run.served()}};
  summary["asked_records"] = nullptr;
  if (run.asked_records) summary["asked_records"] = *run.asked_records;
  summary["is_within"] = run.is_within;
  return summary;
}

std::pair<double, double> scaleOf(std::vector<double> radii) {
  std::erase_if(radii, [](double radius) { return !std::isfinite(radius); });
  if (radii.empty()) return {0.1, 1.0};
  std::ranges::sort(radii);
  const auto beyond = static_cast<std::size_t>(kShareBeyond * static_cast<double>(radii.size() - 1));
  return {radii[beyond], std::max(radii[radii.size() - 1 - beyond], 1.01 * radii[beyond])};
}

std::vector<MapPicture> picturesOf(const CacheRun& run, const std::vector<double>& radii,
                                   const std::vector<double>& errors) {
  const RecordField& field = *run.field;
  const auto [low, high] = scaleOf(radii);
  return {amountPicture(field, run.placement.irradiance, "irradiance", "irradiance as the cache interpolates it",
                        "W/m^2", amountLimit(field.reference)),
          footprintPicture(field, run.placement, run.choice.ellipse.largest_aspect),
          radiusPicture(field, radii, low, high),
          amountPicture(field, errors, "error", "error of the interpolated irradiance over the mean", "",
                        amountLimit(errors))};
}

std::string pageOf(const CacheRun& run, const RecordScene& scene, const RunRecord& record,
                   const std::vector<MapPicture>& pictures) {
  std::string sentences;
  for (const std::string& sentence : runSentences(run)) sentences += element("li", escaped(sentence));
  std::string shown;
  for (const MapPicture& picture : pictures) shown += pictureHtml({picture, {}, ""});
  const std::string title = "Irradiance cache, " + scene.name;
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n" +
         element("title", "irradiff: " + escaped(title)) + '\n' +
         element("style", std::string(kPageStyle) + std::string(kFigurePageStyle)) + "\n</head>\n<body>\n" +
         element("h1", escaped(title)) + element("p", escaped(scene.description)) + element("ul", sentences) + '\n' +
         element("div", '\n' + shown, "class=\"pictures\"") + '\n' +
         element(
             "p",
             "irradiance.exr has irradiance, reference, error and radius as 32-bit floats (NaN where a pixel has no "
             "receiver); records.csv every record; summary.json these figures; run.json how this was made.") +
         element("p", "irradiff " + escaped(record.version) + ", " + escaped(record.date), "class=\"soft\"") +
         "\n</body>\n</html>\n";
}

}  // namespace

void writeCacheRun(const CacheRun& run, const RecordScene& scene, const RunRecord& record,
                   const nlohmann::ordered_json& configuration, const nlohmann::ordered_json& seed,
                   const ResultFolder& folder) {
  const RecordField& field = *run.field;
  std::vector<double> radii = allRadii(field, field.records(run.choice));
  const std::vector<double> errors = relativeErrors(field, run.placement.irradiance);
  const std::vector<MapPicture> pictures = picturesOf(run, radii, errors);
  // Without a border: as far as there is a receiver.
  const double extent = extentOf(field);
  for (double& radius : radii) radius = std::min(radius, extent);
  ExrImage image;
  image.width = field.width;
  image.height = field.height;
  image.channels = {{"irradiance", channelOf(field, run.placement.irradiance)},
                    {"reference", channelOf(field, field.reference)},
                    {"error", channelOf(field, errors)},
                    {"radius", channelOf(field, radii)}};
  image.attributes = {{"configuration", configuration.dump()}, {"scene", scene.text}};
  folder.write("irradiance.exr", exrFile(image));
  for (const MapPicture& picture : pictures) folder.write(picture.name + ".png", pngFile(preview(picture)));
  folder.write("records.csv", recordTable(run).csv());
  const nlohmann::ordered_json summary = summaryOf(run, scene);
  folder.write("summary.json", summary.dump(1) + '\n');
  folder.write("index.html", pageOf(run, scene, record, pictures));
  folder.write("run.json", runJson(record, configuration, seed, summary));
}

}  // namespace irradiff
