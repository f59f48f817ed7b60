#pragma once

#include "verification/checks/oracle.h"
#include "verification/checks/verdict.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {

/// Relative errors that are allowed above an oracle's own uncertainty; a quantity with 0 is not judged.
struct Allowance {
  double form_factor = 0.0;
  double gradient = 0.0;
  double hessian = 0.0;
  double tangential_hessian = 0.0;
  double rotational_gradient = 0.0;
  std::string rule;

  static Allowance uniform(double tolerance, std::string rule) {
    return {tolerance, tolerance, tolerance, tolerance, tolerance, std::move(rule)};
  }
};

/// Each quantity that both the candidate and the oracle know, over the inputs, norm-wise: max|actual - expected| /
/// max|expected|, for the rotational gradient over the larger of that and |F|: together they are one vector, of which
/// the rotational gradient vanishes where the normal points at the polygon. Inputs where the oracle does not apply,
/// does not know the quantity or expects exactly 0 do not count.
std::vector<Verdict> checkAgainst(const Oracle& oracle, const Candidate& candidate,
                                  std::span<const Configuration> inputs, const std::string& family,
                                  const Allowance& allowance);

/// The candidate's claimed bounds against the oracle: |actual - expected| / bound, at most 1. A claimed bound that is
/// exceeded is a defect.
std::vector<Verdict> checkBounds(const Oracle& oracle, const Candidate& candidate,
                                 std::span<const Configuration> inputs, const std::string& family);

}  // namespace irradiff
