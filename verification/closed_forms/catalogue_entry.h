#pragma once

#include "verification/closed_forms/closed_forms.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// How the entries of closedForms() and closedFormsBetweenAreas() are put together. Private to this room.

namespace irradiff::closed_forms {

/// Throws std::invalid_argument as CatalogueEntry documents.
void checkParameters(std::string_view title, std::span<const ParameterRange> ranges, std::span<const double> values);

/// A polygon with radiance 1.
Polygon polygonOf(std::string_view title, std::vector<Eigen::Vector3d> vertices);

/// Half-length at which a strip that the formula takes as endless is cut, for a receiver at y = 0 or on a segment of
/// length 1 about it, when no point of the strip's cross-section is farther than `distance` from the receiver.
///
/// What is cut off is at most kStripError of F: the integrand is g/(rho^2 + y^2)^2 with g >= 0 and rho <= distance
/// independent of y, so F >= int pi g/(2 distance^3) and the tails are <= int 2 g/(3 (L - 1)^3) over the cross-section;
/// their ratio is below (distance/(L - 1))^3 and L >= 2^20 max(distance, 1).
double stripHalfLength(double distance);
inline constexpr double kStripError = 0x1p-59;

/// Checks the parameters once for all three functions. `formula` takes a span of 100-digit parameters.
template <class Receiving, class Formula, class Configuration>
CatalogueEntry<Receiving> makeEntry(std::string_view number, std::string_view title, std::string_view source,
                                    const std::vector<ParameterRange>& ranges, Formula formula,
                                    Configuration configuration, double configuration_error = 0.0) {
  CatalogueEntry<Receiving> entry;
  entry.catalogue_number = number;
  entry.title = title;
  entry.source = source;
  entry.parameters = ranges;
  entry.configuration_error = configuration_error;
  entry.value_at_100_digits = [title, ranges, formula](std::span<const double> values) {
    checkParameters(title, ranges, values);
    const std::vector<HundredDigits> digits(values.begin(), values.end());
    return formula(std::span<const HundredDigits>(digits));
  };
  entry.value = [at_100_digits = entry.value_at_100_digits](std::span<const double> values) {
    return at_100_digits(values).template convert_to<double>();
  };
  entry.configuration = [title, ranges, configuration](std::span<const double> values) {
    checkParameters(title, ranges, values);
    auto [vertices, receiving] = configuration(values);
    return std::pair<Polygon, Receiving>(polygonOf(title, std::move(vertices)), std::move(receiving));
  };
  return entry;
}

}  // namespace irradiff::closed_forms
