#pragma once

#include "experiments/figures/derivative_map.h"
#include "experiments/io/receiver_grid.h"
#include "experiments/io/scene_file.h"
#include "verification/report/result_folder.h"
#include "verification/report/run_record.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

namespace irradiff {

/// A scene that figures are made of.
struct FigureScene {
  std::string name;  ///< its file, without the folder
  std::string text;  ///< all that is in it
  Scene scene;       ///< in 3D, with a grid of which maps can be made
};

/// Reads a scene file. Throws std::runtime_error naming the file, the place in it, the value and the rule for one that
/// cannot be read, is no valid scene, or has no grid or one that validateFrame refuses.
FigureScene readFigureScene(const std::filesystem::path& path);

/// The analytic part of Figure 5 of [Schwarzhaupt et al. 2012], of its scene or another: exact irradiance, gradient and
/// Hessian over a plane.
struct AnalyticFigure {
  FigureScene scene;
  DerivativeMap map;
};

/// The grid with `resolution` cells along its longer side, and as many along the other as make the cells most nearly
/// square, at least 1. Requires sides that are not zero.
ReceiverGrid withResolution(const ReceiverGrid& grid, std::size_t resolution);

/// The figure of a scene over `grid`, which may be the scene's own or that with another resolution. As derivativeMap
/// for threads, progress and errors.
AnalyticFigure analyticFigure(FigureScene scene, const ReceiverGrid& grid, unsigned threads,
                              const std::function<void(std::size_t, std::size_t)>& progress = {});

/// Writes the figure into a folder, which the caller commits: maps.exr with all channels (as in DerivativeMap; the
/// image's rows run from the top, y upwards) and the configuration and the scene as attributes, a PNG for each picture,
/// index.html, and run.json. `subfolder` is where they go in it, empty for the folder itself.
void writeFigure(const AnalyticFigure& figure, const RunRecord& record, const ResultFolder& folder,
                 const std::filesystem::path& subfolder = {});

}  // namespace irradiff
