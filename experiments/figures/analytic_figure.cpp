#include "experiments/figures/analytic_figure.h"

#include "experiments/figures/analytic_page.h"
#include "experiments/figures/map_pictures.h"
#include "experiments/figures/picture_preview.h"
#include "experiments/io/exr_file.h"
#include "experiments/io/png_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

/// What the maps depend on; not the number of threads.
nlohmann::ordered_json configurationOf(const AnalyticFigure& figure) {
  const ReceiverGrid& grid = figure.map.grid;
  return {{"figure", 5}, {"part", "analytic"}, {"scene", figure.scene.name}, {"resolution", {grid.width, grid.height}}};
}

std::string runJsonOf(const AnalyticFigure& figure, const RunRecord& record) {
  nlohmann::ordered_json configuration = configurationOf(figure);
  configuration["threads"] = record.threads;
  const std::vector<double>& events = figure.map.channel("event").values;
  // Nothing here is random.
  return runJson(record, configuration, nullptr, {{"receivers_beside_an_event", std::ranges::count(events, 1.0)}});
}

}  // namespace

FigureScene readFigureScene(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  FigureScene result;
  result.name = path.filename().string();
  result.text.assign(std::istreambuf_iterator<char>(file), {});
  if (!file) {
    throw std::runtime_error(path.string() + ": cannot be read");
  }
  try {
    result.scene = parseScene(result.text);
    if (result.scene.dimension != 3) {
      throw SceneFileError("dimension: 2, must be 3 for a map");
    }
    if (!result.scene.grid) {
      throw SceneFileError("scene: has no \"grid\", must have one for a map");
    }
    validateFrame(*result.scene.grid);
  } catch (const std::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
  return result;
}

ReceiverGrid withResolution(const ReceiverGrid& grid, std::size_t resolution) {
  const double cell = std::max(grid.u.norm(), grid.v.norm()) / static_cast<double>(resolution);
  const auto count = [cell](double side) { return static_cast<std::size_t>(std::max(1L, std::lround(side / cell))); };
  ReceiverGrid result = grid;
  result.width = count(grid.u.norm());
  result.height = count(grid.v.norm());
  return result;
}

AnalyticFigure analyticFigure(FigureScene scene, const ReceiverGrid& grid, unsigned threads,
                              const std::function<void(std::size_t, std::size_t)>& progress) {
  DerivativeMap map = derivativeMap(grid, viewEvaluator(scene.scene.polygons), threads, progress);
  return {std::move(scene), std::move(map)};
}

void writeFigure(const AnalyticFigure& figure, const RunRecord& record, const ResultFolder& folder,
                 const std::filesystem::path& subfolder) {
  const std::vector<MapPicture> pictures = mapPictures(figure.map);
  ExrImage image = exrImage(figure.map, {});
  image.attributes = {{"configuration", configurationOf(figure).dump()}, {"scene", figure.scene.text}};
  folder.write(subfolder / "maps.exr", exrFile(image));
  for (const MapPicture& picture : pictures) {
    folder.write(subfolder / (picture.name + ".png"), pngFile(preview(picture)));
  }
  folder.write(subfolder / "index.html", analyticPage(figure, record, pictures));
  folder.write(subfolder / "run.json", runJsonOf(figure, record));
}

}  // namespace irradiff
