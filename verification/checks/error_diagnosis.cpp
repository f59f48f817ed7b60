#include "verification/checks/error_diagnosis.h"

#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

namespace irradiff {

std::string diagnose(const Eigen::MatrixXd& expected, const Eigen::MatrixXd& actual) {
  constexpr double kPi = std::numbers::pi;
  constexpr double kClose = 1e-6;
  if (!actual.allFinite()) {
    return "a result that is not finite: division by a vanishing cross product, or acos of a number above 1";
  }
  const double norm = expected.cwiseAbs().maxCoeff();
  if (norm == 0.0) {
    return "a contribution that should vanish: an open boundary, or an edge counted twice";
  }
  const double ratio = expected.cwiseProduct(actual).sum() / expected.squaredNorm();
  if ((actual - ratio * expected).cwiseAbs().maxCoeff() <= kClose * norm) {
    static constexpr std::array<std::pair<double, const char*>, 7> kFactors = {{
        {-1.0, "the sign is flipped (vertices counterclockwise, or the printed sign of Eq. (20), (21))"},
        {2.0, "a factor 2 too much"},
        {0.5, "a factor 2 is missing"},
        {kPi, "irradiance of radiance 1 instead of a form factor: divide by pi"},
        {1.0 / kPi, "a factor pi is missing"},
        {2.0 * kPi, "a factor 2 pi too much"},
        {0.5 / kPi, "a factor 2 pi is missing"},
    }};
    for (const auto& [factor, text] : kFactors) {
      if (std::abs(ratio - factor) <= kClose * std::abs(factor)) {
        return text;
      }
    }
    if (std::abs(ratio - 1.0) > kClose) {
      std::ostringstream text;
      text.precision(6);
      text << "all is right but for a factor " << ratio;
      return text.str();
    }
    return "the formula is right and digits are lost: cancellation at this input";
  }
  if (expected.rows() == expected.cols() && expected.rows() > 1 &&
      (actual - actual.transpose()).cwiseAbs().maxCoeff() > kClose * norm) {
    return "the Hessian is not symmetric: one edge's term missing, swapped or of the wrong sign";
  }
  return "";
}

std::string textOf(const Eigen::MatrixXd& value) {
  std::ostringstream text;
  text.precision(17);
  const bool is_matrix = value.cols() > 1;
  text << (value.size() > 1 ? "[" : "");
  for (Eigen::Index i = 0; i < value.rows(); ++i) {
    text << (i > 0 ? ", " : "") << (is_matrix ? "[" : "");
    for (Eigen::Index j = 0; j < value.cols(); ++j) {
      text << (j > 0 ? ", " : "") << value(i, j);
    }
    text << (is_matrix ? "]" : "");
  }
  text << (value.size() > 1 ? "]" : "");
  return text.str();
}

}  // namespace irradiff
