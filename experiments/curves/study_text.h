#pragma once

#include "experiments/curves/metric_study.h"

#include <string>
#include <vector>

namespace irradiff {

/// Rows of text under headings, for a page and for Markdown.
struct TextTable {
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> rows;
};

/// RMS error of each metric at each asked count, and the slope.
TextTable errorText(const SceneStudy& scene);
/// Size, reference and noise of a scene, one sentence.
std::string sceneText(const SceneStudy& scene);
/// Figure 1; empty without an order.
TextTable orderText(const SceneStudy& scene);
/// Quantiles of the ratios, and what they make of the metric.
TextTable ratioText(const SceneStudy& scene);
/// One of the Figures 7 to 14.
TextTable comparisonText(const CacheComparison& comparison);

/// What its regions make of a metric: "safe", "timid", "reckless" or "reckless and timid".
std::string characterOf(const RegionRatios& ratios);
/// Reckless: more than a twentieth of the regions have this many times the error that the oracle's threshold allows.
inline constexpr double kRecklessError = 4.0;
/// Timid: half of the regions have less than this share of the oracle's radius.
inline constexpr double kTimidRadius = 0.7;

/// How the numbers of a page are to be read.
std::vector<std::string> studyGuide(const MetricStudy& study);

/// What the numbers say: sentences made of the numbers in the tables above, for each scene and for the figures.
std::vector<std::string> conclusionSentences(const MetricStudy& study);

/// metrics.md: all of the above.
std::string studyMarkdown(const MetricStudy& study, const RunRecord& record);

}  // namespace irradiff
