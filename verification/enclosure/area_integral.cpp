#include "verification/enclosure/area_integral.h"

#include "verification/enclosure/complex_ball.h"
#include "verification/enclosure/horizon_clip.h"

#include <acb_calc.h>

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {

using namespace enclosure;

namespace {

// Components: 0 is the kernel, 1..3 its gradient, 4..9 the upper triangle of its Hessian, all with respect to x, and
// 10..12 its gradient with respect to n.
constexpr std::size_t kNormalGradient = 10;
constexpr std::size_t kComponents = 13;
constexpr std::array<std::array<Eigen::Index, 2>, 6> kHessianEntry = {{{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};

using ComplexVector = Eigen::Matrix<ComplexBall, 3, 1>;

/// f = (n.p)(m.p) / |p|^4 or one of its derivatives with respect to x = y - p.
/// m.p is the same all over the plane and given, so that it is exactly zero where the receiver is in the plane.
ComplexBall kernel(const ComplexVector& p, const BallVector& n, const BallVector& m, const Ball& m_dot_p,
                   std::size_t component) {
  const ComplexBall np = p(0) * n(0) + p(1) * n(1) + p(2) * n(2);
  const ComplexBall mp(m_dot_p);
  const ComplexBall inverse = ComplexBall(1.0) / dot(p, p);
  const ComplexBall inverse_squared = inverse * inverse;
  if (component == 0) return np * mp * inverse_squared;
  if (component >= kNormalGradient)
    return p(static_cast<Eigen::Index>(component - kNormalGradient)) * mp * inverse_squared;
  // Derivative of the numerator along p_i.
  const auto slope = [&](Eigen::Index i) { return mp * ComplexBall(n(i)) + np * ComplexBall(m(i)); };
  if (component < 4) {
    const auto i = static_cast<Eigen::Index>(component - 1);
    return (ComplexBall(4.0) * np * mp * p(i) * inverse - slope(i)) * inverse_squared;
  }
  const auto [i, j] = kHessianEntry[component - 4];
  const ComplexBall symmetric = ComplexBall(n(i) * m(j) + n(j) * m(i));
  const ComplexBall mixed = ComplexBall(-4.0) * (slope(i) * p(j) + slope(j) * p(i));
  ComplexBall twice = ComplexBall(24.0) * np * mp * p(i) * p(j) * inverse;
  if (i == j) twice -= ComplexBall(4.0) * np * mp;
  return (symmetric + (mixed + twice) * inverse) * inverse_squared;
}

/// y - x = r + a (e1 + b (e2 - e1)) over the unit square; dA |m| = a |m|^2 da db is left to the caller's scale: with m
/// = e1 x e2 in place of the unit normal, (N.p) dA = (m.p) a da db.
struct TriangleIntegrand {
  BallVector r;
  BallVector e1;
  BallVector e2;
  BallVector n;
  BallVector m;
  Ball m_dot_p;
  std::size_t component = 0;
  slong goal = 0;
  Ball scale;  // of the component, for the absolute tolerance: components may vanish by symmetry
};

struct RadialIntegrand {
  const TriangleIntegrand* triangle;
  ComplexVector direction;  // e1 + b (e2 - e1)
};

// Rational functions are holomorphic wherever their enclosure is finite, so that `order` needs no attention.
int radialFunction(acb_ptr out, const acb_t a, void* parameter, slong /*order*/, slong /*precision*/) {
  const auto& radial = *static_cast<const RadialIntegrand*>(parameter);
  const ComplexBall distance{static_cast<const acb_struct*>(a)};
  ComplexVector p;
  for (Eigen::Index k = 0; k < 3; ++k) p(k) = radial.direction(k) * distance + ComplexBall(radial.triangle->r(k));
  const ComplexBall f =
      kernel(p, radial.triangle->n, radial.triangle->m, radial.triangle->m_dot_p, radial.triangle->component) *
      distance;
  acb_set(out, f.get());
  return 0;
}

/// Stops at 2^-goal of `scale` or of the integral. What is reached is in the radius.
ComplexBall integrate(acb_calc_func_t function, void* parameter, const Ball& scale, slong goal) {
  ComplexBall result;
  mag_t tolerance;
  mag_init(tolerance);
  arb_get_mag(tolerance, scale.get());
  mag_mul_2exp_si(tolerance, tolerance, -goal);
  acb_calc_integrate_opt_t options;
  acb_calc_integrate_opt_init(options);
  const ComplexBall zero;
  const ComplexBall one(1.0);
  acb_calc_integrate(result.get(), function, parameter, zero.get(), one.get(), goal, tolerance, options,
                     WorkingPrecision::bits());
  mag_clear(tolerance);
  return result;
}

int angularFunction(acb_ptr out, const acb_t b, void* parameter, slong /*order*/, slong /*precision*/) {
  const auto& triangle = *static_cast<const TriangleIntegrand*>(parameter);
  const ComplexBall position{static_cast<const acb_struct*>(b)};
  RadialIntegrand radial{&triangle, {}};
  for (Eigen::Index k = 0; k < 3; ++k) {
    radial.direction(k) = position * ComplexBall(triangle.e2(k) - triangle.e1(k)) + ComplexBall(triangle.e1(k));
  }
  ComplexBall result;
  if (acb_rel_accuracy_bits(b) < WorkingPrecision::bits() / 2) {
    // A wide b: only a bound is wanted, and no bisection over a could narrow it below what b's width leaves.
    constexpr int kPieces = 16;
    for (int piece = 0; piece < kPieces; ++piece) {
      const ComplexBall a(Ball::hull(Ball(piece), Ball(piece + 1)) / Ball(kPieces));
      ComplexBall f;
      radialFunction(f.get(), a.get(), &radial, 0, WorkingPrecision::bits());
      result += f * ComplexBall(1.0 / kPieces);
    }
  } else {
    result = integrate(&radialFunction, &radial, triangle.scale, triangle.goal + 10);
  }
  acb_set(out, result.get());
  return 0;
}

Ball realPart(const ComplexBall& z) {
  Ball result;
  arb_set(result.get(), acb_realref(z.get()));
  return result;
}

struct LineIntegrand {
  BallVector start;
  BallVector edge;
  BallVector m;
};

int lineFunction(acb_ptr out, const acb_t t, void* parameter, slong /*order*/, slong /*precision*/) {
  const auto& line = *static_cast<const LineIntegrand*>(parameter);
  const ComplexBall position{static_cast<const acb_struct*>(t)};
  ComplexVector p;
  for (Eigen::Index k = 0; k < 3; ++k) p(k) = position * ComplexBall(line.edge(k)) + ComplexBall(line.start(k));
  const ComplexBall square = dot(p, p);
  const ComplexBall mp = p(0) * line.m(0) + p(1) * line.m(1) + p(2) * line.m(2);
  const ComplexBall f = mp / (square * square);
  acb_set(out, f.get());
  return 0;
}

using Components = std::array<Ball, kComponents>;

void addTriangle(Components& sum, const BallVector& r0, const BallVector& r1, const BallVector& r2,
                 const BallVector& normal, slong goal) {
  TriangleIntegrand triangle{r0, r1 - r0, r2 - r0, normal, {}, {}, 0, goal, {}};
  triangle.m = cross<Ball>(triangle.e1, triangle.e2);
  triangle.m_dot_p = dot(triangle.r, triangle.m);
  ComplexVector centroid;
  for (Eigen::Index k = 0; k < 3; ++k) centroid(k) = ComplexBall((r0(k) + r1(k) + r2(k)) / Ball(3));
  const auto largest = [&](std::size_t begin, std::size_t end) {
    Ball scale;
    for (std::size_t i = begin; i < end; ++i)
      scale = max(scale, kernel(centroid, normal, triangle.m, triangle.m_dot_p, i).magnitude());
    return scale;
  };
  // In the plane F is exactly zero whatever n, and no tolerance can be met relative to that.
  const std::size_t first = triangle.m_dot_p == Ball(0) ? 1 : 0;
  const std::size_t last = triangle.m_dot_p == Ball(0) ? kNormalGradient : kComponents;
  for (std::size_t component = first; component < last; ++component) {
    triangle.component = component;
    triangle.scale = component == 0                ? largest(0, 1)
                     : component < 4               ? largest(1, 4)
                     : component < kNormalGradient ? largest(4, kNormalGradient)
                                                   : largest(kNormalGradient, kComponents);
    sum[component] += realPart(integrate(&angularFunction, &triangle, triangle.scale, goal));
  }
}

/// The motion of the cut: n n^T times the integral along it of (m.p) / (|n x m| |p|^4).
void addHorizonCut(Components& sum, const BallVector& start, const BallVector& end, const BallVector& m,
                   const BallVector& normal, slong goal) {
  LineIntegrand line{start, end - start, m};
  const BallVector n_cross_m = cross<Ball>(normal, m);
  const BallVector middle = start + line.edge * Ball(0.5);
  const Ball square = dot(middle, middle);
  const Ball scale = abs(dot(middle, m)) / (square * square);
  const Ball integral = realPart(integrate(&lineFunction, &line, scale, goal)) *
                        sqrt(dot(line.edge, line.edge) / dot(n_cross_m, n_cross_m));
  for (std::size_t k = 0; k < kHessianEntry.size(); ++k) {
    sum[4 + k] += integral * normal(kHessianEntry[k][0]) * normal(kHessianEntry[k][1]);
  }
}

void addVisiblePart(Components& sum, const std::vector<BallVector>& triangle, const BallVector& normal, slong goal) {
  const BallVector m = cross<Ball>(BallVector(triangle[1] - triangle[0]), BallVector(triangle[2] - triangle[0]));
  if (dot(m, m).containsZero()) return;  // three vertices on a line: no area
  const std::vector<BallVector> visible = aboveHorizon<Ball, 3>(triangle, normal, true);
  for (std::size_t i = 1; i + 1 < visible.size(); ++i) {
    addTriangle(sum, visible[0], visible[i], visible[i + 1], normal, goal);
  }
  for (std::size_t i = 0; i < visible.size(); ++i) {
    const BallVector& start = visible[i];
    const BallVector& end = visible[(i + 1) % visible.size()];
    // Vertices are off the horizon, so that heights that may be zero are those of cut points.
    if (dot(normal, start).containsZero() && dot(normal, end).containsZero()) {
      addHorizonCut(sum, start, end, m, normal, goal);
    }
  }
}

}  // namespace

FormFactorEnclosure encloseArea(const Polygon& polygon, const Receiver& receiver, int digits) {
  double reached = 0;
  for (int attempt = 0; attempt < 3; ++attempt) {
    const int target = digits + 2 + 15 * attempt;
    const WorkingPrecision scope(precisionForDigits(target));
    const slong goal = WorkingPrecision::bits() - 48;
    const BallVector position = exactly(receiver.position);
    const BallVector normal = exactly(receiver.normal);
    Components sum;
    for (std::size_t i = 1; i + 1 < polygon.vertices.size(); ++i) {
      addVisiblePart(sum,
                     {exactly(polygon.vertices[0]) - position, exactly(polygon.vertices[i]) - position,
                      exactly(polygon.vertices[i + 1]) - position},
                     normal, goal);
    }
    for (Ball& component : sum) component /= Ball::pi();
    FormFactorEnclosure result;
    result.value = sum[0];
    for (std::size_t i = 0; i < 3; ++i) {
      result.gradient(static_cast<Eigen::Index>(i)) = sum[1 + i];
      result.normal_gradient(static_cast<Eigen::Index>(i)) = sum[kNormalGradient + i];
    }
    for (std::size_t k = 0; k < kHessianEntry.size(); ++k) {
      const auto [i, j] = kHessianEntry[k];
      result.hessian(i, j) = result.hessian(j, i) = sum[4 + k];
    }
    reached = correctDigits(result);
    if (reached >= digits) return result;
  }
  throw std::runtime_error("polygon \"" + polygon.name + "\": nested integration gives " + std::to_string(reached) +
                           " digits instead of " + std::to_string(digits) + "; the receiver is too near the polygon");
}

}  // namespace irradiff
