#pragma once

#include "experiments/figures/analytic_figure.h"
#include "experiments/figures/convergence.h"
#include "experiments/figures/error_split.h"
#include "experiments/figures/estimate_map.h"
#include "experiments/figures/tile_store.h"
#include "verification/report/result_folder.h"
#include "verification/report/run_record.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace irradiff {

/// What Figure 6 is made with.
struct QualityPlan {
  std::uint64_t seed = 1;  ///< of the maps
  ConvergencePlan curves;
  ConvergencePlan splits;  ///< of errors into their sources
};

/// Curves from 16 to 4096 rays in seconds: 128 receivers, 5 seeds from `seed` on.
QualityPlan quickQualityPlan(std::uint64_t seed);

/// From 16 to 65536 rays in minutes: over 1000 receivers with a truth that is not 0 and 20 seeds, fewer from 16384 rays
/// on.
QualityPlan standardQualityPlan(std::uint64_t seed);

/// Figure 6 of [Schwarzhaupt et al. 2012]: maps of the gradient from few and many rays; and, for every estimator, the
/// error against the number of rays, in the figure's scene and in others.
struct QualityFigure {
  struct Curves {
    FigureScene scene;
    std::vector<ConvergenceCurve> curves;
    std::vector<ErrorSplitCurve> splits;
  };

  AnalyticFigure analytic;
  QualityPlan plan;
  std::vector<std::vector<EstimateMap>> maps;  ///< for each of kQualityRays
  std::vector<Curves> curves;                  ///< the figure's scene first
};

/// Rays at a receiver in the maps of the paper: squares of 10, 34 and 66.
inline constexpr std::array<std::size_t, 3> kQualityRays{100, 1156, 4356};

/// The estimators of the maps: those of ward-heckbert, triangulated and discontinuity that exist.
std::vector<std::string> qualityEstimators();

/// As figureFingerprint.
std::string qualityFingerprint(const FigureScene& scene, const ReceiverGrid& grid, const QualityPlan& plan,
                               const std::vector<FigureScene>& others);

/// Tells what is being done besides how far it is.
using QualityProgress = std::function<void(const std::string&, std::size_t, std::size_t)>;

/// As sampledFigure; curves also for `others`, over their grids. Throws InvalidScene too where the gradient exists at
/// no receiver of the map.
QualityFigure qualityFigure(AnalyticFigure analytic, const QualityPlan& plan, std::vector<FigureScene> others,
                            unsigned threads, const TileStore* finished, const QualityProgress& progress = {});

/// Writes into a folder, which the caller commits: maps.exr (channels of DerivativeMap, and of comparedChannels()
/// behind "rays100." and so on), figure.png, a PNG for each picture; curves.csv, orders.csv, splits.csv, plots/*.svg;
/// index.html and run.json. All but the last two depend on the configuration alone. `subfolder` is where they go in it,
/// empty for the folder itself.
void writeFigure(const QualityFigure& figure, const RunRecord& record, const ResultFolder& folder,
                 const std::filesystem::path& subfolder = {});

}  // namespace irradiff
