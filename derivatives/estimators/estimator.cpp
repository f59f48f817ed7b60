#include "derivatives/estimators/estimator.h"

#include "derivatives/estimators/discontinuity.h"
#include "derivatives/estimators/geometric.h"
#include "derivatives/estimators/hemicube.h"
#include "derivatives/estimators/hemicube_texel.h"
#include "derivatives/estimators/radiometric.h"
#include "derivatives/estimators/triangulated.h"
#include "derivatives/estimators/ward_heckbert.h"
#include "derivatives/samples/strata.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace irradiff {

namespace {

enum class Takes { kAllStrata, kHemicubesOnly };

struct CatalogueEntry {
  EstimatorDescription description;
  Takes takes;
  std::unique_ptr<Estimator> (*make)(Stratification, GridShape);
};

/// In the order of tables.
constexpr std::array kCatalogue{
    CatalogueEntry{{"ward-heckbert", "Ward and Heckbert 1992, rotation and translation gradients"},
                   Takes::kAllStrata,
                   makeWardHeckbert},
    CatalogueEntry{{"hemicube-texel", "Castaño 2011, Translation Gradients, first approach"},
                   Takes::kHemicubesOnly,
                   makeHemicubeTexel},
    CatalogueEntry{
        {"hemicube", "Castaño 2011, Translation Gradients, second approach"}, Takes::kHemicubesOnly, makeHemicube},
    CatalogueEntry{{"triangulated", "Schwarzhaupt et al. 2012, section 4.1, Eqs. (8) to (10)"},
                   Takes::kAllStrata,
                   makeTriangulated},
    CatalogueEntry{
        {"triangulated-closed", "Schwarzhaupt et al. 2012, section 4.1, with the mesh continued to the horizon"},
        Takes::kAllStrata,
        makeTriangulatedClosed},
    CatalogueEntry{{"radiometric", "Jarosz et al. 2012, occlusion-unaware Hessian; Schwarzhaupt et al. 2012, Figure 5"},
                   Takes::kAllStrata,
                   makeRadiometric},
    CatalogueEntry{{"geometric", "Jarosz et al. 2012, geometric Hessian; Schwarzhaupt et al. 2012, section 3"},
                   Takes::kAllStrata,
                   makeGeometric},
    CatalogueEntry{
        {"discontinuity", "irradiff, docs/derivations/discontinuity_estimator.md: edges traced along radiance jumps"},
        Takes::kAllStrata,
        makeDiscontinuity},
};

constexpr std::array kDescriptions = [] {
  std::array<EstimatorDescription, kCatalogue.size()> descriptions;
  for (std::size_t i = 0; i < kCatalogue.size(); ++i) descriptions[i] = kCatalogue[i].description;
  return descriptions;
}();

const CatalogueEntry& entryOf(std::string_view name) {
  const auto* const found = std::find_if(kCatalogue.begin(), kCatalogue.end(), [name](const CatalogueEntry& entry) {
    return entry.description.name == name;
  });
  if (found != kCatalogue.end()) return *found;
  std::ostringstream message;
  message << "unknown estimator \"" << name << "\": must be one of";
  for (const CatalogueEntry& entry : kCatalogue) {
    message << (&entry == kCatalogue.begin() ? " " : ", ") << entry.description.name;
  }
  throw std::invalid_argument(message.str());
}

/// Another estimator behind checks of what it requires and promises.
class CheckedEstimator final : public Estimator {
 public:
  CheckedEstimator(std::string_view name, Stratification stratification, GridShape shape,
                   std::unique_ptr<Estimator> estimator)
      : name_(name), stratification_(stratification), shape_(shape), estimator_(std::move(estimator)) {}

  IrradianceEstimate estimate(const HemisphereSamples& samples) const override {
    if (samples.stratification != stratification_ || !(samples.shape == shape_)) {
      throw std::invalid_argument("estimator " + std::string(name_) + ": made for " +
                                  describe(stratification_, shape_) + " samples, given " +
                                  describe(samples.stratification, samples.shape) + " ones");
    }
    IrradianceEstimate estimate = estimator_->estimate(samples);
    if (!estimate.isFinite()) throw std::overflow_error(overflowMessage(samples));
    return estimate;
  }

 private:
  static std::string describe(Stratification stratification, GridShape shape) {
    return std::to_string(shape.rows) + " x " + std::to_string(shape.columns) + " " +
           std::string(nameOf(stratification));
  }

  std::string overflowMessage(const HemisphereSamples& samples) const {
    const auto largestOf = [](const std::vector<double>& values) {
      return std::max_element(values.begin(), values.end()) - values.begin();
    };
    const auto nearest = largestOf(samples.inverse_distance);
    const auto brightest = largestOf(samples.radiance);
    std::ostringstream message;
    message << "estimator " << name_ << ": the result is beyond the range of double; the nearest hit is sample "
            << nearest << " with inverse distance " << samples.inverse_distance[static_cast<std::size_t>(nearest)]
            << ", the brightest is sample " << brightest << " with radiance "
            << samples.radiance[static_cast<std::size_t>(brightest)];
    return message.str();
  }

  std::string_view name_;
  Stratification stratification_;
  GridShape shape_;
  std::unique_ptr<Estimator> estimator_;
};

}  // namespace

std::span<const EstimatorDescription> estimatorDescriptions() { return kDescriptions; }

std::unique_ptr<Estimator> makeEstimator(std::string_view name, Stratification stratification, GridShape shape) {
  const CatalogueEntry& entry = entryOf(name);
  if (entry.takes == Takes::kHemicubesOnly && stratification != Stratification::kHemicube) {
    throw std::invalid_argument("estimator " + std::string(name) + ": takes hemicube samples only, given " +
                                std::string(nameOf(stratification)) + " ones");
  }
  return std::make_unique<CheckedEstimator>(entry.description.name, stratification, shape,
                                            entry.make(stratification, shape));
}

}  // namespace irradiff
