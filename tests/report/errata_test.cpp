#include "verification/report/errata.h"

#include <gtest/gtest.h>

namespace irradiff {
namespace {

// The errata that need no enclosure, which takes seconds; the report's test has them all.
TEST(Errata, AreBorneOutByMeasurement) {
  for (const Erratum& erratum :
       {measureOverallSign(2, 3), measureFactorPi(2, 3), measureEllipseShape(20, 3), measureIndefiniteBound(20, 3),
        measureGapFilling(), measureRotationalPairing(2, 3), measureThresholdUnit(2, 3)}) {
    EXPECT_FALSE(erratum.measurements.empty()) << erratum.equation;
    for (const ErratumMeasurement& m : erratum.measurements) {
      EXPECT_TRUE(m.isConfirmed()) << erratum.equation << ", " << m.quantity << ": printed " << m.printed_smallest
                                   << " to " << m.printed_largest << ", corrected " << m.corrected_largest;
    }
  }
}

// What theory says of the printed formulas' residuals.
TEST(Errata, ResidualsAreThoseOfTheory) {
  for (const ErratumMeasurement& m : measureOverallSign(2, 5).measurements) {
    EXPECT_NEAR(m.printed_smallest, 2.0, 1e-12);
    EXPECT_NEAR(m.printed_largest, 2.0, 1e-12);
  }
  for (const ErratumMeasurement& m : measureFactorPi(2, 5).measurements) {
    EXPECT_NEAR(m.printed_largest, 1.0 - 0.318309886183790672, 1e-12);
  }
  EXPECT_NEAR(measureIndefiniteBound(10, 5).measurements.back().printed_largest, 1.57079632679489662 - 1.0, 1e-12);
  EXPECT_NEAR(measureThresholdUnit(2, 5).measurements.front().printed_largest, 1.0 - 0.1, 1e-12);
}

}  // namespace
}  // namespace irradiff
