#include "experiments/curves/study_text.h"

#include "experiments/curves/study_gains.h"
#include "experiments/curves/study_words.h"
#include "verification/report/figure_text.h"

#include <algorithm>
#include <set>

namespace irradiff {

namespace {

constexpr const char* kOracle = "oracle";

std::string percentText(double share) { return threeDigits(100.0 * share) + " %"; }

std::vector<std::size_t> askedCounts(const SceneStudy& scene) {
  std::set<std::size_t> counts;
  for (const CurvePoint& point : scene.curves.points) counts.insert(point.asked_records);
  return {counts.begin(), counts.end()};
}

/// Of the noise of a gather.
constexpr double kNoisyError = 1.5;

std::string orderSentence(const SceneStudy& scene) {
  if (!scene.order) return "";
  std::vector<const PublishedRow*> rows;
  for (const PublishedRow& row : scene.order->rows) {
    if (row.published_rms) rows.push_back(&row);
  }
  if (rows.size() < 2) return "";
  std::ranges::stable_sort(rows, {}, [](const PublishedRow* row) { return row->error.rms; });
  std::string text = scene.name + ", " + std::to_string(scene.order->records) + " records: of the published metrics " +
                     rows.front()->metric + " has the least RMS error, " + threeDigits(rows.front()->error.rms) +
                     " of the mean; then ";
  std::vector<std::string> others;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    others.push_back(rows[i]->metric + " with " + threeDigits(rows[i]->error.rms));
  }
  text += listText(others) + '.';
  if (scene.order->agrees()) return text + " This is the order of the paper's Figure 1.";
  std::vector<std::string> differences;
  for (const PublishedRow* row : rows) {
    if (row->rank == row->published_rank) continue;
    differences.push_back(row->metric + " is number " + std::to_string(row->rank) + " in place of " +
                          std::to_string(row->published_rank));
  }
  if (!differences.empty()) text += " In the paper's Figure 1 the order is another: " + listText(differences) + '.';
  if (!scene.order->unreached.empty()) {
    text += " Without " + listText(scene.order->unreached) + ", which cannot have this many records.";
  }
  return text;
}

/// Where errors are of the size of the noise of gathers their order says little about metrics.
std::string noiseSentence(const SceneStudy& scene) {
  if (scene.rays_per_record == 0 || !(scene.gather_error > 0.0)) return "";
  std::vector<std::string> noisy;
  for (const std::string& metric : scene.curves.metrics()) {
    const auto rms = rmsAt(scene, metric, scene.table_records);
    if (rms && *rms <= kNoisyError * noiseOf(scene, metric)) noisy.push_back(metric);
  }
  if (noisy.empty()) return "";
  return scene.name + ": one gather at every receiver has an RMS error of " + threeDigits(scene.gather_error) +
         (scene.known_gather_error ? " (" + threeDigits(*scene.known_gather_error) + " with known geometry)" : "") +
         "; at " + std::to_string(scene.table_records) + " records " + listText(noisy) +
         (noisy.size() == 1 ? " is" : " are") + " within " + threeDigits(kNoisyError) +
         " times of it, where differences are of noise as much as of metrics: more rays would tell them apart.";
}

std::string characterSentence(const SceneStudy& scene) {
  std::vector<std::string> texts;
  for (const RegionRatios& ratios : scene.ratios) {
    if (ratios.metric == kOracle) continue;
    const RatioQuantiles radii = quantilesOf(ratios.radii);
    const RatioQuantiles errors = quantilesOf(ratios.errors);
    texts.push_back(ratios.metric + " is " + characterOf(ratios) + " (radius " + threeDigits(radii.quantiles[2]) +
                    " of the oracle's in the median; one region in twenty has " + threeDigits(errors.quantiles[4]) +
                    " times the error or more)");
  }
  if (texts.empty()) return "";
  return scene.name + ", at " + std::to_string(scene.ratio_records) + " records: " + listText(texts) + '.';
}

std::string slopeSentence(const SceneStudy& scene) {
  std::vector<std::string> texts;
  for (const std::string& metric : scene.curves.metrics()) {
    if (const auto slope = scene.curves.slope(metric)) texts.push_back(threeDigits(*slope) + " for " + metric);
  }
  if (texts.empty()) return "";
  return scene.name + ": the RMS error goes with the number of records to the power of " + listText(texts) + '.';
}

void addRatioRow(TextTable& table, const RegionRatios& ratios, const std::string& name,
                 const std::vector<double>& values, const std::string& character) {
  if (values.empty()) return;
  const RatioQuantiles found = quantilesOf(values);
  std::vector<std::string> cells{ratios.metric, name};
  for (const double quantile : found.quantiles) cells.push_back(threeDigits(quantile));
  cells.push_back(percentText(found.share_above_1));
  cells.push_back(character);
  table.rows.push_back(std::move(cells));
}

}  // namespace

