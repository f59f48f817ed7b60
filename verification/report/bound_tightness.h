#pragma once

#include "derivatives/boundary/scene_evaluation_result.h"
#include "derivatives/form_factor/polygon_evaluation.h"
#include "verification/checks/candidate.h"
#include "verification/checks/configuration.h"
#include "verification/checks/flatland_inputs.h"
#include "verification/occlusion/occluded_scene.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace irradiff {

/// What gives numbers with bounds, of radiance 1 where it is asked for a single source. What it does not know is empty.
struct BoundedEvaluator {
  std::string name;
  std::function<PolygonEvaluation(const Configuration&)> polygon;
  std::function<SceneEvaluation<3>(const OccludedScene&)> scene;
  std::function<SceneEvaluation<2>(const FlatlandConfiguration&)> segment;
};

/// The production path, then the rungs of certified precision.
std::vector<BoundedEvaluator> boundedEvaluators();

enum class TightnessInputs { kPolygons, kScenes, kSegments };

/// "polygons", "scenes" or "segments".
const char* nameOf(TightnessInputs inputs);

/// Reported bounds over actual errors, of one quantity over a family of inputs. The actual error is that against the
/// same formula at 200 digits, in the max norm. Where it is 0 there is no ratio: such values count as `exact`. Where
/// the bound is infinite nothing is claimed: `unbounded`. The four figures are of the others, and 0 where there is
/// none.
struct BoundTightness {
  std::string evaluator;
  TightnessInputs inputs = TightnessInputs::kPolygons;
  std::string family;
  Quantity quantity = Quantity::kFormFactor;  ///< kFormFactor stands for irradiance
  std::size_t values = 0;
  std::size_t exact = 0;
  std::size_t unbounded = 0;
  double least = 0.0;  ///< below 1 a bound does not hold
  double median = 0.0;
  double percentile_99 = 0.0;
  double largest = 0.0;

  std::size_t compared() const { return values - exact - unbounded; }
  bool holds() const { return compared() == 0 || least >= 1.0; }
};

/// "1.2, 13, 450, 2.1e+03" for least, median, 99 % and largest, and how many are exact; a dash without a value.
std::string figuresOf(const BoundTightness& tightness);

/// Rows of one evaluator and one kind of input in their order, the quantities of a family together.
struct TightnessTable {
  std::string evaluator;
  TightnessInputs inputs = TightnessInputs::kPolygons;
  std::vector<std::vector<BoundTightness>> families;
};
std::vector<TightnessTable> tightnessTables(const std::vector<BoundTightness>& tightness);

/// A bound and the error that it is one of.
struct BoundAndError {
  double bound;
  double error;
};

/// The figures of a quantity.
BoundTightness tightnessOf(const std::vector<BoundAndError>& values);

/// Over `count` inputs of every family: of polygons, of scenes that hide parts of each other, of flatland. Inputs that
/// the evaluator refuses, and quantities that do not exist, are left out.
std::vector<BoundTightness> measureTightness(const BoundedEvaluator& evaluator, std::size_t count, std::uint64_t seed);

}  // namespace irradiff
