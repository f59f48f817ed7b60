#include "experiments/cache/placement.h"
#include "tests/cache/synthetic_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using cache_test::bumpyField;
using cache_test::choiceOf;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Large regions, but for a spot of small ones about the receiver that is asked for first.
RecordMaker withASmallSpot(const RecordField& field, double large, double small) {
  const RecordMaker maker = field.records(choiceOf("circle", 1.0));
  return [maker, large, small](std::size_t i) {
    CacheRecord record = maker(i);
    record.half_axes = Eigen::Vector2d(1.0, 2.0) * (record.receiver.position.norm() < 0.1 ? small : large);
    return record;
  };
}

/// The largest R_i - R_j - slope |x_i - x_j| over all pairs.
double largestExcess(const std::vector<CacheRecord>& records, double slope) {
  double worst = -kInfinite;
  for (const CacheRecord& i : records) {
    for (const CacheRecord& j : records) {
      if (&i == &j) continue;
      const double distance = (i.receiver.position - j.receiver.position).norm();
      worst = std::max(worst, i.half_axes.minCoeff() - j.half_axes.minCoeff() - slope * distance);
    }
  }
  return worst;
}

TEST(NeighbourClamping, KeepsTheTriangleInequality) {
  const RecordField field = bumpyField(64);
  for (const double large : {0.6, kInfinite}) {
    for (const std::size_t passes : {1, 3}) {
      for (const double slope : {1.0, 0.3}) {
        const RecordMaker maker = withASmallSpot(field, large, 0.01);
        PlacementOptions options;
        options.refinement_passes = passes;
        const Placement free = place(field, maker, options);
        EXPECT_GT(largestExcess(free.records, slope), 0.1);
        options.clamps_neighbours = true;
        options.clamping_slope = slope;
        const Placement clamped = place(field, maker, options);
        EXPECT_LT(largestExcess(clamped.records, slope), 1e-15);
        EXPECT_GT(clamped.records.size(), free.records.size());
        // No more than needed: each radius is its own, or that of another record and the distance.
        for (const CacheRecord& i : clamped.records) {
          const double radius = i.half_axes.minCoeff();
          const bool is_clamped = std::ranges::any_of(clamped.records, [&](const CacheRecord& j) {
            const double distance = (i.receiver.position - j.receiver.position).norm();
            return &i != &j && std::abs(radius - j.half_axes.minCoeff() - slope * distance) < 1e-15;
          });
          EXPECT_TRUE(is_clamped || radius == 0.01 || radius == large) << radius;
        }
      }
    }
  }
}

// A record that is clamped may leave a receiver that it served. Without an overture that does not matter: it was asked
// for before.
TEST(NeighbourClamping, LeavesNoReceiverAlone) {
  const RecordField field = bumpyField(32);
  const RecordMaker maker = field.records(choiceOf("bright", 0.05));
  PlacementOptions options;
  options.clamps_neighbours = true;
  options.clamping_slope = 0.05;
  options.has_overture = false;
  const Placement single = place(field, maker, options);
  options.has_overture = true;
  const Placement placement = place(field, maker, options);
  EXPECT_GT(placement.records.size(), single.records.size());
  EXPECT_EQ(countRecords(field, maker, options, field.receivers.size()), placement.records.size());
  EXPECT_TRUE(std::ranges::none_of(single.irradiance, [](double value) { return std::isnan(value); }));
  EXPECT_TRUE(std::ranges::none_of(placement.irradiance, [](double value) { return std::isnan(value); }));
}

TEST(NeighbourClamping, IsOfDistancesOfWhichRadiiAreAShare) {
  EXPECT_EQ(clampingSlope(choiceOf("split-sphere", 0.2)), 0.2);
  EXPECT_EQ(clampingSlope(choiceOf("bounded-split-sphere", 0.3)), 0.3);
  EXPECT_EQ(clampingSlope(choiceOf("occlusion-hessian", 1e-4)), 1.0);
  EXPECT_EQ(clampingSlope(choiceOf("oracle", 1e-4)), 1.0);
}

}  // namespace
}  // namespace irradiff
