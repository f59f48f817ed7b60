#pragma once

#include "experiments/figures/analytic_figure.h"
#include "experiments/figures/channel_pictures.h"
#include "verification/report/run_record.h"

#include <string>
#include <vector>

namespace irradiff {

/// The page of an analytic figure: its pictures, what filling gaps loses, and how it was made.
std::string analyticPage(const AnalyticFigure& figure, const RunRecord& record,
                         const std::vector<MapPicture>& pictures);

}  // namespace irradiff
