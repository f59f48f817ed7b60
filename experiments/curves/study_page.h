#pragma once

#include "experiments/curves/metric_study.h"
#include "verification/report/page.h"

#include <string>
#include <vector>

namespace irradiff {

/// The plots of a scene, as curvePlot and ratioPlot make them; the latter empty without ratios.
struct ScenePlots {
  std::string curves;
  std::string ratios;
};

/// index.html: one document without anything from the network. For each scene the curves, the tables, and all pictures
/// with two of them under a slider, which needs scripts; the rest does not. `plots` are those of the scenes.
std::string studyPage(const MetricStudy& study, const RunRecord& record, const std::vector<ScenePlots>& plots);

/// What a report has of it on its own page: the conclusions, and Figure 1. Further content is at `page`.
FurtherSection studySection(const MetricStudy& study, const std::string& page);

}  // namespace irradiff