TextTable errorText(const SceneStudy& scene) {
  const std::vector<std::size_t> counts = askedCounts(scene);
  TextTable table{{"metric"}, {}};
  for (const std::size_t count : counts) table.headings.push_back(countText(count) + " records");
  table.headings.emplace_back("slope");
  for (const std::string& metric : scene.curves.metrics()) {
    std::vector<std::string> cells{metric};
    const std::vector<CurveBand> bands = scene.curves.bands(metric);
    for (const std::size_t count : counts) {
      const auto band = std::ranges::find(bands, count, &CurveBand::asked_records);
      if (band == bands.end()) {
        cells.emplace_back(kNothing);
      } else if (band->lowest_rms < band->highest_rms) {
        cells.push_back(threeDigits(band->rms) + " (" + threeDigits(band->lowest_rms) + " .. " +
                        threeDigits(band->highest_rms) + ')');
      } else {
        cells.push_back(threeDigits(band->rms));
      }
    }
    const std::optional<double> slope = scene.curves.slope(metric);
    cells.push_back(slope ? threeDigits(*slope) : kNothing);
    table.rows.push_back(std::move(cells));
  }
  return table;
}

std::string sceneText(const SceneStudy& scene) {
  std::string text = std::to_string(scene.width) + " x " + std::to_string(scene.height) + " pixels, " +
                     std::to_string(scene.receivers) + " receivers. The reference is right to " +
                     threeDigits(scene.reference_error) + " of its mean (RMS).";
  if (scene.rays_per_record > 0) {
    text += " One gather of " + std::to_string(scene.rays_per_record) +
            " rays at every receiver, without any cache, has " + threeDigits(scene.gather_error) +
            (scene.known_gather_error ? ", with known geometry " + threeDigits(*scene.known_gather_error) : "") +
            ": below that a cache gets only by averaging noise.";
  }
  return text;
}

TextTable orderText(const SceneStudy& scene) {
  TextTable table{{"metric", "RMS", "99 %", "largest", "RMS over occlusion-hessian's", "place", "the paper: RMS",
                   "over occlusion-hessian's", "place", "overhead"},
                  {}};
  if (!scene.order) return table;
  for (const PublishedRow& row : scene.order->rows) {
    std::string ratio = threeDigits(row.ratio);
    if (row.lowest_ratio && *row.lowest_ratio < *row.highest_ratio) {
      ratio += " (" + threeDigits(*row.lowest_ratio) + " .. " + threeDigits(*row.highest_ratio) + ')';
    }
    table.rows.push_back({row.metric, threeDigits(row.error.rms), threeDigits(row.error.percentile_99),
                          threeDigits(row.error.maximum), ratio, row.rank > 0 ? std::to_string(row.rank) : kNothing,
                          row.published_rms ? threeDigits(*row.published_rms) : kNothing,
                          row.published_ratio ? threeDigits(*row.published_ratio) : kNothing,
                          row.published_rank > 0 ? std::to_string(row.published_rank) : kNothing, "./run bench"});
  }
  for (const std::string& metric : scene.order->unreached) {
    std::vector<std::string> cells(table.headings.size(), kNothing);
    cells[0] = metric;
    table.rows.push_back(std::move(cells));
  }
  return table;
}

