#pragma once

#include "experiments/cache/cache_record.h"
#include "experiments/cache/record_field.h"
#include "experiments/figures/channel_pictures.h"

#include <cstddef>
#include <span>

namespace irradiff {

/// Of the half-axes, so that footprints seldom overlap: Figure 16 of [Schwarzhaupt et al. 2012].
inline constexpr double kFootprintShare = 0.45;

struct FootprintOptions {
  double largest_aspect = 2.0;  ///< has the darkest blue; circles are green, as in Figure 8
  /// Each pixel of the field becomes that many squared, between whose receivers is interpolated on their face.
  std::size_t enlargement = 1;
};

/// Where records are, on a grey picture of the field's true irradiance (black at 0, white at its maximum): the outline
/// of each region at kFootprintShare of its size, filled with the colour of its eccentricity. A record is drawn where
/// its region meets a surface that turns by less than kDefaultNormalDeviation from its own. Row 0 of the field is the
/// topmost; pixels without a receiver have kNoValueColour. Throws std::invalid_argument naming the value and the rule
/// unless the aspect is above 1 and the enlargement 1 to 16, and as IrradianceCache::add.
MapPicture footprintPicture(const RecordField& field, std::span<const CacheRecord> records,
                            const FootprintOptions& options = {});

}  // namespace irradiff
