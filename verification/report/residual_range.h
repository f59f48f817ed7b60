#pragma once

#include "verification/report/errata.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace irradiff {

/// Collects the residuals of a printed and of a corrected formula over the inputs of one measurement.
class ResidualRange {
 public:
  ResidualRange(std::string quantity, std::string oracle, double allowance) {
    measurement_.quantity = std::move(quantity);
    measurement_.oracle = std::move(oracle);
    measurement_.allowance = allowance;
    measurement_.printed_smallest = std::numeric_limits<double>::infinity();
  }

  void add(double printed, double corrected) {
    ++measurement_.inputs;
    measurement_.printed_smallest = std::min(measurement_.printed_smallest, printed);
    measurement_.printed_largest = std::max(measurement_.printed_largest, printed);
    // A NaN must not pass for a small residual.
    measurement_.corrected_largest = std::isnan(corrected) ? std::numeric_limits<double>::infinity()
                                                           : std::max(measurement_.corrected_largest, corrected);
  }

  const ErratumMeasurement& measurement() const { return measurement_; }

 private:
  ErratumMeasurement measurement_;
};

}  // namespace irradiff
