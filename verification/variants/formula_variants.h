#pragma once

#include "derivatives/form_factor/form_factor.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <string>
#include <vector>

namespace irradiff {

/// What a formula is evaluated in.
enum class ScalarType { kFloat, kDouble, kLongDouble };

/// "float", "double" or "long double".
const char* nameOf(ScalarType scalar);

/// One way to get F, gradient and Hessian of a polygon from its vertices as a scene stores them: a formula at a scalar,
/// as a renderer author would write it, without the safeguards of evaluatePolygon unless its name says so.
struct FormulaVariant {
  std::string formula;  ///< "appendix, acos", "boundary, closed form", "area rule", ...
  ScalarType scalar = ScalarType::kDouble;
  /// Requires validated arguments and a polygon above the horizon. Results may be anything but a crash where the
  /// variant is out of its depth: NaN and infinity included.
  FormFactor<long double> (*evaluate)(const Polygon& polygon, const Receiver& receiver);

  std::string name() const { return formula + ", " + nameOf(scalar); }
};

/// Formulas times scalars. The first one is what prices are relative to: the appendix form with acos in double.
const std::vector<FormulaVariant>& formulaVariants();

}  // namespace irradiff
