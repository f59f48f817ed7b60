#include "derivatives/error_metric/normal_cone.h"

#include "derivatives/scene/number_text.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace irradiff {

NormalCone NormalCone::ofDegrees(double degrees) {
  if (!(degrees >= 0.0 && degrees <= 180.0)) {
    throw std::invalid_argument("the angle of a cone of normals is " + numberText(degrees) +
                                " degrees, must be between 0 and 180");
  }
  // Half the angle, in radians.
  return NormalCone(2.0 * std::sin(degrees * (std::numbers::pi / 360.0)));
}

}  // namespace irradiff
