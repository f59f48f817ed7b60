// The Hessians that know no occlusion: by automatic differentiation of the kernel, over walls that stay where they are.

#include "experiments/cache_2d/gather.h"
#include "experiments/cache_2d/sight_terms.h"
#include "experiments/cache_2d/wall_receivers.h"

#include <boost/math/quadrature/gauss.hpp>
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace irradiff {
namespace {

TEST(SightTerms, AreDerivativesOfTheFirst) {
  // With respect to the receiver's steps along and across: a point's x and h shrink by them.
  using Jet = ceres::Jet<double, 2>;
  for (const Eigen::Vector2d& p : {Eigen::Vector2d(0.3, 1.2), Eigen::Vector2d(-2.0, 0.1), Eigen::Vector2d(5.0, 3.0)}) {
    Jet x(p.x());
    Jet h(p.y());
    x.v[0] = -1.0;
    h.v[1] = -1.0;
    const SightTermsOf<Jet> terms = sightTerms(x, h);
    const double size = 1e-15 / (p.y() * p.y());
    EXPECT_NEAR(terms[kSight].v[0], terms[kSightAlong].a, size);
    EXPECT_NEAR(terms[kSight].v[1], terms[kSightAcross].a, size);
    EXPECT_NEAR(terms[kSightAlong].v[0], terms[kSightCurvature].a, size);
    // A turn by alpha takes S = -sin theta to -sin(theta + alpha).
    EXPECT_NEAR(terms[kSightTurn].a, std::cos(std::atan2(p.x(), p.y())), 1e-15);
  }
}

/// The second derivative of k = dS/du along the receiver's tangent, for a wall start + u step.
double kernelSecondDerivative(const Eigen::Vector2d& start, const Eigen::Vector2d& step, double u) {
  using Jet = ceres::Jet<double, 1>;
  using SecondJet = ceres::Jet<Jet, 1>;
  const auto constant = [](double value) { return SecondJet(Jet(value)); };
  const Eigen::Vector2d p = start + u * step;
  SecondJet x = constant(p.x());
  x.a.v[0] = -1.0;
  x.v[0] = Jet(-1.0);
  const SecondJet h = constant(p.y());
  const SecondJet square = x * x + h * h;
  const SecondJet kernel = h * (x * constant(step.y()) - h * constant(step.x())) / (square * sqrt(square));
  return kernel.v[0].v[0];
}

/// Sum over panels that grow from the foot of the receiver on the wall.
template <class Integrand>
double panelSum(const Integrand& integrand, double from, double to, double foot, double distance) {
  constexpr int kPanels = 200;
  const double start = std::asinh((from - foot) / distance);
  const double width = (std::asinh((to - foot) / distance) - start) / kPanels;
  double sum = 0.0;
  for (int i = 0; i < kPanels; ++i) {
    sum += boost::math::quadrature::gauss<double, 15>::integrate(
        [&](double v) { return integrand(foot + distance * std::sinh(v)) * distance * std::cosh(v); },
        start + i * width, start + (i + 1) * width);
  }
  return sum;
}

TEST(StaticWalls, HessiansAreThoseOfTheKernel) {
  for (const std::string name : {"flatland_lamp", "flatland_slot"}) {
    const LitRoom room(readFlatlandRoom("data/rooms/" + name + ".json"), false);
    const WallReceivers walls(room, 53);
    double largest = 0.0;
    double largest_absolute = 0.0;
    std::size_t ends_alone = 0;
    std::size_t moving = 0;
    for (const WallReceiver& r : walls.receivers) {
      const FlatlandGather g = gather(room, r.side, r.position);
      const FlatlandFrame frame = frameOn(room.side(r.side), r.position);
      double hessian = 0.0;
      double absolute = 0.0;
      double from_ends = 0.0;
      for (const SeenPiece& piece : seenFrom(room, r.side, r.position)) {
        const std::size_t seen = room.sideOf(piece.segment, piece.is_right);
        const Eigen::Vector2d start = frame.local(room.side(seen).origin);
        const Eigen::Vector2d step = frame.direction(room.side(seen).tangent);
        const Eigen::Vector2d local = room.side(seen).local(r.position);
        const auto sum = [&](const auto& integrand, double from, double to) {
          return panelSum(integrand, from, to, local.x(), std::abs(local.y()));
        };
        const DirectLight& light = room.light(seen);
        for (std::size_t k = 0; k + 1 < light.borders().size(); ++k) {
          const double from = std::max(light.borders()[k], piece.first.along);
          const double to = std::min(light.borders()[k + 1], piece.last.along);
          if (from >= to) continue;
          hessian += sum(
              [&](double u) { return room.radiance(seen, k, u).irradiance * kernelSecondDerivative(start, step, u); },
              from, to);
        }
        absolute += sum([&](double u) { return std::abs(kernelSecondDerivative(start, step, u)); }, piece.first.along,
                        piece.last.along);
        from_ends += std::abs(piece.last.wallTerms()[kSightCurvature] - piece.first.wallTerms()[kSightCurvature]);
      }
      // Panels know nothing of the kinks of the absolute value.
      largest_absolute = std::max(largest_absolute, std::abs(g.kernel_curvature / absolute - 1.0));
      largest = std::max(largest, std::abs(g.unaware_hessian - hessian) / g.kernel_curvature);
      ends_alone += std::abs(from_ends / absolute - 1.0) > 1e-3 ? 1 : 0;
      moving += std::abs(g.hessian - hessian) > 1e-6 * g.kernel_curvature ? 1 : 0;
      EXPECT_LE(std::abs(g.unaware_hessian), 10.0 * g.kernel_curvature) << "radiance is at most that of the lamp";
    }
    EXPECT_LE(largest, 1e-12);
    EXPECT_LE(largest_absolute, 1e-4);
    EXPECT_GT(ends_alone, walls.receivers.size() / 2) << "extrema of the kernel between the ends are not noticed";
    EXPECT_GT(moving, walls.receivers.size() / 2) << "the motion of occlusion is not noticed";
    std::cout << name << ": unaware Hessian off by " << largest << " of the kernel's curvature, that by "
              << largest_absolute << " of itself\n";
  }
}

}  // namespace
}  // namespace irradiff
