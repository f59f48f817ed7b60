#pragma once

#include <Eigen/Core>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace irradiff {

/// What a well-known mistake makes of a value.
struct UsualMistake {
  std::string text;
  Eigen::MatrixXd value;  ///< in place of the expected one
};

/// How the diagnosis of a result begins that is right but for an unusual factor, which follows.
inline constexpr std::string_view kFactorText = "all is right but for a factor ";

/// The diagnosis of a result that is not finite, which many mistakes have where they meet a special input.
inline constexpr std::string_view kNotFiniteText =
    "a result that is not finite: division by a vanishing cross product, acos of a number above 1, or a normalised "
    "vector of length 0";

/// What usually makes a result come out as `actual` instead of `expected`, both of one shape: one of the mistakes, by
/// its value; or else what can be seen from the two alone: a flipped sign, a factor of 2 or pi, degrees, axes in
/// another order, single precision ... Empty if nothing is recognised. It is a guess and judges nothing: whether a
/// result is wrong was decided before. The same mistake at another input gives the same text. `mistakes` is called at
/// most once.
std::string diagnose(const Eigen::MatrixXd& expected, const Eigen::MatrixXd& actual,
                     const std::function<std::vector<UsualMistake>()>& mistakes = {});

/// A number, or the rows of a vector or matrix, with all digits.
std::string textOf(const Eigen::MatrixXd& value);

}  // namespace irradiff
