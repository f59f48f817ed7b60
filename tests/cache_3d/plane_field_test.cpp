#include "experiments/cache_3d/plane_field.h"

#include "derivatives/visibility/scene_evaluation.h"
#include "experiments/cache/image_error.h"
#include "experiments/cache/threshold_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

using testing::HasSubstr;

FigureScene figure5() { return readFigureScene(std::filesystem::path(IRRADIFF_SCENE_FOLDER) / "figure5.json"); }

RecordField fieldOf(std::size_t resolution, std::size_t rays = 0, unsigned threads = 2) {
  return planeField(figure5(), {resolution, rays, 1, threads}, nullptr);
}

/// For tests that look at many records.
const RecordField& fineField() {
  static const RecordField field = fieldOf(128);
  return field;
}

MetricChoice choiceOf(const std::string& metric, double threshold) {
  MetricChoice choice;
  choice.metric = metric;
  choice.threshold = threshold;
  choice.largest_pixels = 1e6;
  return choice;
}

/// Everything that a record is, of every metric.
std::vector<double> numbersOf(const RecordField& field) {
  std::vector<double> numbers = field.reference;
  for (const std::string& metric : field.metrics) {
    const RecordMaker make = field.records(choiceOf(metric, 0.01));
    for (std::size_t i = 0; i < field.receivers.size(); ++i) {
      const CacheRecord record = make(i);
      numbers.insert(numbers.end(), {record.irradiance, record.gradient.x(), record.half_axes(0), record.half_axes(1),
                                     record.first_axis.x(), record.first_axis.y(), record.hessian(0, 1)});
    }
  }
  return numbers;
}

TEST(PlaneField, IsUprightAndExact) {
  const RecordField field = fieldOf(24);
  ASSERT_EQ(field.receivers.size(), 24u * 24u);
  // The first pixel is the upper left one.
  EXPECT_LT(field.receivers.front().position.x(), field.receivers[23].position.x());
  EXPECT_GT(field.receivers.front().position.y(), field.receivers.back().position.y());
  EXPECT_EQ(field.rays_per_record, 0u);
  const SceneEvaluator evaluator(figure5().scene.polygons);
  const RecordMaker make = field.records(choiceOf("occlusion-hessian", 0.01));
  for (const std::size_t i : {0u, 100u, 300u, 575u}) {
    const IrradianceDerivatives<double> exact = evaluator.evaluate(field.receivers[i]).derivatives;
    EXPECT_EQ(field.reference[i], exact.irradiance.value);
    EXPECT_EQ(make(i).irradiance, exact.irradiance.value);
    EXPECT_EQ(make(i).gradient, exact.gradient.value);
  }
  EXPECT_LT(field.reference_error, 1e-12);
}

TEST(PlaneField, DoesNotDependOnThreadsNorOnUnfinishedWork) {
  for (const std::size_t rays : {0u, 64u}) {
    const PlaneFieldPlan plan{16, rays, 1, 1};
    const RecordField whole = planeField(figure5(), plan, nullptr);
    const std::vector<double> numbers = numbersOf(whole);
    EXPECT_EQ(numbersOf(fieldOf(16, rays, 2)), numbers);

    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / ("plane_field_" + std::to_string(rays));
    TileStore store(folder, planeFieldFingerprint(figure5(), plan));
    EXPECT_EQ(numbersOf(planeField(figure5(), plan, &store)), numbers);
    // From the tiles.
    EXPECT_EQ(numbersOf(planeField(figure5(), plan, &store)), numbers);
    store.remove();
    EXPECT_NE(planeFieldFingerprint(figure5(), {16, rays, 2, 1}), planeFieldFingerprint(figure5(), plan));
  }
}

TEST(PlaneField, ReprojectionIsTheTruthWhereAllPolygonsAreSeen) {
  const RecordField field = fieldOf(32);
  const RecordMaker predicted = field.records(choiceOf("reprojection", 0.01));
  const RecordMaker best = field.records(choiceOf("oracle", 0.01));
  std::size_t black = 0;
  for (std::size_t i = 0; i < field.receivers.size(); ++i) {
    if (field.reference[i] > 0.0) {
      EXPECT_EQ(predicted(i).half_axes, best(i).half_axes);
      continue;
    }
    // In the umbra the lamp is not seen: still a region of some size and not of any.
    ++black;
    EXPECT_TRUE(predicted(i).half_axes.allFinite());
    EXPECT_GT(predicted(i).half_axes(0), 0.01);
    EXPECT_LT(predicted(i).half_axes(1), 1.0);
  }
  EXPECT_GT(black, 10u);
}

/// Eq. (4) by midpoints over the receivers' own cells, which knows nothing of profiles.
double errorOverCells(const RecordField& field, const CacheRecord& record) {
  double sum = 0.0;
  for (std::size_t k = 0; k < field.receivers.size(); ++k) {
    const Eigen::Vector3d step = field.receivers[k].position - record.receiver.position;
    const double first = step.dot(record.first_axis) / record.half_axes(0);
    const double second = step.dot(record.second_axis) / record.half_axes(1);
    if (first * first + second * second > 1.0) continue;
    sum += std::abs(field.reference[k] - record.irradiance - record.gradient.dot(step)) * field.pixel_sizes[k] *
           field.pixel_sizes[k];
  }
  return sum;
}

