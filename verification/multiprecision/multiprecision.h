#pragma once

#include <Eigen/Core>
#include <boost/multiprecision/mpfr.hpp>

#include <vector>

namespace irradiff {

/// 200 decimal digits: the templates' closed forms lose up to 5 log10(1/angle) digits, 60 of them at the smallest
/// angles of the input families, and the differences at steps of 1e-30 as many again.
using Multiprecision =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<200>, boost::multiprecision::et_off>;

using MultiprecisionVector = Eigen::Matrix<Multiprecision, 3, 1>;
using MultiprecisionMatrix = Eigen::Matrix<Multiprecision, 3, 3>;

/// Doubles as they are, exactly.
inline MultiprecisionVector withoutRounding(const Eigen::Vector3d& v) {
  return {Multiprecision(v(0)), Multiprecision(v(1)), Multiprecision(v(2))};
}

inline std::vector<MultiprecisionVector> withoutRounding(const std::vector<Eigen::Vector3d>& vertices) {
  std::vector<MultiprecisionVector> result;
  result.reserve(vertices.size());
  for (const Eigen::Vector3d& vertex : vertices) {
    result.push_back(withoutRounding(vertex));
  }
  return result;
}

}  // namespace irradiff
