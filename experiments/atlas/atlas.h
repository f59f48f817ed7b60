#pragma once

#include "experiments/atlas/region_check.h"
#include "experiments/atlas/safe_region.h"
#include "experiments/atlas/stability_map.h"
#include "verification/report/accuracy_report.h"
#include "verification/report/result_folder.h"
#include "verification/report/run_record.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace irradiff {

/// Where every formula is safe: maps of achieved errors over pairs of extremes, and for each variant, quantity and
/// tolerance an inequality that has been put to the test.
struct Atlas {
  AtlasPlan plan;
  std::vector<StabilityMap> maps;
  /// With the counts of the last round, whose inputs took no part in finding the regions.
  std::vector<SafetyStatement> statements;
  std::size_t rounds = 0;  ///< that were made; the last without violations, unless the plan allowed no more
};

/// Seconds, minutes, half an hour.
AtlasPlan atlasPlan(Effort effort, std::uint64_t seed);
/// For a section of the report: two seconds of a core.
AtlasPlan leastAtlasPlan(std::uint64_t seed);

/// What the numbers depend on, as text: plan, variants, version and program.
std::string atlasFingerprint(const AtlasPlan& plan);

/// Results do not depend on threads. `finished`, which may be null, keeps finished rows of maps. Throws as
/// trueFormFactor.
Atlas makeAtlas(const AtlasPlan& plan, unsigned threads, const TileStore* finished, const QualityProgress& progress);

/// How many statements have a region, and in how many of them a fresh input failed.
struct StatementCounts {
  std::size_t regions = 0;
  std::size_t refuted = 0;
  std::size_t checks = 0;  ///< fresh inputs inside regions, all statements together
};
StatementCounts countsOf(const Atlas& atlas);

/// Writes into a folder, which the caller commits: for each map an EXR file with the largest error of each variant and
/// quantity and a PNG for each quantity; regions.csv and regions.json; atlas.md, index.html and run.json. `subfolder`
/// is where they go in it, empty for the folder itself. All but the last three depend on the plan alone.
void writeAtlas(const Atlas& atlas, const RunRecord& record, const ResultFolder& folder,
                const std::filesystem::path& subfolder = {});

}  // namespace irradiff
