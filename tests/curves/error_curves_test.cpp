// Bookkeeping of error curves: counts, bands, slopes, and that nothing depends on threads or on what was finished.

#include "experiments/curves/error_curves.h"

#include "tests/cli/program_run.h"
#include "tests/curves/study_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using curves_test::powerCurves;
using curves_test::studyField;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<std::size_t> kCounts{50, 100, 200};

ErrorCurves measured(unsigned threads, const TileStore* finished = nullptr) {
  const std::vector<RecordField> fields{studyField(40)};
  return errorCurves(fields, fields[0].metrics, kCounts, {}, threads, finished);
}

bool areSame(const ErrorCurves& a, const ErrorCurves& b) {
  if (a.points.size() != b.points.size()) return false;
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const CurvePoint& p = a.points[i];
    const CurvePoint& q = b.points[i];
    const bool is_same = p.metric == q.metric && p.asked_records == q.asked_records && p.records == q.records &&
                         p.rays == q.rays && p.threshold == q.threshold && p.is_within == q.is_within &&
                         p.error.rms == q.error.rms && p.error.percentile_99 == q.error.percentile_99 &&
                         p.error.maximum == q.error.maximum;
    if (!is_same) return false;
  }
  return true;
}

TEST(ErrorCurves, HaveTheCountsThatAreAskedFor) {
  const ErrorCurves curves = measured(1);
  ASSERT_EQ(curves.points.size(), 9U);
  EXPECT_THAT(curves.metrics(), ElementsAre("bounded-split-sphere", "occlusion-hessian", "oracle"));
  for (const CurvePoint& point : curves.points) {
    EXPECT_TRUE(point.is_within) << point.metric << ' ' << point.asked_records;
    EXPECT_NEAR(static_cast<double>(point.records), static_cast<double>(point.asked_records),
                0.02 * static_cast<double>(point.asked_records));
    EXPECT_EQ(point.rays, 100 * point.records);
    EXPECT_GT(point.error.rms, 0.0);
    EXPECT_LE(point.error.rms, point.error.maximum);
  }
}

// A point is what a cache with its threshold has, found without the curves.
TEST(ErrorCurves, TellTheErrorsOfTheirPlacements) {
  const RecordField field = studyField(40);
  for (const CurvePoint& point : measured(2).points) {
    MetricChoice choice = defaultChoice(field, point.metric);
    choice.threshold = point.threshold;
    const Placement placement = place(field, field.records(choice), {});
    EXPECT_EQ(placement.records.size(), point.records);
    double sum = 0.0;
    double mean = 0.0;
    for (std::size_t i = 0; i < field.receivers.size(); ++i) {
      sum += std::pow(placement.irradiance[i] - field.reference[i], 2);
      mean += field.reference[i] / static_cast<double>(field.receivers.size());
    }
    const double rms = std::sqrt(sum / static_cast<double>(field.receivers.size())) / mean;
    // Two orders of summation of 1600 terms: at most 1600 u; observed 1e-15.
    EXPECT_NEAR(point.error.rms, rms, 2e-13 * rms);
  }
}

TEST(ErrorCurves, AreTheSameForAnyNumberOfThreads) { EXPECT_TRUE(areSame(measured(1), measured(3))); }

TEST(ErrorCurves, GoOnFromWhatIsFinished) {
  const ScratchFolder scratch;
  const TileStore finished(scratch.file("curves.part"), "plan");
  const ErrorCurves first = measured(1, &finished);
  EXPECT_TRUE(areSame(first, measured(2, &finished)));
  // They are taken from there: another number in their place is believed.
  std::vector<double> numbers = *finished.read(1, 3 * 7);
  numbers[4] = 0.25;
  finished.write(1, numbers);
  EXPECT_EQ(measured(1, &finished).points[3].error.rms, 0.25);
}

TEST(ErrorCurves, HaveTheSlopeOfAPowerLaw) {
  const ErrorCurves curves = powerCurves({{"a", 2.0, -0.75}, {"b", 0.1, -1.5}}, {100, 300, 1000, 8000}, 3, 0.1);
  // Rounding alone: logarithms of up to 9, 12 terms; observed 4e-16.
  EXPECT_NEAR(*curves.slope("a"), -0.75, 1e-13);
  EXPECT_NEAR(*curves.slope("b"), -1.5, 1e-13);
  EXPECT_FALSE(curves.slope("c"));
  EXPECT_FALSE(powerCurves({{"a", 2.0, -0.75}}, {100}, 3, 0.1).slope("a")) << "one count has no slope";
}

TEST(ErrorCurves, LeaveOutWhatWasNotReached) {
  ErrorCurves curves = powerCurves({{"a", 2.0, -0.75}}, {100, 300, 1000});
  curves.points[2].error.rms = 1e3;
  EXPECT_GT(*curves.slope("a"), 0.0);
  curves.points[2].is_within = false;
  EXPECT_NEAR(*curves.slope("a"), -0.75, 1e-13);
  EXPECT_EQ(curves.bands("a").size(), 2U);
  EXPECT_FALSE(curves.errorAt("a", 1000));
}

TEST(ErrorCurves, HaveBandsOverTheFields) {
  const ErrorCurves curves = powerCurves({{"a", 1.0, -1.0}}, {10, 100}, 3, 0.5);
  const std::vector<CurveBand> bands = curves.bands("a");
  ASSERT_EQ(bands.size(), 2U);
  EXPECT_EQ(bands[1].asked_records, 100U);
  EXPECT_DOUBLE_EQ(bands[1].lowest_rms, 0.01);
  EXPECT_DOUBLE_EQ(bands[1].rms, 0.015);
  EXPECT_DOUBLE_EQ(bands[1].highest_rms, 0.02);
  EXPECT_EQ(bands[1].rays, 10000.0);
  EXPECT_DOUBLE_EQ(curves.errorAt("a", 10)->maximum, 9.0 * 0.15);
}

TEST(ErrorCurves, AskForNoMoreThanAQuarterOfTheReceivers) {
  const RecordField field = studyField(20);
  EXPECT_THAT(possibleCounts(field, std::vector<std::size_t>{10, 100, 101, 8000}), ElementsAre(10U, 100U));
  EXPECT_THAT(possibleCounts(field, std::vector<std::size_t>{8000}), ElementsAre(100U));
}

TEST(DefaultChoice, HasTheLimitsOfThePaper) {
  RecordField field = studyField(20);
  field.width = 1800;
  const MetricChoice bounded = defaultChoice(field, "bounded-split-sphere");
  EXPECT_EQ(bounded.smallest_pixels, 1.0);
  EXPECT_EQ(bounded.largest_pixels, 150.0);
  EXPECT_TRUE(std::isinf(defaultChoice(field, "occlusion-hessian").largest_pixels));
  EXPECT_EQ(defaultChoice(field, "occlusion-hessian").ellipse.largest_aspect, 2.0);
}

TEST(DefaultChoice, NamesAnUnknownMetricAndThoseThatThereAre) {
  const RecordField field = studyField(8);
  try {
    defaultChoice(field, "nonsense");
    FAIL() << "it was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("\"nonsense\""), HasSubstr("bounded-split-sphere, occlusion-hessian")));
  }
}

}  // namespace
}  // namespace irradiff
