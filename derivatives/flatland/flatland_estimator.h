#pragma once

#include "derivatives/flatland/flatland_estimate.h"
#include "derivatives/flatland/flatland_samples.h"

#include <span>
#include <string_view>

namespace irradiff {

/// The names of the flatland estimators, those of their counterparts in space, in the order of tables.
std::span<const std::string_view> flatlandEstimatorNames();

/// What the estimator of this name makes of the samples; every number is finite. Throws std::invalid_argument for an
/// unknown name, for samples that are not one for each stratum, and for strata that the estimator does not take, naming
/// what was given and the rule; std::overflow_error as requireFinite(). Requires samples as FlatlandSamples holds.
FlatlandEstimate estimateFlatland(std::string_view name, const FlatlandSamples& samples);

}  // namespace irradiff
