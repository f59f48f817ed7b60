#pragma once

#include "experiments/cache/image_error.h"
#include "experiments/cache/placement.h"
#include "experiments/cache/record_field.h"
#include "experiments/curves/record_scene.h"
#include "verification/report/result_folder.h"
#include "verification/report/run_record.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace irradiff {

/// One irradiance cache on one scene.
struct CacheRun {
  const RecordField* field = nullptr;
  MetricChoice choice;  ///< with the threshold that was given or found
  PlacementOptions options;
  std::optional<std::size_t> asked_records;
  bool is_within = true;  ///< the count is within kRecordTolerance of what was asked for
  Placement placement;

  /// Receivers that some record serves: all unless the limit of records was reached.
  std::size_t served() const;
  /// Records whose region has no border, since the metric's Hessian is zero there: one serves all receivers whose
  /// normals are near its own.
  std::size_t unlimitedRecords() const;
  /// Over the receivers that are served.
  ImageError error() const;
};

/// At the threshold of `choice`, or tuned from there on to a number of records. Throws std::invalid_argument naming the
/// number where it is more than the receivers.
CacheRun runCache(const RecordField& field, const MetricChoice& choice, const PlacementOptions& options,
                  std::optional<std::size_t> records);

/// What was found, in sentences for people.
std::vector<std::string> runSentences(const CacheRun& run);

/// Writes irradiance.exr (channels irradiance, reference, error, radius; 32-bit floats), irradiance.png,
/// footprints.png, radii.png, error.png, records.csv, summary.json, index.html and run.json into the folder, which the
/// caller commits. All but the last two depend on the scene and the options alone.
void writeCacheRun(const CacheRun& run, const RecordScene& scene, const RunRecord& record,
                   const nlohmann::ordered_json& configuration, const nlohmann::ordered_json& seed,
                   const ResultFolder& folder);

}  // namespace irradiff
