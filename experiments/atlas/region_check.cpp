#include "experiments/atlas/region_check.h"

#include "experiments/atlas/event_map.h"
#include "verification/checks/random.h"
#include "verification/report/parallel_tasks.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

namespace irradiff {
namespace {

constexpr std::size_t kProbesInTask = 64;

using Regions = std::vector<const SafeRegion*>;

Regions regionsOf(const StabilityMap& map, const std::vector<SafetyStatement>& statements) {
  Regions regions;
  for (const SafetyStatement& statement : statements) {
    if (statement.map == map.file && statement.region) regions.push_back(&*statement.region);
  }
  return regions;
}

double anywhereOn(const AtlasAxis& axis, KeyedRandom& random) {
  return axis.low * std::pow(axis.high / axis.low, random.unit());
}

/// The place moved along one axis until the inequality holds by a factor of up to half a decade.
std::array<double, 2> movedInside(const SizeInequality& bound, std::array<double, 2> place, KeyedRandom& random) {
  const std::array<int, 2> powers = {bound.x_power, bound.y_power};
  std::size_t moved = random.below(2);
  if (powers[moved] == 0) moved = 1 - moved;
  const double rest = std::pow(place[1 - moved], powers[1 - moved]);
  const double slack = std::pow(random.decade(0.0, 0.5), bound.is_at_least ? 1.0 : -1.0);
  place[moved] = std::pow(bound.bound * slack / rest, 1.0 / powers[moved]);
  return place;
}

std::array<double, 2> drawPlace(const StabilityMap& map, const Regions& regions, KeyedRandom& random) {
  const auto anywhere = [&] {
    const double x = anywhereOn(map.x, random);
    const double y = anywhereOn(map.y, random);
    return std::array<double, 2>{x, y};
  };
  const auto is_in_map = [&](const std::array<double, 2>& place) {
    return place[0] >= map.x.low && place[0] <= map.x.high && place[1] >= map.y.low && place[1] <= map.y.high;
  };
  if (regions.empty() || random.below(2) == 0) return anywhere();
  for (int attempt = 0; attempt < 32; ++attempt) {
    const SafeRegion& region = *regions[random.below(regions.size())];
    if (region.inequalities.empty()) continue;
    const SizeInequality& bound = region.inequalities[random.below(region.inequalities.size())];
    const std::array<double, 2> place = movedInside(bound, anywhere(), random);
    if (is_in_map(place) && region.contains(place[0], place[1])) return place;
  }
  return anywhere();
}

ErrorProbe errorsOf(std::size_t map, const std::array<double, 2>& place, KeyedRandom& random) {
  const auto [x, y] = place;
  if (map == polygonMaps().size()) return probeScene(drawNearEvent(random, x, y), x, y);
  const PolygonMap& polygons = polygonMaps()[map];
  return probeAt(polygons, polygons.draw(random, x, y), x, y, formulaVariants());
}

std::size_t cellOn(const AtlasAxis& axis, std::size_t cells, double value) {
  const double place = std::log(value / axis.low) / std::log(axis.high / axis.low) * static_cast<double>(cells);
  return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(cells) - 0.5));
}

}  // namespace

std::vector<RegionProbe> probeRegions(const std::vector<StabilityMap>& maps,
                                      const std::vector<SafetyStatement>& statements, const RegionProbes& probes,
                                      unsigned threads, const QualityProgress& progress) {
  std::vector<RegionProbe> result;
  std::vector<std::function<void()>> tasks;
  std::vector<Regions> regions;
  for (const StabilityMap& map : maps) regions.push_back(regionsOf(map, statements));
  for (std::size_t m = 0; m < maps.size(); ++m) {
    const std::size_t count = m < polygonMaps().size() ? probes.polygon_inputs : probes.scene_inputs;
    for (std::size_t i = 0; i < count; ++i) result.push_back({m, {}, {}});
  }
  for (std::size_t first = 0; first < result.size(); first += kProbesInTask) {
    tasks.emplace_back([&, first] {
      for (std::size_t i = first; i < std::min(result.size(), first + kProbesInTask); ++i) {
        RegionProbe& probe = result[i];
        KeyedRandom random(probes.seed, probes.stream, i);
        probe.drawn = drawPlace(maps[probe.map], regions[probe.map], random);
        probe.found = errorsOf(probe.map, probe.drawn, random);
      }
    });
  }
  runTasks(tasks, threads, [&](std::size_t done, std::size_t all) {
    if (progress) progress("fresh inputs in safe regions", done, all);
  });
  return result;
}

void countViolations(const std::vector<StabilityMap>& maps, const std::vector<RegionProbe>& probes,
                     std::vector<SafetyStatement>& statements) {
  for (SafetyStatement& statement : statements) {
    statement.checked = statement.violations = 0;
    if (!statement.region) continue;
    const auto map = static_cast<std::size_t>(
        std::ranges::find(maps, statement.map, [](const StabilityMap& m) { return m.file; }) - maps.begin());
    const std::vector<VariantErrors>& variants = maps.at(map).variants;
    const auto variant = static_cast<std::size_t>(std::ranges::find_if(variants,
                                                                       [&](const VariantErrors& v) {
                                                                         return v.formula == statement.formula &&
                                                                                v.scalar == statement.scalar;
                                                                       }) -
                                                  variants.begin());
    for (const RegionProbe& probe : probes) {
      if (probe.map != map) continue;
      const double error = probe.found.errors.at(variant)[statement.quantity];
      const auto& [x, y] = statement.scalar == ScalarType::kFloat ? probe.found.float_place : probe.found.place;
      if (std::isnan(error) || !statement.region->contains(x, y)) continue;
      ++statement.checked;
      if (error > statement.tolerance) ++statement.violations;
    }
  }
}

void raisePeaks(const std::vector<RegionProbe>& probes, std::vector<StabilityMap>& maps) {
  for (const RegionProbe& probe : probes) {
    StabilityMap& map = maps[probe.map];
    const std::size_t cell =
        cellOn(map.y, map.cells, probe.drawn[1]) * map.cells + cellOn(map.x, map.cells, probe.drawn[0]);
    for (std::size_t v = 0; v < map.variants.size(); ++v) {
      for (std::size_t q = 0; q < kAtlasQuantities; ++q) {
        double& peak = map.variants[v].peak[q][cell];
        peak = worseError(peak, probe.found.errors[v][q]);
      }
    }
  }
}

}  // namespace irradiff
