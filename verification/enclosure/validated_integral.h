#pragma once

#include "verification/enclosure/ball.h"
#include "verification/enclosure/complex_ball.h"

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff::enclosure {

/// Nodes in (-1, 1) and weights of the Gauss-Legendre rule, enclosed at the working precision and kept per thread.
struct GaussLegendreRule {
  std::vector<Ball> nodes;
  std::vector<Ball> weights;
};
const GaussLegendreRule& gaussLegendreRule(std::size_t size);

/// Encloses the integral over [0, 1] of a function with several components.
///
/// `integrand.evaluate<S>(center, offset)` returns std::array<S, K>, the components at center + offset, for S = Ball
/// and S = ComplexBall; `center` is exact and the offset a ball around zero, which lets the integrand expand about the
/// center. A result that is finite says that the function is holomorphic on the whole ball.
///
/// [0, 1] is bisected until the function is finite on a rectangle around the Bernstein ellipse rho = 4 of the piece;
/// there the n-point Gauss- Legendre rule on [-1, 1] errs by at most 64/15 M rho^(-2(n-1)) / (1 - rho^-2), with M the
/// maximum on the ellipse [Trefethen, Approximation Theory and Approximation Practice, Theorem 19.3, which has one more
/// point]. Throws std::runtime_error when a piece gets narrower than 2^-(half the working precision): a singularity in
/// [0, 1].
template <std::size_t K, class Integrand>
std::array<Ball, K> integrateUnitInterval(const Integrand& integrand) {
  const slong bits = WorkingPrecision::bits();
  const auto size = static_cast<std::size_t>(bits / 4 + 8);
  const GaussLegendreRule& rule = gaussLegendreRule(size);
  const Ball error_factor =
      Ball(64) / Ball(15) * (Ball(16) / Ball(15)) * Ball::powerOfTwo(-4 * (static_cast<slong>(size) - 1));

  struct Piece {
    Ball center;
    slong half_width_exponent;  // the piece is center +- 2^exponent
  };
  std::vector<Piece> pieces{{Ball(0.5), -1}};
  std::array<Ball, K> total;
  while (!pieces.empty()) {
    const Piece piece = pieces.back();
    pieces.pop_back();
    const Ball half_width = Ball::powerOfTwo(piece.half_width_exponent);
    // Semi-axes (rho + 1/rho)/2 and (rho - 1/rho)/2.
    const ComplexBall ellipse(Ball::aroundZero(Ball(2.125) * half_width), Ball::aroundZero(Ball(1.875) * half_width));
    const std::array<ComplexBall, K> on_ellipse = integrand.template evaluate<ComplexBall>(piece.center, ellipse);
    bool holomorphic = true;
    for (const ComplexBall& component : on_ellipse) holomorphic = holomorphic && component.isFinite();
    if (!holomorphic) {
      if (piece.half_width_exponent < -bits / 2) {
        throw std::runtime_error("integrand is singular near " + piece.center.midpointToDecimal(20) + " in [0, 1]");
      }
      const Ball quarter = Ball::powerOfTwo(piece.half_width_exponent - 1);
      pieces.push_back({piece.center - quarter, piece.half_width_exponent - 1});
      pieces.push_back({piece.center + quarter, piece.half_width_exponent - 1});
      continue;
    }
    std::array<Ball, K> sum;
    for (std::size_t k = 0; k < K; ++k) sum[k] = Ball::aroundZero(on_ellipse[k].magnitude() * error_factor);
    for (std::size_t i = 0; i < size; ++i) {
      const std::array<Ball, K> f = integrand.template evaluate<Ball>(piece.center, half_width * rule.nodes[i]);
      for (std::size_t k = 0; k < K; ++k) sum[k] += rule.weights[i] * f[k];
    }
    for (std::size_t k = 0; k < K; ++k) total[k] += half_width * sum[k];
  }
  return total;
}

}  // namespace irradiff::enclosure
