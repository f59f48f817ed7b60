#pragma once

#include "experiments/figures/figure_columns.h"
#include "experiments/figures/sampled_figure.h"
#include "experiments/io/png_file.h"
#include "verification/report/run_record.h"

#include <string>
#include <vector>

namespace irradiff {

/// The page of a figure with estimators: any two columns or differences under a slider, value and error under the
/// pointer, and a table of the errors. `estimated` as comparedChannels().
std::string sampledPage(const SampledFigure& figure, const RunRecord& record, const std::vector<FigureColumn>& columns,
                        const std::vector<MapChannel>& estimated, const RgbImage& scene);

}  // namespace irradiff
