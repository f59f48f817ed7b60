#pragma once

#include "experiments/atlas/atlas.h"
#include "experiments/io/png_file.h"
#include "verification/report/page.h"

#include <array>
#include <string>
#include <vector>

namespace irradiff {

/// index.html of an atlas: one document without scripts or anything from the network. `sheets` are those of
/// atlasSheet(), for each map and quantity.
std::string atlasPage(const Atlas& atlas, const RunRecord& record,
                      const std::vector<std::array<RgbImage, kAtlasQuantities>>& sheets);

/// The section of the report's page: the tables of safe regions for the Hessian.
FurtherSection atlasSection(const Atlas& atlas);

}  // namespace irradiff
