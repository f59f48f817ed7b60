#include "experiments/cache_2d/flatland_field.h"

#include "derivatives/scene/invalid_scene.h"
#include "experiments/cache/irradiance_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>

namespace irradiff {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

FlatlandRoom roomNamed(const std::string& name) { return readFlatlandRoom("data/rooms/" + name + ".json"); }

MetricChoice choiceOf(const std::string& metric, double threshold) {
  MetricChoice choice;
  choice.metric = metric;
  choice.threshold = threshold;
  choice.radiance_share = 0.0;
  choice.smallest_pixels = 1e-6;
  choice.largest_pixels = 1e6;
  return choice;
}

TEST(FlatlandField, HasReceiversAlongTheWalls) {
  const FlatlandRoom room = roomNamed("flatland_slot");
  const RecordField field = flatlandField(room, {400, FlatlandLight::kIndirect, 1});
  EXPECT_EQ(field.name, "flatland_slot");
  EXPECT_EQ(field.height, 1u);
  EXPECT_EQ(field.rays_per_record, 0u);
  EXPECT_THAT(field.metrics, ElementsAre("split-sphere", "bounded-split-sphere", "radiometric-hessian",
                                         "geometric-hessian", "occlusion-hessian", "reprojection", "oracle"));
  ASSERT_EQ(field.receivers.size(), field.pixels.size());
  EXPECT_NEAR(static_cast<double>(field.width), 400.0, 7.0);
  EXPECT_LT(field.pixels.back(), field.width);
  double length = 0.0;
  for (std::size_t i = 0; i < field.receivers.size(); ++i) {
    if (i > 0) {
      EXPECT_LT(field.pixels[i - 1], field.pixels[i]);
    }
    length += field.pixel_sizes[i];
    const Segment& wall = room.segments[field.faces[i] / 2];
    const Eigen::Vector2d offset = field.receivers[i].position.head<2>() - wall.vertices[0];
    const Eigen::Vector2d edge = wall.vertices[1] - wall.vertices[0];
    EXPECT_NEAR(offset.dot(edge.normalized()) + (wall.vertices[1] - wall.vertices[0] - offset).norm(), edge.norm(),
                1e-14);
    EXPECT_NEAR(field.receivers[i].normal.head<2>().dot(edge), 0.0, 1e-15);
  }
  // Floor, ceiling, walls once, partitions and lamp on both sides.
  double expected = 2.0 * (3.0 + 2.0);
  for (const std::size_t i : {4u, 5u, 6u}) {
    expected += 2.0 * (room.segments[i].vertices[1] - room.segments[i].vertices[0]).norm();
  }
  EXPECT_NEAR(length, expected, 1e-12);
}

/// All numbers of the records of all metrics, bit for bit.
std::vector<double> bitsOf(const RecordField& field) {
  std::vector<double> numbers = field.reference;
  for (const std::string& metric : field.metrics) {
    const RecordMaker maker = field.records(choiceOf(metric, 1e-3));
    for (std::size_t i = 0; i < field.receivers.size(); ++i) {
      const CacheRecord record = maker(i);
      for (const Eigen::Vector3d& v : {record.gradient, record.rotational_gradient, record.first_axis}) {
        numbers.insert(numbers.end(), v.data(), v.data() + 3);
      }
      numbers.push_back(record.half_axes(0));
      numbers.push_back(field.true_error(i, record));
    }
  }
  return numbers;
}

TEST(FlatlandField, DoesNotDependOnThreads) {
  const FlatlandRoom room = roomNamed("flatland_lamp");
  const std::vector<double> alone = bitsOf(flatlandField(room, {300, FlatlandLight::kTotal, 1}));
  const std::vector<double> together = bitsOf(flatlandField(room, {300, FlatlandLight::kTotal, 3}));
  ASSERT_EQ(alone.size(), together.size());
  EXPECT_EQ(std::memcmp(alone.data(), together.data(), alone.size() * sizeof(double)), 0);
}

TEST(FlatlandField, RecordsExtrapolateAlongTheirWalls) {
  const RecordField field = flatlandField(roomNamed("flatland_lamp"), {2000, FlatlandLight::kIndirect, 1});
  const RecordMaker maker = field.records(choiceOf("occlusion-hessian", 1e-3));
  std::size_t near = 0;
  std::size_t pairs = 0;
  std::size_t near_backwards = 0;
  for (std::size_t i = 0; i + 1 < field.receivers.size(); i += 7) {
    if (field.faces[i] != field.faces[i + 1]) continue;
    CacheRecord record = maker(i);
    ++pairs;
    const auto error = [&] { return std::abs(extrapolated(record, field.receivers[i + 1]) - field.reference[i + 1]); };
    const double step = field.pixel_sizes[i];
    near += error() < 0.02 * std::abs(record.gradient.norm()) * step + 5.0 * step * step ? 1 : 0;
    record.gradient = -record.gradient;
    near_backwards += error() < 0.02 * std::abs(record.gradient.norm()) * step + 5.0 * step * step ? 1 : 0;
    // A turned normal, in its plane.
    EXPECT_EQ(record.rotational_gradient.head<2>(), Eigen::Vector2d::Zero());
    EXPECT_EQ(record.second_axis, Eigen::Vector3d::UnitZ());
    EXPECT_NEAR(record.first_axis.dot(field.receivers[i].normal), 0.0, 1e-15);
  }
  EXPECT_GE(near, pairs * 9 / 10);
  EXPECT_LT(near_backwards, pairs / 2) << "a gradient of the wrong sign passes";
}

TEST(FlatlandField, OracleKeepsTheTrueErrorAtTheThreshold) {
  const RecordField field = flatlandField(roomNamed("flatland_slot"), {500, FlatlandLight::kIndirect, 1});
  for (const ErrorScale scale : {ErrorScale::kRelative, ErrorScale::kAbsolute}) {
    for (const double threshold : {1e-5, 1e-3}) {
      MetricChoice choice = choiceOf("oracle", threshold);
      choice.ellipse.scale = scale;
      const RecordMaker maker = field.records(choice);
      std::size_t limited = 0;
      for (std::size_t i = 0; i < field.receivers.size(); ++i) {
        const CacheRecord record = maker(i);
        const double allowed = threshold * (scale == ErrorScale::kRelative ? record.irradiance : 1.0);
        if (record.half_axes(0) > 10.0) {
          EXPECT_LE(field.true_error(i, record), allowed);
          ++limited;
          continue;
        }
        EXPECT_NEAR(field.true_error(i, record), allowed, 1e-10 * allowed);
      }
      EXPECT_LT(limited, field.receivers.size() / 4);
    }
  }
}

TEST(FlatlandField, TrueErrorIsTheSumOverReceivers) {
  // Eq. (4) by its definition, over whole cells.
  const RecordField field = flatlandField(roomNamed("flatland_lamp"), {1500, FlatlandLight::kIndirect, 1});
  const RecordMaker maker = field.records(choiceOf("oracle", 1e-3));
  double largest = 0.0;
  for (std::size_t i = 0; i < field.receivers.size(); i += 37) {
    CacheRecord record = maker(i);
    record.half_axes.setConstant(20.5 * field.pixel_sizes[i]);
    double sum = 0.0;
    double scale = 0.0;
    for (std::size_t j = 0; j < field.receivers.size(); ++j) {
      const Eigen::Vector3d offset = field.receivers[j].position - record.receiver.position;
      if (field.receivers[j].normal.dot(record.receiver.normal) < 0.9) continue;
      if (std::abs(offset.dot(record.receiver.normal)) > 1e-9 || offset.norm() > record.half_axes(0)) continue;
      const double error = std::abs(field.reference[j] - extrapolated(record, field.receivers[j]));
      sum += error * field.pixel_sizes[j];
      scale += error * field.pixel_sizes[j];
    }
    largest = std::max(largest, std::abs(field.true_error(i, record) / sum - 1.0));
  }
  EXPECT_LE(largest, 0.1) << "of the same cells, at other points of them";
  std::cout << "true error over the sum over receivers is off by " << largest << "\n";
}

TEST(FlatlandField, PublishedLengthsFollowTheirFormulas) {
  const RecordField field = flatlandField(roomNamed("flatland_lamp"), {200, FlatlandLight::kIndirect, 1});
  const auto length = [&](const std::string& metric, double threshold, std::size_t i) {
    return field.records(choiceOf(metric, threshold))(i).half_axes(0);
  };
  std::size_t unlike = 0;
  for (std::size_t i = 3; i < field.receivers.size(); i += 11) {
    const double occlusion = length("occlusion-hessian", 1e-4, i);
    const double radiometric = length("radiometric-hessian", 1e-4, i);
    // R^3 goes with the threshold, the split sphere with the threshold itself.
    EXPECT_NEAR(length("occlusion-hessian", 8e-4, i) / occlusion, 2.0, 1e-12);
    EXPECT_NEAR(length("split-sphere", 0.2, i) / length("split-sphere", 0.1, i), 2.0, 1e-12);
    EXPECT_LE(length("bounded-split-sphere", 0.1, i), length("split-sphere", 0.1, i));
    unlike += std::abs(radiometric / occlusion - 1.0) > 1e-3 ? 1 : 0;
  }
  EXPECT_GT(unlike, 9u);
}

TEST(FlatlandField, BlackRecordsHaveRegions) {
  // Without a slot no light reaches the lower room, whose walls go on above.
  FlatlandRoom room = roomNamed("flatland_slot");
  room.segments[4].vertices[1] = room.segments[5].vertices[0];
  const RecordField field = flatlandField(room, {300, FlatlandLight::kIndirect, 1});
  std::size_t black = 0;
  for (const std::string& metric : field.metrics) {
    MetricChoice choice = choiceOf(metric, 1e-3);
    choice.smallest_pixels = 1.0;
    const RecordMaker maker = field.records(choice);
    for (std::size_t i = 0; i < field.receivers.size(); ++i) {
      const CacheRecord record = maker(i);
      EXPECT_GT(record.half_axes(0), 0.0);
      EXPECT_TRUE(record.gradient.allFinite());
      EXPECT_NE(field.receivers[i].position.y(), 0.0) << "the floor has no light at all";
      if (record.irradiance == 0.0) ++black;
    }
  }
  EXPECT_GT(black, 100u);
}

TEST(FlatlandField, IsFiniteWhereAllIsInLine) {
  // Symmetric, with receivers in line with ends, under a wall that stands on the floor and on the line of others.
  const auto p = [](double x, double y) { return Eigen::Vector2d(x, y); };
  FlatlandRoom room{"symmetric", "", {}, {}};
  const auto add = [&room](const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radiance) {
    room.segments.push_back({"segment", {a, b}, radiance});
    room.reflectances.push_back(0.5);
  };
  add(p(-1, 0), p(1, 0), 0.0);
  add(p(1, 0), p(1, 2), 0.0);
  add(p(1, 2), p(0.5, 2), 0.0);
  add(p(0.5, 2), p(-0.5, 2), 3.0);
  add(p(-0.5, 2), p(-1, 2), 0.0);
  add(p(-1, 2), p(-1, 0), 0.0);
  add(p(-0.5, 1), p(0.5, 1), 0.0);
  add(p(0, 0), p(0, 0.5), 0.0);
  add(p(-0.5, 1.5), p(0, 1.5), 1.0);
  add(p(0, 1.5), p(0.5, 1.5), 0.0);
  for (const FlatlandLight light : {FlatlandLight::kIndirect, FlatlandLight::kTotal}) {
    for (const std::size_t receivers : {7u, 128u, 129u}) {
      const RecordField field = flatlandField(room, {receivers, light, 1});
      for (const double number : bitsOf(field)) EXPECT_TRUE(std::isfinite(number));
      EXPECT_GT(*std::ranges::min_element(field.reference), 0.0);
    }
  }
}

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing is wrong";
}

