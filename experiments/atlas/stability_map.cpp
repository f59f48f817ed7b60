#include "experiments/atlas/stability_map.h"

#include "verification/checks/random.h"
#include "verification/report/parallel_tasks.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace irradiff {
namespace {

constexpr double kNotHeld = std::numeric_limits<double>::quiet_NaN();

/// For each column, variant and quantity.
std::vector<double> peaksOfRow(const StabilityMap& map, std::size_t row, std::uint64_t seed,
                               const ErrorsAt& errors_at) {
  std::vector<double> peaks(map.cells * map.variants.size() * kAtlasQuantities, 0.0);
  for (std::size_t column = 0; column < map.cells; ++column) {
    double* const cell = peaks.data() + column * map.variants.size() * kAtlasQuantities;
    for (std::size_t sample = 0; sample < map.samples; ++sample) {
      KeyedRandom random(seed, map.file, (row * map.cells + column) * map.samples + sample);
      const auto [x, y] = placeInCell(random, map.x, map.y, map.cells, column, row);
      const std::vector<AtlasErrors> errors = errors_at(random, x, y);
      for (std::size_t i = 0; i < errors.size() * kAtlasQuantities; ++i) {
        cell[i] = worseError(cell[i], errors[i / kAtlasQuantities][i % kAtlasQuantities]);
      }
    }
  }
  return peaks;
}

double placeOnAxis(const AtlasAxis& axis, double fraction) {
  return axis.low * std::pow(axis.high / axis.low, fraction);
}

}  // namespace

double worseError(double a, double b) { return std::isnan(a) || std::isnan(b) ? kNotHeld : std::max(a, b); }

std::array<double, 2> placeInCell(KeyedRandom& random, const AtlasAxis& x, const AtlasAxis& y, std::size_t cells,
                                  std::size_t column, std::size_t row) {
  const auto fraction = [&](std::size_t index) {
    return (static_cast<double>(index) + random.unit()) / static_cast<double>(cells);
  };
  const double at_x = placeOnAxis(x, fraction(column));
  const double at_y = placeOnAxis(y, fraction(row));
  return {at_x, at_y};
}

ErrorProbe probeAt(const PolygonMap& map, const Configuration& input, double x, double y,
                   std::span<const FormulaVariant> variants) {
  const Configuration in_float = roundedToFloat(input);
  const auto truthOf = [&](const Configuration& c) {
    return isHeld(map, c, x, y) ? std::optional(trueFormFactor(c)) : std::nullopt;
  };
  const std::optional<FormFactor<Multiprecision>> truth = truthOf(input);
  const std::optional<FormFactor<Multiprecision>> float_truth = truthOf(in_float);
  ErrorProbe probe{{}, map.measure(input), map.measure(in_float)};
  probe.errors.reserve(variants.size());
  for (const FormulaVariant& variant : variants) {
    const bool is_float = variant.scalar == ScalarType::kFloat;
    const std::optional<FormFactor<Multiprecision>>& expected = is_float ? float_truth : truth;
    const Configuration& given = is_float ? in_float : input;
    probe.errors.push_back(expected ? relativeErrors(variant.evaluate(given.polygon, given.receiver), *expected)
                                    : AtlasErrors{kNotHeld, kNotHeld, kNotHeld});
  }
  return probe;
}

StabilityMap emptyMap(const PolygonMap& map, const AtlasPlan& plan) {
  StabilityMap result{map.file, map.title, map.description, map.x, map.y, plan.cells, plan.samples, {}};
  for (const FormulaVariant& variant : formulaVariants()) {
    VariantErrors errors{variant.formula, variant.scalar, {}};
    for (std::vector<double>& peak : errors.peak) peak.resize(plan.cells * plan.cells);
    result.variants.push_back(std::move(errors));
  }
  return result;
}

void fillRow(StabilityMap& map, std::size_t row, std::uint64_t seed, const ErrorsAt& errors_at,
             const TileStore* finished, std::size_t tile) {
  std::optional<std::vector<double>> peaks;
  if (finished != nullptr) peaks = finished->read(tile, map.cells * map.variants.size() * kAtlasQuantities);
  if (!peaks) {
    peaks = peaksOfRow(map, row, seed, errors_at);
    if (finished != nullptr) finished->write(tile, *peaks);
  }
  std::size_t next = 0;
  for (std::size_t column = 0; column < map.cells; ++column) {
    for (VariantErrors& variant : map.variants) {
      for (std::vector<double>& peak : variant.peak) peak[row * map.cells + column] = (*peaks)[next++];
    }
  }
}

std::vector<StabilityMap> polygonStability(const AtlasPlan& plan, unsigned threads, const TileStore* finished,
                                           const QualityProgress& progress) {
  const std::vector<PolygonMap>& maps = polygonMaps();
  std::vector<StabilityMap> result;
  for (const PolygonMap& map : maps) result.push_back(emptyMap(map, plan));
  std::vector<std::function<void()>> tasks;
  for (std::size_t i = 0; i < maps.size() * plan.cells; ++i) {
    tasks.emplace_back([&, i] {
      const PolygonMap& map = maps[i / plan.cells];
      const auto errors_at = [&map](KeyedRandom& random, double x, double y) {
        return probeAt(map, map.draw(random, x, y), x, y, formulaVariants()).errors;
      };
      fillRow(result[i / plan.cells], i % plan.cells, plan.seed, errors_at, finished, i);
    });
  }
  runTasks(tasks, threads, [&](std::size_t done, std::size_t all) {
    if (progress) progress("errors of polygon formulas", done, all);
  });
  return result;
}

}  // namespace irradiff
