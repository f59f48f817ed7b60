#pragma once

#include "experiments/figures/channel_pictures.h"
#include "experiments/figures/derivative_map.h"
#include "experiments/figures/estimate_errors.h"
#include "experiments/figures/estimate_map.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

/// A column of a comparison: one quantity, exact or as an estimator has it.
struct FigureColumn {
  Compared compared = Compared::kGradient;
  std::string source;  ///< "analytic" or the estimator
  MapPicture picture;
  std::optional<MapPicture> difference;  ///< from the truth; nothing for the truth itself
  std::optional<ErrorSummary> errors;
  std::vector<std::string> channels;  ///< that belong to it, of comparedChannels()
};

/// Columns for the gradient, the eigenvalues of the Hessian in space and the tangential Hessian: of each the truth,
/// then the estimators that know it, in their order. A quantity that no estimator knows, or that exists nowhere, is
/// left out. All columns of a
/// quantity and their differences have the truth's limits. Pictures are named "gradient.triangulated" and
/// "gradient.triangulated.difference".
std::vector<FigureColumn> figureColumns(const DerivativeMap& truth, std::span<const EstimateMap> estimates);

/// What the estimators know as channels of a map, each behind the estimator's name, "triangulated.gradient.x", with its
/// relative errors, "triangulated.error.gradient" (relativeErrors()).
std::vector<MapChannel> comparedChannels(const DerivativeMap& truth, std::span<const EstimateMap> estimates);

}  // namespace irradiff