TEST(FlatlandField, BadInputIsNamedWithValueAndRule) {
  const FlatlandRoom room = roomNamed("flatland_lamp");
  EXPECT_EQ(messageOf([&] {
              flatlandField(room, {0, FlatlandLight::kIndirect, 1});
            }),
            "room flatland_lamp: 0 receivers asked for, must be 1 to 4194304");
  const RecordField field = flatlandField(room, {40, FlatlandLight::kIndirect, 1});
  EXPECT_THAT(messageOf([&] { field.records(choiceOf("hessian", 1.0)); }),
              HasSubstr("unknown error metric \"hessian\": must be one of split-sphere, "));
  for (const std::string& metric : field.metrics) {
    EXPECT_THAT(messageOf([&] { field.records(choiceOf(metric, 0.0)); }), HasSubstr("threshold"));
    EXPECT_THAT(messageOf([&] { field.records(choiceOf(metric, std::nan(""))); }), HasSubstr("threshold"));
    MetricChoice choice = choiceOf(metric, 1.0);
    choice.largest_pixels = 1e-9;
    EXPECT_THAT(messageOf([&] { field.records(choice); }), HasSubstr("limits of the radius"));
    choice = choiceOf(metric, 1.0);
    choice.radiance_share = -1.0;
    EXPECT_THAT(messageOf([&] { field.records(choice); }), HasSubstr("is -1, must be finite and >= 0"));
  }
  FlatlandRoom dark = room;
  for (double& reflectance : dark.reflectances) reflectance = 0.0;
  dark.segments.push_back({"outside", {Eigen::Vector2d(-2, 0), Eigen::Vector2d(-2, 2)}, 0.0});
  dark.reflectances.push_back(1.0);
  EXPECT_EQ(messageOf([&] {
              flatlandField(dark, {40, FlatlandLight::kIndirect, 1});
            }),
            "room flatland_lamp: no light arrives on a wall that reflects, must on one");
  EXPECT_EQ(messageOf([&] { flatlandLightOf("all"); }), "unknown light \"all\": must be one of indirect, total");
}

}  // namespace
}  // namespace irradiff
