#include "verification/enclosure/contour_enclosure.h"

#include "verification/enclosure/arctangent_quotient.h"
#include "verification/enclosure/horizon_clip.h"
#include "verification/enclosure/second_order_taylor.h"

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {

using namespace enclosure;

namespace {

using Taylor = SecondOrderTaylor<Ball, 3>;
using TaylorVector = Eigen::Matrix<Taylor, 3, 1>;

Taylor dotOf(const TaylorVector& a, const TaylorVector& b) { return a(0) * b(0) + a(1) * b(1) + a(2) * b(2); }

TaylorVector crossOf(const TaylorVector& a, const TaylorVector& b) {
  return {a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0)};
}

Taylor rootOf(const Taylor& x) {
  const Ball root = sqrt(x.value);
  const Ball first = Ball(0.5) / root;
  return compose(x, root, first, Ball(-0.5) * first / x.value);
}

Taylor arctangentQuotientOf(const Taylor& z) {
  const std::array<Ball, 4> t = arctangentQuotient(z.value);
  return compose(z, t[0], t[1], t[2]);
}

/// (r x r') times angle / |r x r'|: Lambert's vector of an edge.
TaylorVector contourTerm(const TaylorVector& r, const TaylorVector& s) {
  const TaylorVector c = crossOf(r, s);
  const Taylor sine_squared = dotOf(c, c);
  const Taylor cosine = dotOf(r, s);
  Taylor angle_over_sine;
  if (cosine.value > Ball(0) && sine_squared.value < cosine.value * cosine.value) {
    // Short edges, and those whose line passes through the receiver: the sine may be exactly 0.
    angle_over_sine = arctangentQuotientOf(sine_squared / (cosine * cosine)) / cosine;
  } else {
    const Taylor sine = rootOf(sine_squared);
    const Taylor cotangent = cosine / sine;
    const Taylor complement = cotangent * arctangentQuotientOf(cosine * cosine / sine_squared);
    angle_over_sine = (Taylor(Ball::pi() / Ball(2)) - complement) / sine;
  }
  TaylorVector term;
  for (Eigen::Index k = 0; k < 3; ++k) term(k) = c(k) * angle_over_sine;
  return term;
}

FormFactorEnclosure contourAtWorkingPrecision(const Polygon& polygon, const Receiver& receiver) {
  TaylorVector normal;
  for (Eigen::Index k = 0; k < 3; ++k) normal(k) = Taylor(Ball(receiver.normal(k)));
  std::vector<TaylorVector> vertices;
  for (const Eigen::Vector3d& vertex : polygon.vertices) {
    TaylorVector relative;
    for (Eigen::Index k = 0; k < 3; ++k) {
      relative(k) = Taylor(Ball(vertex(k))) - Taylor::variable(Ball(receiver.position(k)), static_cast<std::size_t>(k));
    }
    vertices.push_back(relative);
  }
  const std::vector<TaylorVector> visible = aboveHorizon<Taylor, 3>(vertices, normal, true);
  TaylorVector sum;
  for (std::size_t i = 0; i < visible.size(); ++i) {
    const TaylorVector term = contourTerm(visible[i], visible[(i + 1) % visible.size()]);
    for (Eigen::Index k = 0; k < 3; ++k) sum(k) += term(k);
  }
  const Ball factor = Ball(1) / (Ball(2) * Ball::pi());
  const Taylor form_factor = dotOf(normal, sum) * factor;
  FormFactorEnclosure result;
  result.value = form_factor.value;
  for (std::size_t i = 0, k = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    result.gradient(row) = form_factor.gradient[i];
    // F is linear in the normal but for the motion of cuts, where the integrand vanishes.
    result.normal_gradient(row) = sum(row).value * factor;
    for (std::size_t j = i; j < 3; ++j, ++k) {
      const auto column = static_cast<Eigen::Index>(j);
      result.hessian(row, column) = result.hessian(column, row) = form_factor.hessian[k];
    }
  }
  return result;
}

}  // namespace

FormFactorEnclosure encloseContour(const Polygon& polygon, const Receiver& receiver, int digits) {
  constexpr slong kMostTimes = 64;
  const slong first_precision = precisionForDigits(2 * digits);
  for (slong precision = first_precision; precision <= kMostTimes * first_precision; precision *= 2) {
    const WorkingPrecision scope(precision);
    const FormFactorEnclosure result = contourAtWorkingPrecision(polygon, receiver);
    if (correctDigits(result) >= digits) return result;
  }
  throw std::runtime_error("polygon \"" + polygon.name + "\": " + std::to_string(digits) +
                           " digits are not reached at " + std::to_string(kMostTimes * first_precision) +
                           " bits; the receiver is too near an edge");
}

}  // namespace irradiff
