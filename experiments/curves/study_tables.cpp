#include "experiments/curves/study_tables.h"

#include <array>
#include <limits>

namespace irradiff {

namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

void addRatio(ResultTable& table, const SceneStudy& scene, const RegionRatios& ratios, const std::string& name,
              const std::vector<double>& values) {
  if (values.empty()) return;
  const RatioQuantiles found = quantilesOf(values);
  table.add({scene.name, ratios.metric, name, scene.ratio_records, found.values, found.quantiles[0], found.quantiles[1],
             found.quantiles[2], found.quantiles[3], found.quantiles[4], found.share_above_1});
}

ResultTable pointTable(const MetricStudy& study, ErrorCurves SceneStudy::*curves, const char* name) {
  ResultTable table({"scene", name, "field", "asked_records", "records", "rays", "threshold", "is_within", "rms",
                     "percentile_99", "maximum"});
  for (const SceneStudy& scene : study.scenes) {
    for (const CurvePoint& p : (scene.*curves).points) {
      table.add({scene.name, p.metric, p.field, p.asked_records, p.records, p.rays, p.threshold, p.is_within,
                 p.error.rms, p.error.percentile_99, p.error.maximum});
    }
  }
  return table;
}

}  // namespace

ResultTable curveTable(const MetricStudy& study) { return pointTable(study, &SceneStudy::curves, "metric"); }

ResultTable ablationTable(const MetricStudy& study) { return pointTable(study, &SceneStudy::ablation, "variant"); }

ResultTable slopeTable(const MetricStudy& study) {
  ResultTable table({"scene", "metric", "slope"});
  for (const SceneStudy& scene : study.scenes) {
    for (const std::string& metric : scene.curves.metrics()) {
      table.add({scene.name, metric, scene.curves.slope(metric).value_or(kNoNumber)});
    }
  }
  return table;
}

ResultTable ratioTable(const MetricStudy& study) {
  ResultTable table({"scene", "metric", "ratio", "records", "receivers", "low_5", "low_25", "median", "high_75",
                     "high_95", "share_above_1"});
  for (const SceneStudy& scene : study.scenes) {
    for (const RegionRatios& ratios : scene.ratios) {
      addRatio(table, scene, ratios, "radius", ratios.radii);
      addRatio(table, scene, ratios, "error", ratios.errors);
      addRatio(table, scene, ratios, "kept", ratios.kept);
    }
  }
  return table;
}

ResultTable orderTable(const MetricStudy& study) {
  ResultTable table({"scene", "metric", "records", "rms", "percentile_99", "maximum", "ratio", "ratio_low",
                     "ratio_high", "rank", "published_rms", "published_ratio", "published_rank"});
  for (const SceneStudy& scene : study.scenes) {
    if (!scene.order) continue;
    for (const PublishedRow& row : scene.order->rows) {
      table.add({scene.name, row.metric, scene.order->records, row.error.rms, row.error.percentile_99,
                 row.error.maximum, row.ratio, row.lowest_ratio.value_or(kNoNumber),
                 row.highest_ratio.value_or(kNoNumber), row.rank, row.published_rms.value_or(kNoNumber),
                 row.published_ratio.value_or(kNoNumber), row.published_rank});
    }
  }
  return table;
}

ResultTable comparisonTable(const MetricStudy& study) {
  ResultTable table({"figure", "field", "variant", "metric", "threshold", "asked_records", "records", "rays",
                     "is_within", "rms", "percentile_99", "maximum"});
  for (const CacheComparison& figure : study.comparisons) {
    for (const VariantResult& r : figure.results) {
      table.add({figure.id, r.field, r.label, r.metric, r.threshold, r.asked_records, r.records, r.rays, r.is_within,
                 r.error.rms, r.error.percentile_99, r.error.maximum});
    }
  }
  return table;
}

}  // namespace irradiff
