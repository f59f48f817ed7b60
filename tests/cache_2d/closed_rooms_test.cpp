// Rooms in which light has closed forms or sums that are known.

#include "experiments/cache_2d/flatland_reprojection.h"
#include "experiments/cache_2d/gather.h"
#include "experiments/cache_2d/wall_receivers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

namespace irradiff {
namespace {

/// A convex pentagon, all walls alike.
FlatlandRoom furnace(double radiance, double reflectance) {
  const std::vector<Eigen::Vector2d> corners{{-1, -1}, {2, -1}, {2, 1.5}, {0.5, 2.5}, {-1, 1.5}};
  FlatlandRoom room{"furnace", "", {}, {}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    room.segments.push_back({"wall", {corners[i], corners[(i + 1) % corners.size()]}, radiance});
    room.reflectances.push_back(reflectance);
  }
  return room;
}

TEST(Furnace, IsConstantAndKnown) {
  const FlatlandRoom room = furnace(3.0, 0.7);
  for (const bool has_direct : {false, true}) {
    const LitRoom lit(room, has_direct);
    const WallReceivers walls(lit, 333);
    // E is 2 L in every direction: directly 2 * 3, after one bounce 0.7 times that.
    const double expected = has_direct ? 6.0 + 4.2 : 4.2;
    double largest = 0.0;
    for (const WallReceiver& r : walls.receivers) {
      const FlatlandGather g = gather(lit, r.side, r.position);
      const double nearest = std::min(walls.sides[r.side].local(r.position).x(),
                                      walls.sides[r.side].length - walls.sides[r.side].local(r.position).x());
      largest = std::max({largest, std::abs(g.irradiance - expected), std::abs(g.gradient.x()) * nearest,
                          std::abs(g.gradient.y()) * nearest, std::abs(g.turn), std::abs(g.hessian) * nearest * nearest,
                          std::abs(g.unaware_hessian) * nearest * nearest});
      EXPECT_NEAR(g.unit_irradiance, 2.0, 1e-14);
      EXPECT_LT(std::abs(g.unit_hessian) * nearest * nearest, 1e-13);
      EXPECT_GT(g.kernel_curvature, 0.1) << "absolute values do not cancel";
    }
    EXPECT_LE(largest, 1e-13 * expected);
    std::cout << "furnace: off by " << largest << "\n";
  }
}

TEST(Furnace, OutsidesHaveNoReceivers) {
  const LitRoom lit(furnace(1.0, 0.5), true);
  for (const WallReceiver& r : WallReceivers(lit, 100).receivers) {
    const WallSide& side = lit.side(r.side);
    EXPECT_GT((Eigen::Vector2d(0.5, 0.5) - r.position).dot(side.normal), 0.0);
  }
}

/// What arrives on all sides, by the middles of cells.
double received(const FlatlandRoom& room, bool has_direct) {
  const LitRoom lit(room, has_direct);
  double sum = 0.0;
  for (const WallReceiver& r : WallReceivers(lit, 4000).receivers) {
    sum += gather(lit, r.side, r.position).irradiance * r.cell_length;
  }
  return sum;
}

TEST(Energy, WhatLeavesArrives) {
  FlatlandRoom room = readFlatlandRoom("data/rooms/flatland_slot.json");
  // All walls have receivers, and reflect the same share.
  for (double& reflectance : room.reflectances) reflectance = 0.6;
  const double indirect = received(room, false);
  const double direct = received(room, true) - indirect;
  // A unit of length of radiance L gives 2 L on each side.
  const Segment& lamp = room.segments.back();
  const double emitted = 2.0 * 2.0 * lamp.radiance * (lamp.vertices[1] - lamp.vertices[0]).norm();
  EXPECT_NEAR(direct, emitted, 5e-4 * emitted);
  EXPECT_NEAR(indirect, 0.6 * direct, 5e-4 * direct);
  EXPECT_GT(std::abs(2.0 / std::numbers::pi * indirect - 0.6 * direct), 0.1 * direct) << "1/pi of space passes for 1/2";
  std::cout << "direct light received over emitted " << direct / emitted << ", indirect over reflected "
            << indirect / (0.6 * direct) << "\n";
}

TEST(Reprojection, PredictsAConvexRoomEverywhere) {
  FlatlandRoom room = furnace(0.0, 0.7);
  room.segments[3].radiance = 5.0;
  room.reflectances = {0.3, 0.9, 0.5, 0.2, 0.7};
  const LitRoom lit(room, false);
  const WallReceivers walls(lit, 60);
  double largest = 0.0;
  double largest_of_line = 0.0;
  for (const WallReceiver& a : walls.receivers) {
    const FlatlandReprojection view(lit, a.side, a.position);
    const FlatlandGather here = gather(lit, a.side, a.position);
    for (const std::size_t b : walls.lines[a.line]) {
      const WallReceiver& other = walls.receivers[b];
      const double step = other.along_line - a.along_line;
      const double expected = gather(lit, other.side, other.position).irradiance;
      largest = std::max(largest, std::abs(view.irradiance(step) - expected));
      largest_of_line = std::max(largest_of_line, std::abs(here.irradiance + here.gradient.x() * step - expected));
    }
  }
  EXPECT_GT(largest_of_line, 0.1) << "extrapolation to first order passes for a prediction";
  EXPECT_LE(largest, 5e-12);
  std::cout << "reprojection in a convex room is off by " << largest << "\n";
}

TEST(Reprojection, BeginsLikeTheRecord) {
  // E and its gradient, and of the Hessian all but what slides behind edges: gaps have constant radiance.
  for (const std::string name : {"flatland_lamp", "flatland_slot"}) {
    const LitRoom lit(readFlatlandRoom("data/rooms/" + name + ".json"), false);
    const WallReceivers walls(lit, 77);
    std::size_t steady = 0;
    for (const WallReceiver& r : walls.receivers) {
      const FlatlandGather g = gather(lit, r.side, r.position);
      const FlatlandReprojection view(lit, r.side, r.position);
      EXPECT_NEAR(view.irradiance(0.0), g.irradiance, 1e-12);
      // The second derivative may jump where gaps open, so slopes are wrong by a share of the step.
      const auto slope = [&view](double h) { return (view.irradiance(h) - view.irradiance(-h)) / (2.0 * h); };
      const double error = std::abs(2.0 * slope(1e-5) - slope(2e-5) - g.gradient.x());
      steady += error <= 1e-7 ? 1 : 0;
    }
    // The others have a visibility event as near as that.
    EXPECT_GE(steady, walls.receivers.size() - 2);
    std::cout << name << ": the slope of the prediction is the gradient at " << steady << " of "
              << walls.receivers.size() << "\n";
  }
}

}  // namespace
}  // namespace irradiff
