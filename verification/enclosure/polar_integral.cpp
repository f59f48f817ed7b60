#include "verification/enclosure/polar_integral.h"

#include "verification/enclosure/arctangent_quotient.h"
#include "verification/enclosure/horizon_clip.h"
#include "verification/enclosure/second_order_taylor.h"
#include "verification/enclosure/validated_integral.h"

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

/// One edge's share, divided by w = (q x e).f: the integral over b in [0, 1] of
///   (n.f) / (2 h^4 (1 + z)) + (n.q) G(z) / h^4,   q = q_0 + b e,  z = |q|^2 / h^2,  G = -T'.
class EdgeIntegrand {
 public:
  EdgeIntegrand(const TaylorVector& foot, const Taylor& height_squared, const TaylorVector& q0, const TaylorVector& e,
                const TaylorVector& normal) {
    const Taylor inverse_square = inverse(height_squared);
    const Taylor inverse_fourth = inverse_square * inverse_square;
    z_ = {dot(q0, q0) * inverse_square, dot(q0, e) * inverse_square * Ball(2), dot(e, e) * inverse_square};
    along_normal_ = dot(normal, foot) * inverse_fourth * Ball(0.5);
    in_plane_ = {dot(normal, q0) * inverse_fourth, dot(normal, e) * inverse_fourth};
  }

  template <class S>
  std::array<S, Taylor::kTerms> evaluate(const Ball& center, const S& offset) const {
    const Taylor z_center = z_[0] + (z_[1] + z_[2] * center) * center;
    const Taylor z_slope = z_[1] + z_[2] * (Ball(2) * center);
    using Local = SecondOrderTaylor<S, 3>;
    const Local z =
        z_center.template cast<S>() + (z_slope.template cast<S>() + z_[2].template cast<S>() * offset) * offset;
    const Local nq =
        (in_plane_[0] + in_plane_[1] * center).template cast<S>() + in_plane_[1].template cast<S>() * offset;
    const std::array<S, 4> t = arctangentQuotient(z.value);
    const Local g = compose(z, -t[1], -t[2], -t[3]);
    const Local u = inverse(Local(S(1.0)) + z);
    return (along_normal_.template cast<S>() * u + nq * g).terms();
  }

 private:
  std::array<Taylor, 3> z_;
  Taylor along_normal_;
  std::array<Taylor, 2> in_plane_;
};

TaylorVector constant(const BallVector& v) { return {Taylor(v(0)), Taylor(v(1)), Taylor(v(2))}; }

TaylorVector variable(const BallVector& v) {
  return {Taylor::variable(v(0), 0), Taylor::variable(v(1), 1), Taylor::variable(v(2), 2)};
}

Taylor triangleFormFactor(const std::array<BallVector, 3>& vertices, const TaylorVector& position,
                          const TaylorVector& n) {
  std::vector<TaylorVector> r(3);
  for (std::size_t i = 0; i < 3; ++i) {
    for (Eigen::Index k = 0; k < 3; ++k) r[i](k) = Taylor(vertices[i](k)) - position(k);
  }
  const BallVector m = cross<Ball>(BallVector(vertices[1] - vertices[0]), BallVector(vertices[2] - vertices[0]));
  const Ball m_squared = dot(m, m);
  if (m_squared.containsZero()) return {};  // three vertices on a line: no area, whatever the receiver
  const Taylor volume = r[0](0) * m(0) + r[0](1) * m(1) + r[0](2) * m(2);
  if (volume.value.containsZero()) {
    throw std::domain_error("the receiver is in the plane of a triangle (volume " + volume.value.toDecimal(5) +
                            "); polar coordinates need it outside");
  }
  const std::vector<TaylorVector> visible = aboveHorizon<Taylor, 3>(r, n, true);
  TaylorVector foot;
  for (Eigen::Index k = 0; k < 3; ++k) foot(k) = volume * (m(k) / m_squared);
  const Taylor height_squared = volume * volume * (Ball(1) / m_squared);

  Taylor sum;
  for (std::size_t i = 0; i < visible.size(); ++i) {
    const TaylorVector& start = visible[i];
    const TaylorVector& end = visible[(i + 1) % visible.size()];
    TaylorVector q0;
    TaylorVector e;
    for (Eigen::Index k = 0; k < 3; ++k) {
      q0(k) = start(k) - foot(k);
      e(k) = end(k) - start(k);
    }
    const std::array<Ball, Taylor::kTerms> terms =
        integrateUnitInterval<Taylor::kTerms>(EdgeIntegrand(foot, height_squared, q0, e, n));
    Taylor integral(terms[0]);
    for (std::size_t k = 0; k < 3; ++k) integral.gradient[k] = terms[1 + k];
    for (std::size_t k = 0; k < Taylor::kSecond; ++k) integral.hessian[k] = terms[4 + k];
    sum += dot(cross<Taylor>(start, e), foot) * integral;
  }
  return sum;
}

}  // namespace

FormFactorEnclosure enclosePolar(const Polygon& polygon, const Receiver& receiver, int digits) {
  const slong first_precision = precisionForDigits(2 * digits);
  for (slong precision = first_precision; precision <= 16 * first_precision; precision *= 2) {
    const WorkingPrecision scope(precision);
    const BallVector position = exactly(receiver.position);
    const BallVector normal = exactly(receiver.normal);
    Taylor sum;
    Taylor over_normal;
    for (std::size_t i = 1; i + 1 < polygon.vertices.size(); ++i) {
      const std::array<BallVector, 3> triangle = {exactly(polygon.vertices[0]), exactly(polygon.vertices[i]),
                                                  exactly(polygon.vertices[i + 1])};
      sum += triangleFormFactor(triangle, variable(position), constant(normal));
      over_normal += triangleFormFactor(triangle, constant(position), variable(normal));
    }
    sum *= Ball(1) / Ball::pi();
    over_normal *= Ball(1) / Ball::pi();
    FormFactorEnclosure result;
    result.value = sum.value;
    for (std::size_t i = 0, k = 0; i < 3; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      result.gradient(row) = sum.gradient[i];
      result.normal_gradient(row) = over_normal.gradient[i];
      for (std::size_t j = i; j < 3; ++j, ++k) {
        const auto column = static_cast<Eigen::Index>(j);
        result.hessian(row, column) = result.hessian(column, row) = sum.hessian[k];
      }
    }
    if (correctDigits(result) >= digits) return result;
  }
  throw std::runtime_error("polygon \"" + polygon.name + "\": " + std::to_string(digits) +
                           " digits are not reached at " + std::to_string(16 * first_precision) +
                           " bits; the receiver is too near an edge");
}

}  // namespace irradiff
