#include "tests/error_metric/ellipse_quadrature.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace irradiff::error_metric_test {
namespace {

using Real = long double;

/// alpha y^2 + beta y + gamma.
struct Parabola {
  Real alpha, beta, gamma;

  Real operator()(Real y) const { return (alpha * y + beta) * y + gamma; }

  std::vector<Real> roots() const {
    const Real discriminant = beta * beta - 4 * alpha * gamma;
    if (!(discriminant > 0)) return {};
    const Real sum = -(beta + std::copysign(std::sqrt(discriminant), beta)) / 2;
    std::vector<Real> result;
    if (alpha != 0) result.push_back(sum / alpha);
    if (sum != 0) result.push_back(gamma / sum);
    return result;
  }

  /// Integral of the absolute value over [-end, end].
  Real absoluteIntegral(Real end) const {
    std::vector<Real> cuts{-end, end};
    for (const Real root : roots()) {
      if (std::abs(root) < end) cuts.push_back(root);
    }
    std::sort(cuts.begin(), cuts.end());
    Real sum = 0;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const Real middle = (cuts[i] + cuts[i + 1]) / 2;
      const Real half = (cuts[i + 1] - cuts[i]) / 2;
      const Real node = half / std::sqrt(Real(3));
      sum += std::abs(half * ((*this)(middle - node) + (*this)(middle + node)));
    }
    return sum;
  }
};

}  // namespace

Quadrature integrateHalfForm(const Eigen::Matrix2d& hessian, const ValidRegion& region) {
  using Matrix = Eigen::Matrix<Real, 2, 2>;
  const Matrix axes = region.axes.cast<Real>();
  const Matrix h = axes.transpose() * hessian.cast<Real>() * axes;
  const Real a = region.half_axes(0);
  const Real b = region.half_axes(1);
  const auto strip = [&](Real angle) {
    const Real x = a * std::sin(angle);
    const Real end = b * std::cos(angle);
    const Parabola form{h(1, 1), (h(0, 1) + h(1, 0)) * x, h(0, 0) * x * x};
    return a * std::cos(angle) * form.absoluteIntegral(end) / 2;
  };
  // The strips' integral has a kink where the form vanishes on the ellipse, which may be too near an end to be noticed,
  // and where both of its zero lines meet.
  constexpr Real kQuarterTurn = std::numbers::pi_v<Real> / 2;
  std::vector<Real> cuts{-kQuarterTurn, 0, kQuarterTurn};
  for (const Real tangent : Parabola{h(0, 0) * a * a, (h(0, 1) + h(1, 0)) * a * b, h(1, 1) * b * b}.roots()) {
    cuts.push_back(std::atan(tangent));
  }
  std::sort(cuts.begin(), cuts.end());

  constexpr unsigned kBisections = 5;
  constexpr Real kTolerance = 1e-15L;
  Real value = 0;
  Real error = 0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    Real piece_error = 0;
    value += boost::math::quadrature::gauss_kronrod<Real, 31>::integrate(strip, cuts[i], cuts[i + 1], kBisections,
                                                                         kTolerance, &piece_error);
    error += piece_error;
  }
  return {static_cast<double>(value), static_cast<double>(error)};
}

double integrateOver(
    const ValidRegion& region, const std::function<double(const Eigen::Vector2d&)>& function,
    const std::function<std::vector<double>(const Eigen::Vector2d& start, const Eigen::Vector2d& along)>& kinks) {
  using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
  constexpr double kQuarterTurn = std::numbers::pi / 2;
  const Eigen::Vector2d across = region.axes.col(0);
  const Eigen::Vector2d along = region.axes.col(1);
  const auto strip = [&](double angle) {
    const Eigen::Vector2d start = region.half_axes(0) * std::sin(angle) * across;
    const double end = region.half_axes(1) * std::cos(angle);
    std::vector<double> cuts{-end, end};
    for (const double kink : kinks(start, along)) {
      if (std::abs(kink) < end) cuts.push_back(kink);
    }
    std::sort(cuts.begin(), cuts.end());
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      if (!(cuts[i] < cuts[i + 1])) continue;
      sum += Rule::integrate([&](double t) { return function(start + t * along); }, cuts[i], cuts[i + 1], 3, 1e-11);
    }
    return region.half_axes(0) * std::cos(angle) * sum;
  };
  return Rule::integrate(strip, -kQuarterTurn, kQuarterTurn, 12, 1e-10);
}

Eigen::Matrix2d absoluteHessian(const Eigen::Matrix2d& hessian) {
  const double size = hessian.cwiseAbs().maxCoeff();
  const Eigen::Matrix<Real, 2, 2> h = hessian.cast<Real>() / Real(size);
  const Eigen::Matrix<Real, 2, 2> square = h * h;
  const Real root = std::abs(h(0, 0) * h(1, 1) - h(0, 1) * h(1, 0));
  const Real trace = std::sqrt(square.trace() + 2 * root);
  return size * ((square + root * Eigen::Matrix<Real, 2, 2>::Identity()) / trace).cast<double>();
}

Eigen::Matrix2d hessianOf(double l1, double l2, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double mixed = (l1 - l2) * c * s;
  Eigen::Matrix2d h;
  h << l1 * c * c + l2 * s * s, mixed, mixed, l1 * s * s + l2 * c * c;
  return h;
}

}  // namespace irradiff::error_metric_test
