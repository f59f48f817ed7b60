#include "derivatives/flatland/flatland_estimator.h"

#include "derivatives/flatland/discontinuity.h"
#include "derivatives/flatland/sample_polyline.h"
#include "derivatives/flatland/strata_patches.h"
#include "derivatives/flatland/strata_walls.h"

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace irradiff {

namespace {

enum class Takes { kAllStrata, kSquaresOnly };

struct CatalogueEntry {
  std::string_view name;
  Takes takes;
  FlatlandEstimate (*estimate)(const FlatlandSamples&);
};

/// In the order of tables.
constexpr std::array kCatalogue{CatalogueEntry{"ward-heckbert", Takes::kAllStrata, estimateWardHeckbert},
                                CatalogueEntry{"hemicube-texel", Takes::kSquaresOnly, estimateHemicubeTexel},
                                CatalogueEntry{"hemicube", Takes::kSquaresOnly, estimateHemicube},
                                CatalogueEntry{"triangulated", Takes::kAllStrata, estimateTriangulated},
                                CatalogueEntry{"triangulated-closed", Takes::kAllStrata, estimateTriangulatedClosed},
                                CatalogueEntry{"radiometric", Takes::kAllStrata, estimateRadiometric},
                                CatalogueEntry{"geometric", Takes::kAllStrata, estimateGeometric},
                                CatalogueEntry{"discontinuity", Takes::kAllStrata, estimateDiscontinuity}};

constexpr std::array kNames = [] {
  std::array<std::string_view, kCatalogue.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kCatalogue[i].name;
  return names;
}();

const CatalogueEntry& entryOf(std::string_view name) {
  for (const CatalogueEntry& entry : kCatalogue) {
    if (entry.name == name) return entry;
  }
  std::string message = "unknown flatland estimator \"" + std::string(name) + "\": must be one of";
  for (const std::string_view known : kNames) message.append(known == kNames.front() ? " " : ", ").append(known);
  throw std::invalid_argument(message);
}

}  // namespace

std::span<const std::string_view> flatlandEstimatorNames() { return kNames; }

FlatlandEstimate estimateFlatland(std::string_view name, const FlatlandSamples& samples) {
  const CatalogueEntry& entry = entryOf(name);
  const std::string prefix = "flatland estimator " + std::string(name) + ": ";
  if (samples.hits.size() != samples.strata.count() || samples.directions.size() != samples.strata.count()) {
    throw std::invalid_argument(prefix + "given " + std::to_string(samples.directions.size()) + " directions and " +
                                std::to_string(samples.hits.size()) + " hits, must be one for each of the " +
                                std::to_string(samples.strata.count()) + " strata");
  }
  if (entry.takes == Takes::kSquaresOnly && samples.strata.stratification() != FlatlandStratification::kSquare) {
    throw std::invalid_argument(prefix + "takes square samples only, given cosine ones");
  }
  FlatlandEstimate estimate = entry.estimate(samples);
  requireFinite(name, estimate, samples.hits);
  return estimate;
}

}  // namespace irradiff
