#pragma once

#include "experiments/atlas/polygon_map.h"
#include "experiments/atlas/true_form_factor.h"
#include "experiments/figures/quality_figure.h"
#include "experiments/figures/tile_store.h"
#include "verification/variants/formula_variants.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

/// How finely an atlas is made.
struct AtlasPlan {
  std::size_t cells = 24;   ///< along each axis of a map, evenly in the logarithm
  std::size_t samples = 4;  ///< inputs in a cell, at random places in it
  std::size_t event_cells = 12;
  std::size_t event_samples = 2;
  /// How often, at most, fresh inputs are drawn inside the safe regions, and regions in which one fails found anew.
  std::size_t rounds = 8;
  std::size_t round_inputs = 300;  ///< for each map of polygon formulas
  std::size_t event_round_inputs = 50;
  std::uint64_t seed = 1;
};

/// The largest relative error of one variant in each cell of a map, quantity by quantity. Cells are row-major, the
/// smallest y first. Infinite where a result was not finite, or the variant refused; NaN where an input of the cell is
/// not held by the variant's coordinates.
struct VariantErrors {
  std::string formula;
  ScalarType scalar = ScalarType::kDouble;
  std::array<std::vector<double>, kAtlasQuantities> peak;

  std::string name() const { return formula + ", " + nameOf(scalar); }
};

struct StabilityMap {
  std::string file;
  std::string title;
  std::string description;
  AtlasAxis x, y;
  std::size_t cells = 0;    ///< along each axis
  std::size_t samples = 0;  ///< in each cell
  std::vector<VariantErrors> variants;
};

/// What each variant makes of one input, in the order of the map's variants: NaN where the place is not held, as in
/// VariantErrors.
struct ErrorProbe {
  std::vector<AtlasErrors> errors;
  /// Where the input is in the map; for float variants after the rounding to float.
  std::array<double, 2> place{};
  std::array<double, 2> float_place{};
};

/// Float variants are given the input rounded to float. Throws as trueFormFactor.
ErrorProbe probeAt(const PolygonMap& map, const Configuration& input, double x, double y,
                   std::span<const FormulaVariant> variants);

/// The larger of two errors; NaN if one is.
double worseError(double a, double b);

/// A place within the cell (column, row) of `cells` x `cells`, drawn evenly in the logarithm.
std::array<double, 2> placeInCell(KeyedRandom& random, const AtlasAxis& x, const AtlasAxis& y, std::size_t cells,
                                  std::size_t column, std::size_t row);

/// The errors of the map's variants at one input, drawn for the place (x, y).
using ErrorsAt = std::function<std::vector<AtlasErrors>(KeyedRandom& random, double x, double y)>;

/// Puts the largest errors of a row of cells into the map, from tile `tile` of `finished` where it is there, and there
/// if not; `finished` may be null. Rows may be filled from several threads, each by one.
void fillRow(StabilityMap& map, std::size_t row, std::uint64_t seed, const ErrorsAt& errors_at,
             const TileStore* finished, std::size_t tile);

/// The map of all polygon variants with errors of 0.
StabilityMap emptyMap(const PolygonMap& map, const AtlasPlan& plan);

/// The maps of all polygon variants, in the order of polygonMaps(). Rows that `finished` has are taken from there, the
/// others put there; it may be null. Results do not depend on threads.
std::vector<StabilityMap> polygonStability(const AtlasPlan& plan, unsigned threads, const TileStore* finished,
                                           const QualityProgress& progress);

}  // namespace irradiff
