#pragma once

#include "experiments/curves/cache_comparison.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace irradiff {

/// What the figures are made on; null leaves out those that need it.
struct PaperFields {
  const RecordField* box = nullptr;         ///< the Cornell box
  const RecordField* few_rays = nullptr;    ///< the same pixels with a sixteenth of the rays
  const RecordField* black_wall = nullptr;  ///< the box with a black back wall
  const RecordField* penumbra = nullptr;    ///< a room with an indirect penumbra
};

/// Figures 7 to 14 of [Schwarzhaupt et al. 2012], as far as there are fields for them, at `records` records where the
/// figure tunes. The same bits for any number of threads.
std::vector<CacheComparison> paperFigures(const PaperFields& fields, std::size_t records, unsigned threads,
                                          const std::function<void(std::size_t, std::size_t)>& progress = {});

}  // namespace irradiff
