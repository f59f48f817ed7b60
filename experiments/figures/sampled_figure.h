#pragma once

#include "experiments/figures/analytic_figure.h"
#include "experiments/figures/estimate_map.h"
#include "experiments/figures/point_estimator.h"
#include "experiments/figures/tile_store.h"
#include "verification/report/result_folder.h"
#include "verification/report/run_record.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace irradiff {

/// Figure 5 of [Schwarzhaupt et al. 2012], of its scene or another: the exact derivatives over a plane and those that
/// estimators make of the same hemisphere samples.
struct SampledFigure {
  AnalyticFigure analytic;
  SamplingPlan plan;
  std::vector<EstimateMap> estimates;
};

/// The strata of a figure: concentric, N x N with the largest N for which N^2 <= rays, one jittered ray in each.
/// Requires rays >= 1.
SamplingPlan figurePlan(std::size_t rays, std::uint64_t seed);

/// What the estimates of a figure depend on: scene, grid, plan, estimators, version and program, as text.
std::string figureFingerprint(const FigureScene& scene, const ReceiverGrid& grid, const SamplingPlan& plan,
                              const std::vector<std::string>& estimators);

/// The figure with these estimators, from finished rows where there are some. As estimateMaps and analyticFigure for
/// threads, progress and errors.
SampledFigure sampledFigure(AnalyticFigure analytic, const SamplingPlan& plan,
                            const std::vector<std::string>& estimators, unsigned threads, const TileStore* finished,
                            const std::function<void(std::size_t, std::size_t)>& progress = {});

/// Writes into a folder, which the caller commits:
///   - maps.exr: the channels of DerivativeMap, which are the truth, and of comparedChannels();
///   - figure.png: the columns side by side as in the paper, below each its difference from the truth and its errors; a
///     PNG for each picture, scene.png;
///   - errors.csv and errors.json: the errors of each column (ErrorSummary);
///   - index.html, run.json.
/// `subfolder` is where they go in it, empty for the folder itself.
/// All but index.html and run.json, which tell how they were made, depend on the configuration alone.
void writeFigure(const SampledFigure& figure, const RunRecord& record, const ResultFolder& folder,
                 const std::filesystem::path& subfolder = {});

}  // namespace irradiff
