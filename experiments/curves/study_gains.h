#pragma once

#include "experiments/curves/study_text.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace irradiff {

/// Counts of records at which goals are judged, and what second order is made of is told.
inline constexpr std::array<std::size_t, 3> kGoalRecords{300, 1000, 3000};

/// The metric of this project on a scene: "second-order" where the scene has it, else "reprojection".
std::string ourMetric(const SceneStudy& scene);

/// RMS error of a metric at a count; nothing if it was not reached or is 0.
std::optional<double> rmsAt(const SceneStudy& scene, const std::string& metric, std::size_t records);

/// What a gather at every receiver leaves of noise in the records that a metric has in this study, over the mean.
double noiseOf(const SceneStudy& scene, const std::string& metric);

/// The RMS error of `ourMetric` over those of occlusion-hessian and of the oracle at kGoalRecords, and how many goals
/// are met; empty where there is nothing to compare.
std::string gainSentence(const SceneStudy& scene);

/// RMS errors of "reprojection" and, if there is one, "second-order" over those of occlusion-hessian and of the oracle,
/// at each asked count that all of them reached; without rows if there is none.
TextTable gainText(const SceneStudy& scene);

inline constexpr const char* kAblationTitle = "What second order is made of";

/// RMS errors of SceneStudy::ablation at those of kGoalRecords that were asked for; without rows if there are none.
TextTable ablationText(const SceneStudy& scene);

}  // namespace irradiff
