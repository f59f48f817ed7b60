#pragma once

#include "experiments/cache/record_field.h"
#include "experiments/figures/channel_pictures.h"

#include <span>

namespace irradiff {

// Pictures of a field, a pixel for each of its own; row 0 is the topmost, pixels without a receiver have
// kNoValueColour, and those beyond the scale the colour of its end. The scale is given, so that pictures can be
// compared. Throw std::invalid_argument naming it unless it is finite and positive (a range: 0 < low < high), and as
// many values are given as there are receivers.

/// Irradiance from 0 to `most`, W/m^2. NaN, where no record serves a receiver, has kNoValueColour too.
MapPicture irradiancePicture(const RecordField& field, std::span<const double> irradiance, double most);

/// Irradiance minus the reference over the reference's mean, from -`most` (blue) to `most` (red).
MapPicture errorPicture(const RecordField& field, std::span<const double> irradiance, double most);

/// The geometric mean of both half-axes of the record that each receiver would make, its logarithm evenly from that of
/// `low` metres to that of `high`, both to two digits outwards: Figures 7 and 16 of [Schwarzhaupt et al. 2012].
MapPicture radiusPicture(const RecordField& field, const RecordMaker& records, double low, double high);

}  // namespace irradiff
