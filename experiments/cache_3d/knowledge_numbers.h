#pragma once

#include "derivatives/error_metric/reprojection.h"
#include "experiments/cache_3d/metric_records.h"

#include <cstddef>
#include <span>
#include <vector>

namespace irradiff {

/// How many numbers a RecordKnowledge is.
inline constexpr std::size_t kKnowledgeNumbers = 15 + 10 * kRadianceShares.size();

// For tiles of finished work: appends kKnowledgeNumbers numbers, and reads them again.
void appendNumbers(const RecordKnowledge& known, std::vector<double>& numbers);
RecordKnowledge knowledgeOf(std::span<const double, kKnowledgeNumbers> numbers);

/// How many numbers a ReprojectedError is, but for its distances, which a field knows.
constexpr std::size_t reprojectionNumbers(std::size_t directions, std::size_t distances) {
  return directions * (distances + 2);
}

// The same for these; `numbers` are reprojectionNumbers() of them.
void appendNumbers(const ReprojectedError& error, std::vector<double>& numbers);
ReprojectedError reprojectedErrorOf(std::span<const double> numbers, std::size_t directions,
                                    std::vector<double> distances);

}  // namespace irradiff
