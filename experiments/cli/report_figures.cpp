#include "experiments/cli/report_figures.h"

#include "experiments/atlas/atlas.h"
#include "experiments/atlas/atlas_page.h"
#include "experiments/curves/metric_study.h"
#include "experiments/curves/study_page.h"
#include "experiments/figures/analytic_figure.h"
#include "experiments/figures/estimator_comparison.h"
#include "experiments/figures/estimator_section.h"
#include "experiments/figures/sampled_figure.h"
#include "experiments/pareto/pareto.h"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

constexpr const char* kFigureScene = IRRADIFF_SCENE_FOLDER "/figure5.json";
constexpr const char* kBoxScene = IRRADIFF_SCENE_FOLDER "/black_square_in_box.json";
constexpr std::size_t kPaperRays = 4096;

/// Receivers along a side, and the curves.
struct FigureSizes {
  std::size_t analytic;
  std::size_t sampled;
  std::size_t quality;
  std::size_t comparison;
  QualityPlan plan;
  AtlasPlan atlas;
  StudyPlan metrics;
};

/// Curves of the least that still have an order.
QualityPlan leastQualityPlan(std::uint64_t seed) {
  QualityPlan plan;
  plan.seed = plan.curves.first_seed = plan.splits.first_seed = seed;
  for (std::size_t rays = 64; rays <= 4096; rays *= 4) {
    plan.curves.steps.push_back({rays, 64, 5});
    plan.splits.steps.push_back({rays, 16, 4});
  }
  return plan;
}

FigureSizes sizesOf(const ReportFigureOptions& options) {
  switch (options.effort) {
    case Effort::kQuick:
      return {
          64, 64, 32, 24, leastQualityPlan(options.seed), leastAtlasPlan(options.seed), leastStudyPlan(options.seed)};
    case Effort::kStandard:
      // More than 1000 receivers in the comparison have a truth that is not 0.
      return {128,
              64,
              64,
              36,
              quickQualityPlan(options.seed),
              atlasPlan(Effort::kQuick, options.seed),
              studyPlan(Effort::kQuick, options.seed)};
    case Effort::kFull:
      break;
  }
  return {256,
          256,
          256,
          128,
          standardQualityPlan(options.seed),
          atlasPlan(Effort::kStandard, options.seed),
          studyPlan(Effort::kStandard, options.seed)};
}

void writePart(const Atlas& atlas, const RunRecord& record, const ResultFolder& folder, const std::string& subfolder) {
  writeAtlas(atlas, record, folder, subfolder);
}

void writePart(const MetricStudy& study, const RunRecord& record, const ResultFolder& folder,
               const std::string& subfolder) {
  writeStudy(study, record, folder, subfolder);
}

template <class Figure>
void writePart(const Figure& figure, const RunRecord& record, const ResultFolder& folder,
               const std::string& subfolder) {
  writeFigure(figure, record, folder, subfolder);
}

/// Writes each part with the time that it took.
class FigureWriter {
 public:
  FigureWriter(RunRecord record, const ResultFolder& folder) : record_(std::move(record)), folder_(folder) {}

  template <class MakeFigure>
  auto write(const std::string& subfolder, const MakeFigure& makeFigure) {
    const auto start = std::chrono::steady_clock::now();
    auto figure = makeFigure();
    record_.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    writePart(figure, record_, folder_, subfolder);
    return figure;
  }

 private:
  RunRecord record_;
  const ResultFolder& folder_;
};

}  // namespace

FurtherContent writeReportFigures(const ReportFigureOptions& options, const RunRecord& record,
                                  const ResultFolder& folder, const QualityProgress& progress) {
  const FigureSizes sizes = sizesOf(options);
  const FigureScene scene = readFigureScene(kFigureScene);
  const FigureScene box = readFigureScene(kBoxScene);
  const auto telling = [&progress](const std::string& work) {
    return [&progress, work](std::size_t done, std::size_t all) {
      if (progress) progress(work, done, all);
    };
  };
  const auto exactMaps = [&](std::size_t resolution) {
    return analyticFigure(scene, withResolution(*scene.scene.grid, resolution), options.threads,
                          telling("the truth of the figures"));
  };
  FigureWriter writer(record, folder);
  writer.write("figure5", [&] { return exactMaps(sizes.analytic); });
  const SamplingPlan sampling = figurePlan(kPaperRays, options.seed);
  writer.write("figure5_sampled", [&] {
    return sampledFigure(exactMaps(sizes.sampled), sampling, estimatorsFor(sampling.stratification), options.threads,
                         nullptr, telling("Figure 5"));
  });
  const QualityFigure quality = writer.write("figure6", [&] {
    return qualityFigure(exactMaps(sizes.quality), sizes.plan, {box}, options.threads, nullptr, progress);
  });
  ComparisonPlan plan;
  plan.rays = kPaperRays;
  plan.resolution = sizes.comparison;
  plan.seed = options.seed;
  const EstimatorComparison comparison = compareEstimators({scene, box}, box, plan, options.threads, progress);
  const ResultTable table = comparisonTable(comparison, quality.curves);
  folder.write("estimators.csv", table.csv());
  folder.write("estimators.json", table.json());
  const Atlas atlas = writer.write("atlas", [&] { return makeAtlas(sizes.atlas, options.threads, nullptr, progress); });
  const auto start = std::chrono::steady_clock::now();
  const Pareto pareto = measurePareto(paretoPlan(options.effort, options.seed), scene, progress);
  RunRecord pareto_record = record;
  pareto_record.threads = 1;
  pareto_record.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  writePareto(pareto, pareto_record, folder, "pareto");
  std::vector<RecordScene> cached;
  for (const std::filesystem::path& path : studyScenes()) cached.push_back(readRecordScene(path));
  const MetricStudy metrics =
      writer.write("metrics", [&] { return metricStudy(sizes.metrics, cached, options.threads, {}, progress); });
  FurtherContent content;
  content.sections.push_back(atlasSection(atlas));
  content.sections.push_back(estimatorSection(comparison, quality.curves));
  content.sections.push_back(studySection(metrics, "metrics/index.html"));
  content.pages = {{"figure5/index.html", "Figure 5, the analytic part",
                    "exact maps of irradiance, gradient and Hessian under two occluders and of what filled gaps lose, "
                    "and the values "
                    "under the pointer."},
                   {"figure5_sampled/index.html", "Figure 5, estimators against the truth",
                    "maps of gradient and Hessian from " + std::to_string(sampling.shape.size()) +
                        " rays at a receiver, and their differences from the exact ones."},
                   {"figure6/index.html", "Figure 6, error against rays",
                    "the gradient from few and many rays, and how fast the error of each estimator falls."},
                   {"atlas/index.html", "Stability atlas",
                    "what each formula makes of the extremes at float, double and long double, and where it is safe."},
                   {"pareto/index.html", "Speed against accuracy",
                    "time and error of every formula, rule and estimator, their Pareto fronts, and what it costs to "
                    "choose a rule for a tolerance."},
                   {"metrics/index.html", "Error metrics",
                    "error of an irradiance cache against its records for every metric, regions beside the best that "
                    "is possible, where records are, and Figures 7 to 14."}};
  return content;
}

}  // namespace irradiff