TEST(PlaneField, OraclesRegionHasTheTrueErrorThatIsAskedFor) {
  const RecordField& field = fineField();
  const double threshold = 3e-3;
  const RecordMaker make = field.records(choiceOf("oracle", threshold));
  double ratios = 0.0;
  double turned_ratios = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < field.receivers.size(); i += 131) {
    const double allowed = threshold * field.reference[i];
    CacheRecord record = make(i);
    // Not in the dark, and with more than cells at its border.
    if (field.reference[i] < 0.05 || record.half_axes(0) < 6.0 * field.pixel_sizes[i]) continue;
    // The size is found to 2^-10, of which the error is about the fourth power.
    EXPECT_NEAR(field.true_error(i, record), allowed, 5.0 * 0x1p-10 * allowed);
    ratios += errorOverCells(field, record) / allowed;
    std::swap(record.half_axes(0), record.half_axes(1));
    turned_ratios += errorOverCells(field, record) / allowed;
    ++count;
  }
  ASSERT_GT(count, 50u);
  // One by one they are off by up to 27 %, by cells at the border and by kinks that a table of 16 directions misses.
  EXPECT_NEAR(ratios / static_cast<double>(count), 1.0, 0.05) << count;  // 0.98
  // Bad twin: with half-axes exchanged, 2.6.
  EXPECT_GT(turned_ratios / static_cast<double>(count), 1.3);
}

TEST(PlaneField, RecordsFromSamplesKnowTheirSamplesOnly) {
  const RecordField field = fieldOf(16, 1024);
  EXPECT_EQ(field.rays_per_record, 1024u);
  const RecordMaker make = field.records(choiceOf("reprojection", 0.01));
  double squares = 0.0;
  double light = 0.0;
  for (std::size_t i = 0; i < field.receivers.size(); ++i) {
    const CacheRecord record = make(i);
    EXPECT_TRUE(record.half_axes.allFinite());
    EXPECT_GT(record.half_axes(0), 0.0);
    squares += std::pow(record.irradiance - field.reference[i], 2);
    light += std::pow(field.reference[i], 2);
  }
  // A lamp in about 30 of 1024 strata: of the order of (1/30)^(3/4) = 8 %; 9 % here, and 0 if they were exact.
  EXPECT_LT(std::sqrt(squares / light), 0.2);
  EXPECT_GT(std::sqrt(squares / light), 0.02);
}

TEST(PlaneField, ReprojectionReachesItsGoalInFigure5) {
  const RecordField field = fieldOf(96);
  const auto rmsOf = [&](const std::string& metric, double threshold, std::size_t records) {
    const TunedPlacement tuned = tuneThreshold(field, choiceOf(metric, threshold), PlacementOptions{}, records);
    EXPECT_TRUE(tuned.is_within) << metric;
    return imageError(tuned.placement.irradiance, field.reference).rms;
  };
  for (const std::size_t records : {300u, 1000u}) {
    const double published = rmsOf("occlusion-hessian", 1e-3, records);
    const double ours = rmsOf("reprojection", 1e-3, records);
    const double best = rmsOf("oracle", 1e-3, records);
    const double second = rmsOf("second-order", 1e-3, records);
    std::cout << records << " records: occlusion-hessian " << published << ", reprojection " << ours
              << ", second-order " << second << ", oracle " << best << '\n';
    EXPECT_LT(ours, 0.4 * published) << records;  // 0.21 and 0.27 of it
    EXPECT_LT(ours, 1.5 * best) << records;       // 1.05 and 1.08 of it
    EXPECT_LT(second, 0.6 * best) << records;     // 0.24 and 0.35 of it
  }
}

TEST(PlaneField, SecondOrderRecordsHaveTheErrorOfTheirOwnExtrapolation) {
  const RecordField& field = fineField();
  EXPECT_THAT(field.metrics, testing::Contains("second-order"));
  const double threshold = 1e-3;
  const RecordMaker make = field.records(choiceOf("second-order", threshold));
  double first_order_ratios = 0.0;
  double ratios = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < field.receivers.size(); i += 131) {
    CacheRecord record = make(i);
    if (field.reference[i] < 0.05 || record.half_axes(0) < 6.0 * field.pixel_sizes[i]) continue;
    const double allowed = threshold * field.reference[i];
    ratios += field.true_error(i, record) / allowed;
    // Bad twin: without the Hessian.
    record.hessian.setZero();
    first_order_ratios += field.true_error(i, record) / allowed;
    ++count;
  }
  ASSERT_GT(count, 50u);
  // The region keeps the error of the Taylor series, and the nearest quadratic's is less.
  EXPECT_LT(ratios / static_cast<double>(count), 1.0);
  EXPECT_GT(first_order_ratios / static_cast<double>(count), 1.5);
  EXPECT_THAT(fieldOf(16, 64).metrics, testing::Contains("second-order"));
}

TEST(PlaneField, NamesWhatIsWrong) {
  const auto messageOf = [](const FigureScene& scene, const PlaneFieldPlan& plan) -> std::string {
    try {
      planeField(scene, plan, nullptr);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "nothing thrown";
  };
  EXPECT_THAT(messageOf(figure5(), {1, 0, 1, 1}), HasSubstr("1 x 1 receivers"));
  EXPECT_THAT(messageOf(figure5(), {8, 3, 1, 1}), HasSubstr("3 rays"));
  FigureScene dark = figure5();
  for (Polygon& polygon : dark.scene.polygons) polygon.radiance = 0.0;
  EXPECT_THAT(messageOf(dark, {8, 0, 1, 1}), HasSubstr("no receiver of the grid has any light"));
}

}  // namespace
}  // namespace irradiff
