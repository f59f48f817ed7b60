#pragma once

#include "experiments/atlas/stability_map.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace irradiff {

/// x^x_power y^y_power >= bound, or <= bound: a straight line in a map, whose axes are logarithmic.
struct SizeInequality {
  int x_power = 0;
  int y_power = 0;
  bool is_at_least = true;
  double bound = 0.0;

  bool holds(double x, double y) const;
};

/// Where a variant's error is at most a tolerance: in that part of a map where all inequalities hold.
struct SafeRegion {
  std::vector<SizeInequality> inequalities;
  double share = 0.0;  ///< of the map's area

  bool contains(double x, double y) const;
};

/// What a map says about one variant and quantity: no region is "nowhere".
struct SafetyStatement {
  std::string map;
  std::string formula;
  ScalarType scalar = ScalarType::kDouble;
  std::size_t quantity = 0;
  double tolerance = 0.0;
  std::optional<SafeRegion> region;
  /// Fresh inputs inside the region, and those of them whose error is above the tolerance.
  std::size_t checked = 0;
  std::size_t violations = 0;
};

inline constexpr std::array<double, 3> kAtlasTolerances = {1e-3, 1e-6, 1e-12};

/// A cell counts as safe only where its largest error is this many times below the tolerance, and no neighbour's is
/// above the tolerance: inputs that were not drawn are worse than those that were.
inline constexpr double kSafetyMargin = 10.0;

/// Regions of less than this share of a map are nowhere.
inline constexpr double kLeastShare = 0.01;

/// What an inequality more must add to a region to be worth its length.
inline constexpr double kWorthOfInequality = 0.1;

/// The largest part of a map, cut out by a rectangle and at most one slanted line, in which every cell is safe. The
/// slopes offered are those that products of powers of distances and sines make: +-1, +-2 and +-1/2. Bounds at the
/// edges of the map itself are left out; the others are rounded to two digits, inwards. `errors` as in VariantErrors.
std::optional<SafeRegion> largestSafeRegion(const StabilityMap& map, const std::vector<double>& errors,
                                            double tolerance);

/// All statements of the maps, for each variant, quantity and tolerance. Results do not depend on threads.
std::vector<SafetyStatement> safetyStatements(const std::vector<StabilityMap>& maps, unsigned threads,
                                              const QualityProgress& progress);

/// "edge/distance >= 0.032 and edge/distance * sin(grazing angle) >= 1e-05"; "everywhere", "nowhere".
std::string textOf(const std::optional<SafeRegion>& region, const AtlasAxis& x, const AtlasAxis& y);

}  // namespace irradiff
