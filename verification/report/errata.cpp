#include "verification/report/errata.h"

#include <cmath>

namespace irradiff {

bool ErratumMeasurement::isConfirmed() const {
  const bool printed_is_wrong = std::isnan(printed_largest) || printed_largest > 1000.0 * allowance;
  return inputs > 0 && printed_is_wrong && corrected_largest <= allowance;
}

std::vector<Erratum> measureErrata(std::size_t inputs, std::uint64_t seed) {
  return {measureGammaLength(inputs, seed),       measureOverallSign(inputs, seed),     measureFactorPi(inputs, seed),
          measureEllipseShape(inputs, seed),      measureIndefiniteBound(inputs, seed), measureGapFilling(),
          measureRotationalPairing(inputs, seed), measureThresholdUnit(inputs, seed)};
}

}  // namespace irradiff
