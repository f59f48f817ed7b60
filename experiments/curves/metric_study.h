#pragma once

#include "experiments/curves/cache_comparison.h"
#include "experiments/curves/error_curves.h"
#include "experiments/curves/published_order.h"
#include "experiments/curves/record_scene.h"
#include "experiments/curves/region_ratios.h"
#include "verification/report/accuracy_report.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace irradiff {

/// What metrics are compared with.
struct StudyPlan {
  Effort effort = Effort::kStandard;
  std::uint64_t seed = 1;  ///< the first
  std::size_t seeds = 1;   ///< of sampled fields
  std::size_t room_width = 256;
  std::size_t room_rays = 4096;
  std::size_t plane_width = 256;
  std::size_t flatland_receivers = 32768;
  std::vector<std::size_t> records;  ///< ascending
  std::size_t ratio_records = 1000;  ///< at which regions are compared with the oracle's
  std::vector<std::string> metrics;  ///< all that a field has if empty
  bool has_comparisons = true;       ///< Figures 7 to 14
};

/// Quick takes a minute and a half, standard a quarter of an hour, full three seeds of it.
StudyPlan studyPlan(Effort effort, std::uint64_t seed);
/// Curves of the least that still have an order, in seconds.
StudyPlan leastStudyPlan(std::uint64_t seed);

/// One metric on a scene, at the count of Figure 1 or the largest below it.
struct MetricPictures {
  std::string metric;
  std::size_t records = 0;
  double rms = 0.0;
  MapPicture footprints;
  MapPicture radii;
  MapPicture errors;
};

/// Where a metric is safe, timid or reckless.
struct RatioPictures {
  std::string metric;
  MapPicture radii;   ///< over the oracle's
  MapPicture errors;  ///< true error over what the oracle's threshold allows
};

/// All metrics on one scene.
struct SceneStudy {
  std::string name;
  std::string description;
  bool is_flatland = false;
  std::size_t width = 0;
  std::size_t height = 0;
  std::size_t receivers = 0;
  std::size_t rays_per_record = 0;
  double reference_error = 0.0;  ///< over the mean of the reference
  /// RMS error of one gather at every receiver, over the mean: what noise leaves without any interpolation.
  double gather_error = 0.0;
  std::optional<double> known_gather_error;  ///< the same with known geometry, where the field offers it
  ErrorCurves curves;
  ErrorCurves ablation;  ///< of the steps from occlusion-hessian to second-order; empty where they are not all there
  std::size_t table_records = 0;  ///< the count of `order` and `pictures`
  std::optional<PublishedOrder> order;
  std::size_t ratio_records = 0;
  std::vector<RegionRatios> ratios;
  MapPicture reference;
  std::vector<MetricPictures> pictures;
  std::vector<RatioPictures> ratio_pictures;
};

struct MetricStudy {
  StudyPlan plan;
  std::vector<SceneStudy> scenes;
  std::vector<CacheComparison> comparisons;
};

/// Tells what is being done besides how far it is.
using StudyProgress = std::function<void(const std::string&, std::size_t, std::size_t)>;

/// Makes a store of the finished parts of one piece of work, by its name and fingerprint; null keeps nothing.
using MakeStore = std::function<std::unique_ptr<TileStore>(const std::string& name, const std::string& fingerprint)>;

/// The files of the scenes without one given: the flatland room, the plane of Figure 5, the Cornell box.
std::vector<std::filesystem::path> studyScenes();

/// All curves of the scenes, and the figures of the paper where one of them is the Cornell box. Throws as recordField.
MetricStudy metricStudy(const StudyPlan& plan, const std::vector<RecordScene>& scenes, unsigned threads,
                        const MakeStore& make_store, const StudyProgress& progress = {});

/// Writes curves, slopes, ratios, table and figures as .csv and .json, for each scene its plots
/// (SCENE_curves.svg, SCENE_ratios.svg) and pictures (SCENE/METRIC.footprints.png ...), metrics.md, index.html and
/// run.json into the folder, which the caller commits. `subfolder` is where they go in it. Requires gnuplot.
void writeStudy(const MetricStudy& study, const RunRecord& record, const ResultFolder& folder,
                const std::filesystem::path& subfolder = {});

}  // namespace irradiff
