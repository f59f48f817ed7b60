#pragma once

#include "derivatives/form_factor/form_factor.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "tests/benchmarks/benchmark_inputs.h"

#include <span>
#include <string>
#include <vector>

namespace irradiff {

/// One way to get F, gradient and Hessian of a polygon, from vertices as a scene stores them.
struct PolygonVariant {
  std::string name;
  SourceSize size = SourceSize::kLarge;
  FormFactor<double> (*evaluate)(const Polygon& polygon, const Receiver& receiver);
  /// The same for one polygon after the other, in one call: the loop is compiled with the formula.
  void (*evaluateBatch)(std::span<const Polygon> polygons, const Receiver& receiver,
                        std::span<FormFactor<double>> results);
};

/// The first one is what the others are compared with: the appendix form with acos, as a renderer would write it.
std::vector<PolygonVariant> polygonVariants();

}  // namespace irradiff
