// The field of records of a room.

#include "experiments/cache_3d/room_field.h"

#include "experiments/cache_3d/metric_records.h"
#include "tests/cache_3d/test_rooms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <unistd.h>

namespace irradiff {
namespace {

namespace fs = std::filesystem;

RoomFieldPlan smallPlan(unsigned threads) {
  RoomFieldPlan plan;
  plan.width = 16;
  plan.rays = 256;
  plan.seed = 5;
  plan.threads = threads;
  return plan;
}

MetricChoice choiceOf(const std::string& metric) {
  MetricChoice choice;
  choice.metric = metric;
  choice.threshold = metric.find("split") == std::string::npos ? 1e-3 : 0.4;
  if (metric == "bounded-split-sphere") choice.largest_pixels = 40.0;
  return choice;
}

bool same(const CacheRecord& a, const CacheRecord& b) {
  return a.irradiance == b.irradiance && a.gradient == b.gradient && a.rotational_gradient == b.rotational_gradient &&
         a.hessian == b.hessian && a.half_axes == b.half_axes && a.first_axis == b.first_axis &&
         a.second_axis == b.second_axis;
}

std::vector<CacheRecord> allRecords(const RecordField& field) {
  std::vector<CacheRecord> records;
  for (const std::string& metric : field.metrics) {
    for (const bool knows_geometry : {false, true}) {
      MetricChoice choice = choiceOf(metric);
      choice.knows_geometry = knows_geometry;
      const RecordMaker make = field.records(choice);
      for (std::size_t i = 0; i < field.receivers.size(); ++i) records.push_back(make(i));
    }
  }
  return records;
}

TEST(RoomField, HasReceiversTruthAndRecordsOfAllMetrics) {
  const Room room = cornerRoom();
  const RecordField field = roomField(room, smallPlan(2), nullptr);
  EXPECT_EQ(field.name, "corner");
  EXPECT_EQ(field.width, 16U);
  EXPECT_EQ(field.height, 16U);
  EXPECT_EQ(field.rays_per_record, 256U);
  EXPECT_EQ(field.metrics, recordMetrics(true));
  EXPECT_TRUE(field.offers_known_geometry);
  RoomFieldPlan few = smallPlan(2);
  few.rays = 64;
  EXPECT_FALSE(roomField(room, few, nullptr).offers_known_geometry);
  const std::size_t count = field.receivers.size();
  EXPECT_GT(count, 60U);
  EXPECT_LT(count, 256U) << "some pixels see the lamp or nothing";
  EXPECT_EQ(field.pixels.size(), count);
  EXPECT_EQ(field.faces.size(), count);
  EXPECT_EQ(field.reference.size(), count);
  EXPECT_EQ(field.pixel_sizes.size(), count);
  EXPECT_GT(field.reference_error, 0.0);
  double sum = 0.0;
  double squares = 0.0;
  double shifted = 0.0;
  const RecordMaker make = field.records(choiceOf("occlusion-hessian"));
  for (std::size_t i = 0; i < count; ++i) {
    sum += field.reference[i];
    squares += std::pow(make(i).irradiance - field.reference[i], 2);
    shifted += std::pow(make(i).irradiance - field.reference[(i + 40) % count], 2);
  }
  const double mean = sum / static_cast<double>(count);
  EXPECT_LT(field.reference_error, 1e-4 * mean);
  // 64 rays: observed 0.06 of the mean.
  EXPECT_LT(std::sqrt(squares / static_cast<double>(count)), 0.15 * mean);
  EXPECT_GT(std::sqrt(shifted / static_cast<double>(count)), 0.15 * mean) << "bad twin: another pixel's truth";
  for (const CacheRecord& record : allRecords(field)) {
    EXPECT_GT(record.half_axes.minCoeff(), 0.0);
    EXPECT_NEAR(record.first_axis.dot(record.receiver.normal), 0.0, 1e-14);
    EXPECT_NEAR(record.gradient.dot(record.receiver.normal), 0.0, 1e-14);
  }
}

TEST(RoomField, OracleKeepsTheTrueErrorAtTheThreshold) {
  const RecordField field = roomField(cornerRoom(), smallPlan(2), nullptr);
  MetricChoice choice = choiceOf("oracle");
  choice.ellipse.scale = ErrorScale::kAbsolute;
  choice.smallest_pixels = 0.0;
  const RecordMaker make = field.records(choice);
  std::size_t exhausted = 0;
  for (std::size_t i = 0; i < field.receivers.size(); ++i) {
    const CacheRecord record = make(i);
    if (!record.half_axes.allFinite()) continue;
    const double error = field.true_error(i, record);
    EXPECT_LE(error, 1.001 * choice.threshold);
    if (error > 0.98 * choice.threshold) ++exhausted;
  }
  EXPECT_GT(exhausted, field.receivers.size() / 2) << "larger regions would do";
}

TEST(RoomField, DoesNotDependOnThreads) {
  const RecordField one = roomField(cornerRoom(), smallPlan(1), nullptr);
  const RecordField three = roomField(cornerRoom(), smallPlan(3), nullptr);
  EXPECT_EQ(one.reference, three.reference);
  EXPECT_EQ(one.reference_error, three.reference_error);
  const std::vector<CacheRecord> first = allRecords(one);
  const std::vector<CacheRecord> second = allRecords(three);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) ASSERT_TRUE(same(first[i], second[i])) << i;
  RoomFieldPlan other = smallPlan(1);
  other.seed = 6;
  EXPECT_FALSE(same(allRecords(roomField(cornerRoom(), other, nullptr))[0], first[0])) << "bad twin: another seed";
}

TEST(RoomField, GoesOnFromItsTiles) {
  const fs::path folder = fs::temp_directory_path() / ("room_field_test_" + std::to_string(getpid()));
  fs::remove_all(folder);
  {
    TileStore tiles(folder, "corner");
    const RecordField first = roomField(cornerRoom(), smallPlan(2), &tiles);
    const RecordField again = roomField(cornerRoom(), smallPlan(2), &tiles);
    EXPECT_EQ(first.reference, again.reference);
    const std::vector<CacheRecord> one = allRecords(first);
    const std::vector<CacheRecord> two = allRecords(again);
    for (std::size_t i = 0; i < one.size(); ++i) ASSERT_TRUE(same(one[i], two[i])) << i;
    // The tiles are used: a reference that was spoilt there stays spoilt.
    const std::size_t row = first.pixels.back() / 16;
    std::size_t in_row = 0;
    for (const std::size_t pixel : first.pixels) in_row += pixel / 16 == row ? 1 : 0;
    tiles.write(16 + row, std::vector<double>(4 * in_row, 7.0));
    EXPECT_EQ(roomField(cornerRoom(), smallPlan(2), &tiles).reference.back(), 7.0);
    tiles.remove();
  }
  EXPECT_FALSE(fs::exists(folder));
}

TEST(RoomField, CountsRows) {
  std::size_t calls = 0;
  std::size_t last = 0;
  std::size_t all = 0;
  roomField(cornerRoom(), smallPlan(2), nullptr, [&](std::size_t done, std::size_t of) {
    ++calls;
    last = std::max(last, done);
    all = of;
  });
  EXPECT_EQ(calls, all);
  EXPECT_EQ(last, all);
  EXPECT_LE(all, 32U);
}

TEST(RoomField, NamesWhatItRefuses) {
  const auto refuses = [](RoomFieldPlan plan, const char* why) {
    EXPECT_THAT([&] { roomField(cornerRoom(), plan, nullptr); },
                testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr(why)));
  };
  RoomFieldPlan plan = smallPlan(1);
  plan.rays = 1000;
  refuses(plan, "1000 rays");
  plan = smallPlan(1);
  plan.width = 0;
  refuses(plan, "0 pixels wide");
  const RecordField field = roomField(cornerRoom(), smallPlan(1), nullptr);
  EXPECT_THAT([&] { field.records(choiceOf("ours")); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("unknown error metric \"ours\"")));
  MetricChoice negative = choiceOf("oracle");
  negative.threshold = -1.0;
  EXPECT_THAT([&] { field.records(negative); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("-1")));
}

}  // namespace
}  // namespace irradiff
