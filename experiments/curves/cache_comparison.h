#pragma once

#include "experiments/cache/image_error.h"
#include "experiments/cache/placement.h"
#include "experiments/cache/record_field.h"
#include "experiments/figures/channel_pictures.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace irradiff {

/// A way to run a cache that stands beside others in a figure.
struct CacheVariant {
  std::string label;
  const RecordField* field = nullptr;  ///< what it runs on
  MetricChoice choice;
  PlacementOptions options;
  std::optional<std::size_t> records;  ///< tuned to so many; nothing: at the threshold of `choice`
};

/// What came of it.
struct VariantResult {
  std::string label;
  std::string metric;
  std::string field;  ///< its name
  double threshold = 0.0;
  std::size_t asked_records = 0;  ///< 0: none, the threshold was given
  std::size_t records = 0;
  std::size_t rays = 0;
  bool is_within = true;
  ImageError error;
  Placement placement;
  std::vector<double> all_radii;  ///< of the record that each receiver would make
  MapPicture footprints;
  MapPicture radii;
  MapPicture errors;
};

/// Variants side by side: one of the figures of [Schwarzhaupt et al. 2012].
struct CacheComparison {
  std::string id;     ///< "figure8"
  std::string title;  ///< for people
  std::string question;
  std::vector<VariantResult> results;
  std::vector<std::string> findings;  ///< sentences made of numbers
};

/// Runs all variants, several at a time; pictures share their scales. The same bits for any number of threads.
std::vector<VariantResult> runVariants(const std::vector<CacheVariant>& variants, unsigned threads,
                                       const std::function<void(std::size_t, std::size_t)>& progress = {});

/// How alike two distributions of records over the same receivers are.
struct DistributionLikeness {
  double radius_correlation = 0.0;  ///< of log radii, over receivers where both are finite; NaN where one is constant
  /// Half the sum over cells of |share of the records of one - share of those of the other|: 0 alike, 1 disjoint.
  double density_difference = 0.0;
  /// The mean of the same for records thrown independently with one common density. Records of a cache keep their
  /// distance, so that equal densities stay below.
  double chance_difference = 0.0;
};

inline constexpr std::size_t kDensityCells = 12;  ///< along the longer side of the image

/// Of two fields with the same image and receivers. Requires records in both.
DistributionLikeness likeness(const RecordField& field, const std::vector<double>& radii, const Placement& placement,
                              const std::vector<double>& other_radii, const Placement& other_placement);

}  // namespace irradiff
