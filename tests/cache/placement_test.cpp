#include "experiments/cache/placement.h"

#include "experiments/cache/image_error.h"
#include "tests/cache/synthetic_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <iterator>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

using cache_test::AffineIrradiance;
using cache_test::bumpyField;
using cache_test::capField;
using cache_test::choiceOf;
using cache_test::refusal;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// The greedy loop over all records for each receiver, with the radii times `enlargement`.
std::vector<std::size_t> greedyReceivers(const RecordField& field, const RecordMaker& maker,
                                         const std::vector<std::size_t>& order, double enlargement,
                                         std::vector<std::size_t> made = {}) {
  std::vector<CacheRecord> records;
  const auto enlarged = [&](std::size_t receiver) {
    CacheRecord record = maker(receiver);
    record.half_axes *= enlargement;
    return record;
  };
  std::ranges::transform(made, std::back_inserter(records), enlarged);
  for (const std::size_t receiver : order) {
    const bool is_served = std::ranges::any_of(records, [&](const CacheRecord& record) {
      return weight(record, field.receivers[receiver], kDefaultNormalDeviation) > 0.0;
    });
    if (is_served) continue;
    records.push_back(enlarged(receiver));
    made.push_back(receiver);
  }
  return made;
}

std::vector<std::size_t> inRows(const RecordField& field) {
  std::vector<std::size_t> order(field.receivers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

/// By the largest of 16, 8, 4, 2, 1 that divides both coordinates, within it by rows.
std::vector<std::size_t> refining(const RecordField& field) {
  std::vector<std::size_t> order;
  for (const std::size_t spacing : {16, 8, 4, 2, 1}) {
    for (std::size_t i = 0; i < field.pixels.size(); ++i) {
      const std::size_t column = field.pixels[i] % field.width;
      const std::size_t row = field.pixels[i] / field.width;
      if (std::min(std::gcd(std::gcd(column, row), 16), std::size_t{16}) == spacing) order.push_back(i);
    }
  }
  return order;
}

TEST(Placement, IsTheGreedyLoopInBothOrders) {
  for (const RecordField& field : {bumpyField(48), capField(40, {})}) {
    const RecordMaker maker = field.records(choiceOf("circle", 0.11));
    PlacementOptions options;
    options.order = PlacementOrder::kRows;
    EXPECT_EQ(place(field, maker, options).record_receivers, greedyReceivers(field, maker, inRows(field), 1.0));
    options.order = PlacementOrder::kRefining;
    EXPECT_EQ(place(field, maker, options).record_receivers, greedyReceivers(field, maker, refining(field), 1.0));
    // Orders matter.
    EXPECT_NE(greedyReceivers(field, maker, inRows(field), 1.0), greedyReceivers(field, maker, refining(field), 1.0));
  }
}

TEST(Placement, AsksForEachReceiverOnce) {
  const RecordField field = capField(40, {});
  const Placement placement = place(field, field.records(choiceOf("circle", 1e-300)), {});
  EXPECT_EQ(placement.record_receivers, refining(field));
  EXPECT_EQ(placement.irradiance, field.reference);
  EXPECT_FALSE(placement.reached_limit);
}

TEST(Placement, RefinesFromLargeRegionsToSmall) {
  const RecordField field = bumpyField(48);
  const RecordMaker maker = field.records(choiceOf("circle", 0.07));
  PlacementOptions options;
  options.order = PlacementOrder::kRows;
  options.refinement_passes = 3;
  std::vector<std::size_t> expected;
  std::vector<std::size_t> counts;
  for (const double enlargement : {4.0, 2.0, 1.0}) {
    expected = greedyReceivers(field, maker, inRows(field), enlargement, expected);
    counts.push_back(expected.size());
  }
  EXPECT_LT(2 * counts[0], counts[1]);
  EXPECT_LT(2 * counts[1], counts[2]);
  const Placement placement = place(field, maker, options);
  EXPECT_EQ(placement.record_receivers, expected);
  for (const CacheRecord& record : placement.records) EXPECT_EQ(record.half_axes, Eigen::Vector2d(0.07, 0.07));
}

TEST(Placement, HasAnOvertureOfAllRecords) {
  const RecordField field = bumpyField(48);
  const RecordMaker maker = field.records(choiceOf("hessian", 1e-5));
  PlacementOptions options;
  options.order = PlacementOrder::kRows;
  const Placement placement = place(field, maker, options);
  options.has_overture = false;
  const Placement single = place(field, maker, options);
  EXPECT_EQ(placement.record_receivers, single.record_receivers);

  IrradianceCache all;
  for (const CacheRecord& record : placement.records) all.add(record);
  IrradianceCache so_far;
  std::size_t next = 0;
  for (std::size_t i = 0; i < field.receivers.size(); ++i) {
    EXPECT_EQ(placement.irradiance[i], all.interpolate(field.receivers[i]));
    if (next < single.records.size() && single.record_receivers[next] == i) so_far.add(single.records[next++]);
    EXPECT_EQ(single.irradiance[i], so_far.interpolate(field.receivers[i]));
  }
  const double with = imageError(placement.irradiance, field.reference).rms;
  const double without = imageError(single.irradiance, field.reference).rms;
  std::cout << "RMSE in rows with overture " << with << ", without " << without << '\n';
  EXPECT_LT(1.2 * with, without);
}

// E affine in position and in n, on a cap of the sphere: what is left is at most |v| (1 - cos 0.2) of each record, and
// so of each mean. With n x n_i in place of n_i x n, twice the turn.
TEST(Placement, IsSecondOrderOnACurvedSurface) {
  const AffineIrradiance truth;
  const RecordField field = capField(64, truth);
  const RecordMaker maker = field.records(choiceOf("circle", 0.15));
  const auto largestError = [&](const RecordMaker& records) {
    const Placement placement = place(field, records, {});
    double worst = 0.0;
    for (std::size_t i = 0; i < field.receivers.size(); ++i) {
      worst = std::max(worst, std::abs(placement.irradiance[i] - field.reference[i]));
    }
    return worst;
  };
  const double bound = truth.source.norm() * (1.0 - std::cos(kDefaultNormalDeviation));
  const double right = largestError(maker);
  const double flipped = largestError([&](std::size_t i) {
    CacheRecord record = maker(i);
    record.rotational_gradient *= -1.0;
    return record;
  });
  std::cout << "cap: largest error " << right << ", bound " << bound << ", flipped pair " << flipped << '\n';
  EXPECT_LT(right, bound);
  EXPECT_GT(flipped, bound);
}

TEST(Placement, StopsAtTheRecordLimitAndSaysSo) {
  const RecordField field = bumpyField(48);
  const RecordMaker maker = field.records(choiceOf("circle", 0.1));
  for (const auto& [has_overture, passes] : {std::pair(true, 1), std::pair(false, 1), std::pair(false, 3)}) {
    PlacementOptions options;
    options.refinement_passes = static_cast<std::size_t>(passes);
    const std::size_t enough = place(field, maker, options).records.size();
    options.has_overture = has_overture;
    options.most_records = 10;
    const Placement part = place(field, maker, options);
    EXPECT_TRUE(part.reached_limit);
    EXPECT_EQ(part.records.size(), 10U);
    IrradianceCache cache;
    for (const CacheRecord& record : part.records) cache.add(record);
    for (std::size_t i = 0; i < field.receivers.size(); ++i) {
      EXPECT_NE(std::isnan(part.irradiance[i]), cache.serves(field.receivers[i]));
    }
    options.most_records = enough;
    EXPECT_FALSE(place(field, maker, options).reached_limit);
  }
}

TEST(Placement, CountsWhatItPlaces) {
  const RecordField field = bumpyField(48);
  const RecordMaker maker = field.records(choiceOf("hessian", 1e-5));
  PlacementOptions options;
  options.clamps_neighbours = true;
  options.refinement_passes = 2;
  const std::size_t count = place(field, maker, options).records.size();
  EXPECT_EQ(countRecords(field, maker, options, field.receivers.size()), count);
  EXPECT_EQ(countRecords(field, maker, options, count), count);
  EXPECT_EQ(countRecords(field, maker, options, count - 1), std::nullopt);
}

TEST(Placement, NeedsOneRecordWhereNothingLimitsIt) {
  const RecordField plane = bumpyField(32);
  EXPECT_THAT(place(plane, plane.records(choiceOf("circle", kInfinite)), {}).record_receivers, ElementsAre(0U));
  // Normals do, on a cap.
  const RecordField cap = capField(64, {});
  const Placement placement = place(cap, cap.records(choiceOf("circle", kInfinite)), {});
  EXPECT_GT(placement.records.size(), 20U);
  for (const double irradiance : placement.irradiance) EXPECT_TRUE(std::isfinite(irradiance));
}

TEST(Placement, HasTheSameBitsOnAnyThread) {
  const RecordField field = bumpyField(64);
  const RecordMaker maker = field.records(choiceOf("hessian", 1e-5));
  std::vector<Placement> placements(4);
  {
    std::vector<std::jthread> threads;
    threads.reserve(placements.size());
    for (Placement& placement : placements) threads.emplace_back([&] { placement = place(field, maker, {}); });
  }
  for (const Placement& placement : placements) {
    EXPECT_EQ(placement.irradiance, placements[0].irradiance);
    EXPECT_EQ(placement.record_receivers, placements[0].record_receivers);
  }
}

TEST(Placement, RefusesWhatItCannotPlace) {
  RecordField field = bumpyField(16);
  const auto refused = [&](double radius, const PlacementOptions& options) {
    return refusal([&] { place(field, field.records(choiceOf("circle", radius)), options); });
  };
  EXPECT_THAT(refusal([&] {
                const RecordMaker maker = field.records(choiceOf("circle", 1.0));
                place(field,
                      [&](std::size_t i) {
                        CacheRecord record = maker(i);
                        record.half_axes(1) = 0.0;
                        return record;
                      },
                      {});
              }),
              HasSubstr("cache record 0: the half-axes of its region are"));
  PlacementOptions options;
  options.refinement_passes = 0;
  EXPECT_THAT(refused(1.0, options), HasSubstr("0 passes, must be 1 to 32"));
  options.refinement_passes = 33;
  EXPECT_THAT(refused(1.0, options), HasSubstr("33 passes"));
  options = {};
  options.clamping_slope = 0.0;
  EXPECT_THAT(refused(1.0, options), HasSubstr("the slope of neighbour clamping is 0, must be positive and finite"));
  options = {};
  options.normal_deviation = 3.0;
  EXPECT_THAT(refused(1.0, options), HasSubstr("3 rad"));
  field.pixels.back() = 256;
  EXPECT_THAT(refused(1.0, {}), HasSubstr("pixel 256 is outside an image of 16 x 16"));
  field.pixels.pop_back();
  EXPECT_THAT(refused(1.0, {}), HasSubstr("256 receivers and 255 pixels"));
  field.pixels.clear();
  field.receivers.clear();
  EXPECT_THAT(refused(1.0, {}), HasSubstr("at least one"));
}

TEST(Placement, KnowsItsOrdersByName) {
  EXPECT_EQ(placementOrderOf("rows"), PlacementOrder::kRows);
  EXPECT_EQ(placementOrderOf("refining"), PlacementOrder::kRefining);
  EXPECT_EQ(refusal([] { placementOrderOf("spiral"); }),
            "unknown order of placement \"spiral\": must be rows or refining");
}

}  // namespace
}  // namespace irradiff
