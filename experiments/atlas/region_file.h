#pragma once

#include "experiments/atlas/safe_region.h"
#include "verification/report/result_table.h"

#include <string>
#include <string_view>
#include <vector>

namespace irradiff {

struct Atlas;

/// A row for each statement, with its inequality as text and the counts of its check.
ResultTable regionTable(const Atlas& atlas);

/// regions.json: the statements as data, without the counts; an array with an object for each:
///   {"map", "formula", "scalar", "quantity", "tolerance",
///    "region": null or [{"x_power", "y_power", "at_least" or "at_most"}, ...]}
/// A region is where all of its inequalities x^x_power y^y_power >= at_least (<= at_most) hold; an empty array is the
/// whole map.
std::string regionsJson(const std::vector<SafetyStatement>& statements);

/// Reads what regionsJson wrote; shares of regions are 0. Throws nlohmann::json::exception or std::invalid_argument
/// naming the value for anything else.
std::vector<SafetyStatement> readRegions(std::string_view text);

}  // namespace irradiff
