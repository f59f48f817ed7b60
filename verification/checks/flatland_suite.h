#pragma once

#include "derivatives/boundary/derivative_bounds.h"
#include "verification/checks/flatland_inputs.h"
#include "verification/checks/verdict.h"

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace irradiff {

/// What is put to the test: irradiance of a segment, seen from either side, and its derivatives. Units 1, 1/m, 1/m^2.
struct FlatlandCandidate {
  std::string name;
  std::function<double(const FlatlandConfiguration&)> irradiance;
  std::function<Eigen::Vector2d(const FlatlandConfiguration&)> gradient;
  std::function<Eigen::Matrix2d(const FlatlandConfiguration&)> hessian;
  std::function<double(const FlatlandConfiguration&)> tangential_hessian;
  std::function<double(const FlatlandConfiguration&)> rotational_gradient;  ///< for counterclockwise turns
  std::function<DerivativeBounds(const FlatlandConfiguration&)> bounds;     ///< claimed; checked where given

  Eigen::MatrixXd evaluate(Quantity quantity, const FlatlandConfiguration& configuration) const;
  bool has(Quantity quantity) const;
};

/// The library's evaluateSegment.
FlatlandCandidate flatlandCandidate();

struct FlatlandSuiteOptions {
  std::uint64_t seed = 1;
  std::size_t inputs = 100;  ///< for each family and check
  double tolerance = 1e-13;
  std::filesystem::path reference_folder;  ///< data/reference; empty: without
};

/// The boundary form at 200 digits (rounding), differences of irradiance by the defining integral's closed form in the
/// angle (wrong derivative algebra), numerical integration of the defining integral (a wrong irradiance), closure of a
/// polygon around the receiver, claimed bounds and reference data, over generic, short, near, end-on and horizon-cut
/// segments; bounds alone where these extremes come together. `form factor` in a verdict means irradiance.
std::vector<Verdict> checkFlatland(const FlatlandCandidate& candidate, const FlatlandSuiteOptions& options);

}  // namespace irradiff
