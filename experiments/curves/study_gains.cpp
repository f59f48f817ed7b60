#include "experiments/curves/study_gains.h"

#include "experiments/curves/study_words.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <vector>

namespace irradiff {

namespace {

constexpr const char* kOcclusion = "occlusion-hessian";
constexpr const char* kReprojection = "reprojection";
constexpr const char* kSecondOrder = "second-order";
constexpr const char* kOracle = "oracle";

/// What is asked of the RMS error of our metric over that of occlusion-hessian, and of the oracle.
struct Goal {
  std::string_view scene;
  double over_occlusion;
};
constexpr std::array<Goal, 2> kGoals{{{"cornell_box", 0.5}, {"figure5", 0.4}}};
constexpr double kGoalOverOracle = 1.5;

bool has(const ErrorCurves& curves, const std::string& metric) {
  return std::ranges::any_of(curves.points, [&](const CurvePoint& point) { return point.metric == metric; });
}

/// RMS of a metric over that of others, at one count.
struct Gain {
  std::size_t records = 0;
  double over_occlusion = 0.0;
  double over_oracle = 0.0;
};
std::vector<Gain> gainsOf(const SceneStudy& scene, const std::string& metric) {
  std::set<std::size_t> counts;
  for (const CurvePoint& point : scene.curves.points) counts.insert(point.asked_records);
  std::vector<Gain> gains;
  for (const std::size_t records : counts) {
    const auto ours = rmsAt(scene, metric, records);
    const auto occlusion = rmsAt(scene, kOcclusion, records);
    const auto oracle = rmsAt(scene, kOracle, records);
    if (ours && occlusion && oracle) gains.push_back({records, *ours / *occlusion, *ours / *oracle});
  }
  return gains;
}

}  // namespace

std::string ourMetric(const SceneStudy& scene) {
  return has(scene.curves, kSecondOrder) ? kSecondOrder : kReprojection;
}

std::optional<double> rmsAt(const SceneStudy& scene, const std::string& metric, std::size_t records) {
  const std::optional<ImageError> error = scene.curves.errorAt(metric, records);
  if (!error || !(error->rms > 0.0)) return std::nullopt;
  return error->rms;
}

double noiseOf(const SceneStudy& scene, const std::string& metric) {
  return metric == kSecondOrder && scene.known_gather_error ? *scene.known_gather_error : scene.gather_error;
}

std::string gainSentence(const SceneStudy& scene) {
  const std::string ours = ourMetric(scene);
  std::vector<std::string> counts;
  std::vector<std::string> over_occlusion;
  std::vector<std::string> over_oracle;
  std::size_t kept = 0;
  std::size_t asked = 0;
  const auto* goal = std::ranges::find(kGoals, std::string_view(scene.name), &Goal::scene);
  for (const Gain& gain : gainsOf(scene, ours)) {
    if (std::ranges::find(kGoalRecords, gain.records) == kGoalRecords.end()) continue;
    counts.push_back(std::to_string(gain.records));
    over_occlusion.push_back(threeDigits(gain.over_occlusion));
    over_oracle.push_back(threeDigits(gain.over_oracle));
    if (goal == kGoals.end()) continue;
    asked += 2;
    kept += gain.over_occlusion <= goal->over_occlusion ? 1 : 0;
    kept += gain.over_oracle <= kGoalOverOracle ? 1 : 0;
  }
  if (counts.empty()) return "";
  std::string text = scene.name + ": ours, " + ours + ", has " + listText(over_occlusion) +
                     " times the RMS error of occlusion-hessian at " + listText(counts) + " records, and " +
                     listText(over_oracle) + " times that of the oracle.";
  if (asked > 0) {
    text += " Asked for are at most " + threeDigits(goal->over_occlusion) + " and " + threeDigits(kGoalOverOracle) +
            ": met in " + std::to_string(kept) + " of " + std::to_string(asked) + " cases.";
  }
  return text;
}

TextTable gainText(const SceneStudy& scene) {
  std::vector<std::string> metrics;
  for (const char* metric : {kReprojection, kSecondOrder}) {
    if (has(scene.curves, metric)) metrics.emplace_back(metric);
  }
  TextTable table{{"records"}, {}};
  for (const char* other : {kOcclusion, kOracle}) {
    for (const std::string& metric : metrics) table.headings.push_back(metric + " over " + other);
  }
  std::vector<std::vector<Gain>> gains;
  for (const std::string& metric : metrics) gains.push_back(gainsOf(scene, metric));
  for (const Gain& first : gains.empty() ? std::vector<Gain>() : gains.front()) {
    std::vector<std::string> occlusion;
    std::vector<std::string> oracle;
    for (const std::vector<Gain>& of_metric : gains) {
      const auto gain = std::ranges::find(of_metric, first.records, &Gain::records);
      if (gain == of_metric.end()) continue;
      occlusion.push_back(threeDigits(gain->over_occlusion));
      oracle.push_back(threeDigits(gain->over_oracle));
    }
    if (occlusion.size() < metrics.size()) continue;
    std::vector<std::string> cells{std::to_string(first.records)};
    cells.insert(cells.end(), occlusion.begin(), occlusion.end());
    cells.insert(cells.end(), oracle.begin(), oracle.end());
    table.rows.push_back(std::move(cells));
  }
  return table;
}

TextTable ablationText(const SceneStudy& scene) {
  TextTable table{{"records are made by"}, {}};
  std::vector<std::size_t> counts;
  for (const std::size_t count : kGoalRecords) {
    const auto is_asked = [count](const CurvePoint& point) { return point.asked_records == count; };
    if (std::ranges::any_of(scene.ablation.points, is_asked)) counts.push_back(count);
  }
  if (counts.empty()) return table;
  for (const std::size_t count : counts) table.headings.push_back(std::to_string(count) + " records");
  for (const std::string& variant : scene.ablation.metrics()) {
    std::vector<std::string> cells{variant};
    for (const std::size_t count : counts) {
      const std::optional<ImageError> error = scene.ablation.errorAt(variant, count);
      cells.push_back(error ? threeDigits(error->rms) : kNothing);
    }
    table.rows.push_back(std::move(cells));
  }
  return table;
}

}  // namespace irradiff
