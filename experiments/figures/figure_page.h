#pragma once

#include "experiments/figures/analytic_figure.h"
#include "experiments/figures/map_pictures.h"
#include "verification/report/run_record.h"

#include <string>
#include <vector>

namespace irradiff {

/// The figure as one HTML document without anything from the network: two pictures under a slider, the values at the
/// receiver under the pointer (single precision, of at most kPageValues x kPageValues receivers), then all pictures
/// with their colour bars, which are there without scripts and in print too.
std::string figurePage(const AnalyticFigure& figure, const RunRecord& record, const std::vector<MapPicture>& pictures);

inline constexpr std::size_t kPageValues = 128;

}  // namespace irradiff
