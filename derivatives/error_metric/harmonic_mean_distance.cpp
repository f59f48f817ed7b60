#include "derivatives/error_metric/harmonic_mean_distance.h"

#include <numbers>

namespace irradiff {

double harmonicMeanDistance(const HemisphereSamples& samples, const Strata& strata) {
  double inverse = 0.0;
  for (std::size_t row = 0; row < samples.shape.rows; ++row) {
    for (std::size_t column = 0; column < samples.shape.columns; ++column) {
      const double share = strata.projectedSolidAngle(row, column) * std::numbers::inv_pi;
      inverse += share * samples.inverse_distance[row * samples.shape.columns + column];
    }
  }
  return 1.0 / inverse;
}

}  // namespace irradiff
