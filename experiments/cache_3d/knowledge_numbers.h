#pragma once

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

}  // namespace irradiff
