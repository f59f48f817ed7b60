#pragma once

#include "experiments/figures/derivative_map.h"
#include "experiments/io/receiver_grid.h"
#include "verification/report/result_folder.h"
#include "verification/report/run_record.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace irradiff {

/// The analytic part of Figure 5 of [Schwarzhaupt et al. 2012], of its scene or another: exact irradiance, gradient and
/// Hessian over a plane.
struct AnalyticFigure {
  std::string scene_name;   ///< the scene's file, without its folder
  std::string scene_text;   ///< all that is in it
  std::string description;  ///< from the scene
  DerivativeMap map;
};

/// The grid with `resolution` cells along its longer side, and as many along the other as make the cells most nearly
/// square, at least 1. Requires sides that are not zero.
ReceiverGrid withResolution(const ReceiverGrid& grid, std::size_t resolution);

/// Writes the figure into a folder, which the caller commits: maps.exr with all channels (as in DerivativeMap; the
/// image's rows run from the top, y upwards) and the configuration and the scene as attributes, a PNG for each picture,
/// index.html, and run.json. `subfolder` is where they go in it, empty for the folder itself.
void writeFigure(const AnalyticFigure& figure, const RunRecord& record, const ResultFolder& folder,
                 const std::filesystem::path& subfolder = {});

}  // namespace irradiff