TextTable ratioText(const SceneStudy& scene) {
  TextTable table{{"metric", "ratio", "5 %", "25 %", "50 %", "75 %", "95 %", "above 1", "it is"}, {}};
  for (const RegionRatios& ratios : scene.ratios) {
    addRatioRow(table, ratios, "radius over the oracle's", ratios.radii, characterOf(ratios));
    addRatioRow(table, ratios, "true error over the oracle's allowance", ratios.errors, "");
    addRatioRow(table, ratios, "true error over its own promise", ratios.kept, "");
  }
  return table;
}

TextTable comparisonText(const CacheComparison& comparison) {
  TextTable table{{"variant", "threshold", "records", "RMS", "99 %", "largest"}, {}};
  for (const VariantResult& r : comparison.results) {
    const std::string missed = r.is_within ? "" : " (asked for " + std::to_string(r.asked_records) + ')';
    table.rows.push_back({r.label, threeDigits(r.threshold), std::to_string(r.records) + missed,
                          threeDigits(r.error.rms), threeDigits(r.error.percentile_99), threeDigits(r.error.maximum)});
  }
  return table;
}

std::string characterOf(const RegionRatios& ratios) {
  const bool is_reckless = quantilesOf(ratios.errors).quantiles[4] > kRecklessError;
  const bool is_timid = quantilesOf(ratios.radii).quantiles[2] < kTimidRadius;
  if (is_reckless) return is_timid ? "reckless and timid" : "reckless";
  return is_timid ? "timid" : "safe";
}

std::vector<std::string> studyGuide(const MetricStudy& study) {
  return {
      "A cache stores irradiance at few places, its records, and extrapolates from them. An error metric decides how "
      "far. "
      "Here the threshold of every metric is tuned until it needs the same number of records, to 2 %; what differs is "
      "where they are and, of second-order, what they extrapolate. Errors are those of the interpolated irradiance "
      "over all receivers, over the mean irradiance. "
      "Every record has the irradiance and gradient of one gather, whatever the metric; where a room is sampled, those "
      "of second-order have exact visibility of the room's polygons as a control variate (known geometry), which its "
      "ablation tells apart.",
      "The oracle knows the truth: its regions are the largest ellipses whose true integrated error is its threshold. "
      "It "
      "is the yardstick, and no renderer's metric. A metric is called reckless if more than one region in twenty has "
      "over " +
          threeDigits(kRecklessError) +
          " times the error that the oracle's threshold allows at this count, timid if half "
          "of its regions have less than " +
          threeDigits(kTimidRadius) + " of the oracle's radius, safe if neither.",
      "Sizes: rooms " + std::to_string(study.plan.room_width) + " x " + std::to_string(study.plan.room_width) +
          " pixels at " + std::to_string(study.plan.room_rays) + " rays a record, the plane " +
          std::to_string(study.plan.plane_width) +
          " receivers along its longer side with exact derivatives, flatland " +
          std::to_string(study.plan.flatland_receivers) + " receivers, exact; seed " + std::to_string(study.plan.seed) +
          (study.plan.seeds > 1
               ? ", " + std::to_string(study.plan.seeds) + " seeds of what is sampled: (lowest .. highest)."
               : ".")};
}

std::vector<std::string> conclusionSentences(const MetricStudy& study) {
  std::vector<std::string> sentences;
  const auto add = [&sentences](const std::string& sentence) {
    if (!sentence.empty()) sentences.push_back(sentence);
  };
  for (const SceneStudy& scene : study.scenes) {
    add(orderSentence(scene));
    add(noiseSentence(scene));
    add(gainSentence(scene));
    add(characterSentence(scene));
    add(slopeSentence(scene));
  }
  return sentences;
}

}  // namespace irradiff
