#pragma once

#include <Eigen/Core>

#include <string>

namespace irradiff {

/// What usually makes a result come out as `actual` instead of `expected`: a flipped sign, a factor of 2 or pi, a
/// transposed or asymmetric matrix ... Empty if nothing is recognised. Both of one shape.
std::string diagnose(const Eigen::MatrixXd& expected, const Eigen::MatrixXd& actual);

/// A number, or the rows of a vector or matrix, with all digits.
std::string textOf(const Eigen::MatrixXd& value);

}  // namespace irradiff
