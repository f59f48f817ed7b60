#pragma once

#include "derivatives/form_factor/form_factor.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "tests/benchmarks/benchmark_inputs.h"

#include <string>
#include <vector>

namespace irradiff {

/// One way to get F, gradient and Hessian of a polygon, from vertices as a scene stores them, on inputs that it serves.
struct PolygonVariant {
  std::string name;
  SourceSize size = SourceSize::kLarge;
  FormFactor<long double> (*evaluate)(const Polygon& polygon, const Receiver& receiver);
};

/// The first one is what the others are compared with: the appendix form with acos in double, as a renderer would write
/// it. The formulas are those of formulaVariants() in double.
std::vector<PolygonVariant> polygonVariants();

}  // namespace irradiff
