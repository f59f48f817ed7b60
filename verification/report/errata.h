#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace irradiff {

/// One residual of a printed formula before and after its correction. Residuals are relative, norm-wise, against the
/// oracle named.
struct ErratumMeasurement {
  std::string quantity;
  std::string oracle;
  std::size_t inputs = 0;
  double printed_smallest = 0.0;  ///< over the inputs; NaN where the printed formula has no value
  double printed_largest = 0.0;
  double corrected_largest = 0.0;
  double allowance = 0.0;  ///< what the corrected residual may be: the oracle's own uncertainty or the rounding

  /// The printed formula is off by more than a thousand allowances somewhere, the corrected one nowhere by more than
  /// one.
  bool isConfirmed() const;
};

/// An erratum of [Schwarzhaupt et al. 2012], named as in docs/errata.md.
struct Erratum {
  std::string equation;   ///< "Equation (19)"
  std::string subject;    ///< "the length of Gamma"
  std::string printed;    ///< what the paper says
  std::string corrected;  ///< what is right
  std::string remark;     ///< empty, or what else was measured
  std::vector<ErratumMeasurement> measurements;
};

/// Each takes `inputs` seeded inputs. The order is that of docs/errata.md.
Erratum measureGammaLength(std::size_t inputs, std::uint64_t seed);
Erratum measureOverallSign(std::size_t inputs, std::uint64_t seed);
Erratum measureFactorPi(std::size_t inputs, std::uint64_t seed);
Erratum measureEllipseShape(std::size_t inputs, std::uint64_t seed);
Erratum measureIndefiniteBound(std::size_t inputs, std::uint64_t seed);
Erratum measureGapFilling();
Erratum measureRotationalPairing(std::size_t inputs, std::uint64_t seed);
Erratum measureThresholdUnit(std::size_t inputs, std::uint64_t seed);

/// All of them.
std::vector<Erratum> measureErrata(std::size_t inputs, std::uint64_t seed);

}  // namespace irradiff
