#pragma once

#include "experiments/cache/placement.h"
#include "experiments/cache/record_field.h"
#include "experiments/figures/channel_pictures.h"

#include <cstddef>
#include <vector>

namespace irradiff {

/// Rows of the pictures of a flatland field, whose image is a line: a strip.
inline constexpr std::size_t kStripRows = 48;

/// Numbers of the receivers at their pixels, in black and grey where there is none. Amounts run from 0 to `limit`,
/// those beyond have its colour.
MapPicture amountPicture(const RecordField& field, const std::vector<double>& values, const std::string& name,
                         const std::string& title, const std::string& unit, double limit);

/// The amount that a share of the values that are finite does not exceed, rounded up to two digits.
double amountLimit(const std::vector<double>& values, double share = kShareWithinLimit);

/// The same in a logarithmic scale from `low` to `high`.
MapPicture radiusPicture(const RecordField& field, const std::vector<double>& radii, double low, double high);

/// log10 of a ratio, diverging about 1 (near white), from 1/10 (blue) to 10 (red).
MapPicture ratioPicture(const RecordField& field, const std::vector<double>& ratios, const std::string& name,
                        const std::string& title);

/// Where records are, as in Figures 8 and 16 of [Schwarzhaupt et al. 2012]: their footprints at a third of their size
/// over the irradiance in grey, green those that are round, dark blue those of the largest aspect.
MapPicture footprintPicture(const RecordField& field, const Placement& placement, double largest_aspect);

/// |error| of each receiver over the mean of the reference.
std::vector<double> relativeErrors(const RecordField& field, const std::vector<double>& irradiance);

/// radiusOf every receiver's own record.
std::vector<double> allRadii(const RecordField& field, const RecordMaker& records);

/// The image of a PNG: a strip for a line.
RgbImage shownImage(const RecordField& field, const std::vector<Rgb>& colours);

}  // namespace irradiff
