#include "verification/checks/error_diagnosis.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>
#include <utility>

namespace irradiff {
namespace {

using Eigen::MatrixXd;

constexpr double kPi = std::numbers::pi;
/// How well a guess must agree, relative: a formula in single precision may make the mistake.
constexpr double kClose = 1e-6;
/// Differences below this are rounding, or a small term.
constexpr double kNearlyRight = 1e-3;

double maxNorm(const MatrixXd& m) { return m.cwiseAbs().maxCoeff(); }

/// The mistake whose difference from the right value is the difference found.
std::string matchingMistake(const MatrixXd& expected, const MatrixXd& actual,
                            const std::vector<UsualMistake>& mistakes) {
  const double norm = maxNorm(expected);
  for (const UsualMistake& mistake : mistakes) {
    if (!mistake.value.allFinite() || mistake.value.rows() != expected.rows() ||
        mistake.value.cols() != expected.cols()) {
      continue;
    }
    const double size = maxNorm(mistake.value - expected);
    // What a mistake changes by no more than rounding does cannot be told from rounding.
    if (size > 0x1p-40 * norm && maxNorm(actual - mistake.value) <= kClose * size) {
      return mistake.text;
    }
  }
  return "";
}

std::string namedFactor(double ratio) {
  static constexpr std::array<std::pair<double, const char*>, 15> kFactors = {{
      {-1.0, "the sign is flipped: vertices taken counterclockwise, or two sides swapped"},
      {2.0, "a factor 2 too much"},
      {0.5, "a factor 2 is missing"},
      {4.0, "a factor 4 too much"},
      {0.25, "a factor 4 is missing"},
      {-2.0, "a factor -2 too much"},
      {-0.5, "a factor -2 is missing"},
      {kPi, "a factor pi too much: irradiance of radiance 1 instead of a form factor; divide by pi"},
      {1.0 / kPi, "a factor pi is missing"},
      {2.0 * kPi, "a factor 2 pi too much"},
      {0.5 / kPi, "a factor 2 pi is missing"},
      {kPi * kPi, "a factor pi^2 too much: multiplied by pi where it should be divided by it"},
      {1.0 / (kPi * kPi), "a factor pi^2 is missing: divided by pi where it should be multiplied by it"},
      {180.0 / kPi, "a factor 180/pi too much: an angle in degrees, where radians are meant"},
      {kPi / 180.0, "a factor 180/pi is missing: radians converted once too often"},
  }};
  for (const auto& [factor, text] : kFactors) {
    if (std::abs(ratio - factor) <= kClose * std::abs(factor)) {
      return text;
    }
  }
  return "";
}

/// pi written with too few digits, found from what it leaves of a factor of 1.
std::string shortPi(double ratio) {
  static constexpr std::array<std::pair<double, const char*>, 7> kShort = {{{3.14, "3.14"},
                                                                            {22.0 / 7.0, "22/7"},
                                                                            {3.1416, "3.1416"},
                                                                            {3.14159, "3.14159"},
                                                                            {3.141592, "3.141592"},
                                                                            {3.1415926, "3.1415926"},
                                                                            {3.14159274101257324, "a float"}}};
  for (const auto& [value, text] : kShort) {
    for (const double factor : {value / kPi, kPi / value}) {
      if (std::abs(ratio - factor) <= 1e-3 * std::abs(factor - 1.0)) {
        return std::string("pi is written as ") + text;
      }
    }
  }
  return "";
}

bool isSinglePrecision(const MatrixXd& value) {
  return (value.array() == value.cast<float>().cast<double>().array()).all();
}

/// What one sees of a vector or a matrix over the coordinate axes whose signs or order are wrong.
std::string axesMistake(const MatrixXd& expected, const MatrixXd& actual) {
  if (expected.rows() != 3) {
    return "";
  }
  const double norm = maxNorm(expected);
  std::array<int, 3> order = {0, 1, 2};
  // Fewest flipped signs first: of the names that fit, the simplest.
  static constexpr std::array<unsigned, 8> kFlips = {0, 1, 2, 4, 3, 5, 6, 7};
  do {
    for (const unsigned flips : kFlips) {
      Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
      for (int i = 0; i < 3; ++i) {
        axes(i, order[static_cast<std::size_t>(i)]) = ((flips >> static_cast<unsigned>(i)) & 1U) != 0U ? -1.0 : 1.0;
      }
      const MatrixXd changed =
          expected.cols() == 3 ? MatrixXd(axes * expected * axes.transpose()) : MatrixXd(axes * expected);
      if (maxNorm(changed - expected) <= 0.1 * kClose * norm || maxNorm(actual - changed) > kClose * norm) {
        continue;
      }
      std::string text = "right but for the coordinate axes (x, y, z), which come out as (";
      for (int i = 0; i < 3; ++i) {
        text += i > 0 ? ", " : "";
        text += ((flips >> static_cast<unsigned>(i)) & 1U) != 0U ? "-" : "";
        text += "xyz"[order[static_cast<std::size_t>(i)]];
      }
      return text + "): y up against z up, or a left-handed frame";
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return "";
}

Eigen::VectorXd eigenvaluesOf(const MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(0.5 * (symmetric + symmetric.transpose()), Eigen::EigenvaluesOnly)
      .eigenvalues();
}

/// What one sees of a vector or a symmetric matrix that is expressed in another frame.
std::string frameMistake(const MatrixXd& expected, const MatrixXd& actual) {
  const double norm = maxNorm(expected);
  if (expected.cols() == 1) {
    return std::abs(expected.norm() - actual.norm()) <= kClose * norm
               ? "right length, wrong direction: turned into another frame (local for world, or a transposed rotation)"
               : "";
  }
  if (maxNorm(actual - actual.transpose()) > kClose * norm) {
    return "";
  }
  if ((eigenvaluesOf(expected) - eigenvaluesOf(actual)).cwiseAbs().maxCoeff() <= kClose * norm) {
    return expected.rows() == 2
               ? "right eigenvalues, wrong axes: other tangents than those of tangentFrame(normal), or in another order"
               : "right eigenvalues, wrong axes: turned into another frame (local for world, or a transposed rotation)";
  }
  return "";
}

/// What one sees of a matrix whose diagonal is right.
std::string offDiagonalMistake(const MatrixXd& expected, const MatrixXd& actual) {
  const double norm = maxNorm(expected);
  const MatrixXd off_expected = expected - MatrixXd(expected.diagonal().asDiagonal());
  const MatrixXd off_actual = actual - MatrixXd(actual.diagonal().asDiagonal());
  if ((expected - actual).diagonal().cwiseAbs().maxCoeff() > kClose * norm || maxNorm(off_expected) <= kClose * norm) {
    return "";
  }
  static constexpr std::array<std::pair<double, const char*>, 4> kMultiples = {{
      {0.0, "the entries off the diagonal are missing"},
      {2.0, "the entries off the diagonal are doubled: d2/dxdy counted for d2/dydx as well"},
      {0.5, "the entries off the diagonal are halved"},
      {-1.0, "the entries off the diagonal have the wrong sign"},
  }};
  for (const auto& [multiple, text] : kMultiples) {
    if (maxNorm(off_actual - multiple * off_expected) <= kClose * norm) {
      return text;
    }
  }
  return "";
}

std::string patternOf(const MatrixXd& expected, const MatrixXd& actual) {
  if (std::string text = axesMistake(expected, actual); !text.empty()) {
    return text;
  }
  if (expected.cols() > 1) {
    if (std::string text = offDiagonalMistake(expected, actual); !text.empty()) {
      return text;
    }
  }
  return frameMistake(expected, actual);
}

}  // namespace

std::string diagnose(const MatrixXd& expected, const MatrixXd& actual,
                     const std::function<std::vector<UsualMistake>()>& mistakes) {
  if (!actual.allFinite()) {
    return std::string(kNotFiniteText);
  }
  const double norm = maxNorm(expected);
  if (norm == 0.0) {
    return "a contribution that should vanish: an open boundary, or an edge counted twice";
  }
  if (maxNorm(actual) == 0.0) {
    return "nothing at all: an early return, a test that rejects the input, or a loop that never runs";
  }
  if (mistakes) {
    if (std::string text = matchingMistake(expected, actual, mistakes()); !text.empty()) {
      return text;
    }
  }

  const double ratio = expected.cwiseProduct(actual).sum() / expected.squaredNorm();
  const double beside = maxNorm(actual - ratio * expected);
  if (beside <= kClose * norm) {
    if (std::string text = namedFactor(ratio); !text.empty()) {
      return text;
    }
  }
  if (std::abs(ratio - 1.0) > 1e-9 && beside <= 1e-3 * std::abs(ratio - 1.0) * norm) {
    if (std::string text = shortPi(ratio); !text.empty()) {
      return text;
    }
  }
  const double error = maxNorm(actual - expected);
  if (error <= kNearlyRight * norm && isSinglePrecision(actual)) {
    return "digits are lost: every entry is a float, so the result went through single precision";
  }
  const bool is_multiple = beside <= kClose * std::min(1.0, std::abs(ratio - 1.0)) * norm;
  if (error <= kClose * norm && !(is_multiple && expected.size() > 1 && std::abs(ratio - 1.0) > 1e-9)) {
    return "the formula is right and digits are lost: cancellation at this input, or single precision (a float "
           "variable, sqrtf, 1.0f) on the way";
  }
  if (expected.size() > 1) {
    if (std::string text = patternOf(expected, actual); !text.empty()) {
      return text;
    }
  }
  if (beside <= kClose * norm) {
    std::ostringstream text;
    text.precision(4);
    text << kFactorText;
    std::abs(ratio - 1.0) < 1e-3 ? text << "1 + " << ratio - 1.0 : text << ratio;
    return text.str();
  }
  if (error <= kNearlyRight * norm) {
    return "nearly right: a difference quotient with too long a step, a quadrature with too few points, an epsilon "
           "added to a denominator, or a small term missing";
  }
  if (expected.rows() == expected.cols() && maxNorm(actual - actual.transpose()) > kClose * norm) {
    return "the Hessian is not symmetric: a term missing, swapped or of the wrong sign";
  }
  return "";
}

std::string textOf(const MatrixXd& value) {
  std::ostringstream text;
  text.precision(17);
  const auto append = [&text](double number) {
    // A NaN has a sign that says nothing.
    std::isnan(number) ? text << "nan" : text << number;
  };
  const bool is_matrix = value.cols() > 1;
  text << (value.size() > 1 ? "[" : "");
  for (Eigen::Index i = 0; i < value.rows(); ++i) {
    text << (i > 0 ? ", " : "") << (is_matrix ? "[" : "");
    for (Eigen::Index j = 0; j < value.cols(); ++j) {
      text << (j > 0 ? ", " : "");
      append(value(i, j));
    }
    text << (is_matrix ? "]" : "");
  }
  text << (value.size() > 1 ? "]" : "");
  return text.str();
}

}  // namespace irradiff
