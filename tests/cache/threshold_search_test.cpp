#include "experiments/cache/threshold_search.h"

#include "experiments/cache/image_error.h"
#include "tests/cache/synthetic_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

using cache_test::bumpyField;
using cache_test::refusal;
using testing::HasSubstr;

MetricChoice choiceOf(const std::string& metric, double threshold) {
  MetricChoice choice;
  choice.metric = metric;
  choice.threshold = threshold;
  choice.smallest_pixels = 1e-6;
  return choice;
}

TEST(TuneThreshold, ReachesEveryNumberOfRecords) {
  const RecordField field = bumpyField(64);
  for (const char* metric : {"hessian", "steep", "flat", "bright"}) {
    std::size_t most_steps = 0;
    for (const std::size_t records : {50, 200, 1000, 3000}) {
      for (const double first : {1e-20, 1.0, 1e20}) {
        const TunedPlacement tuned = tuneThreshold(field, choiceOf(metric, first), {}, records);
        const auto found = static_cast<double>(tuned.placement.records.size());
        EXPECT_TRUE(tuned.is_within) << metric << ' ' << records << ' ' << first << ": " << found;
        EXPECT_NEAR(found, static_cast<double>(records), 0.02 * static_cast<double>(records));
        EXPECT_LE(tuned.steps, kMostSearchSteps);
        EXPECT_EQ(place(field, field.records(tuned.choice), {}).records.size(), tuned.placement.records.size());
        most_steps = std::max(most_steps, tuned.steps);
      }
    }
    std::cout << metric << ": at most " << most_steps << " placements\n";
  }
}

// The next number of a curve, from the threshold of the one before.
TEST(TuneThreshold, NeedsFewPlacementsFromANearThreshold) {
  const RecordField field = bumpyField(128);
  double threshold = 1e-4;
  std::size_t steps = 0;
  const std::vector<std::size_t> numbers{100, 300, 1000, 3000, 8000};
  for (const std::size_t records : numbers) {
    const TunedPlacement tuned = tuneThreshold(field, choiceOf("hessian", threshold), {}, records);
    EXPECT_TRUE(tuned.is_within);
    threshold = tuned.choice.threshold;
    steps += tuned.steps;
  }
  std::cout << steps << " placements for " << numbers.size() << " points of a curve\n";
  EXPECT_LE(steps, 8 * numbers.size());
}

TEST(TuneThreshold, HasTheClosestOfNumbersThatItCannotReach) {
  const RecordField field = bumpyField(32);
  // More than there are receivers.
  TunedPlacement tuned = tuneThreshold(field, choiceOf("hessian", 1.0), {}, 2000);
  EXPECT_FALSE(tuned.is_within);
  EXPECT_EQ(tuned.placement.records.size(), field.receivers.size());

  // Smaller thresholds would change nothing, but that radii get too small for double.
  RecordField fragile = field;
  fragile.records = [makers = field.records](const MetricChoice& choice) {
    if (choice.threshold < 1e-60) throw std::range_error("a radius is too small");
    return makers(choice);
  };
  EXPECT_NO_THROW(tuneThreshold(fragile, choiceOf("hessian", 1.0), {}, 2000));

  // Regions of at most 3 pixels, and of at least 3.
  MetricChoice choice = choiceOf("hessian", 1e-9);
  choice.largest_pixels = 3.0;
  tuned = tuneThreshold(field, choice, {}, 20);
  const std::size_t fewest = tuned.placement.records.size();
  EXPECT_FALSE(tuned.is_within);
  EXPECT_GT(fewest, 80U);
  choice.smallest_pixels = 3.0;
  EXPECT_EQ(place(field, field.records(choice), {}).records.size(), fewest);
  choice.largest_pixels = std::numeric_limits<double>::infinity();
  tuned = tuneThreshold(field, choice, {}, 600);
  EXPECT_FALSE(tuned.is_within);
  EXPECT_EQ(tuned.placement.records.size(), fewest);
  EXPECT_LE(tuned.steps, kMostSearchSteps);
}

// Circles of one size on a square lattice: another ring of neighbours is within them, or not.
TEST(TuneThreshold, SaysWhereALatticeLeavesNoNumberNear) {
  const RecordField field = bumpyField(96);
  const TunedPlacement tuned = tuneThreshold(field, choiceOf("circle", 1.0), {}, 3000);
  EXPECT_FALSE(tuned.is_within);
  EXPECT_LE(tuned.steps, kMostSearchSteps);
  // Every other receiver of every other row.
  EXPECT_EQ(tuned.placement.records.size(), 96U * 96U / 4U);
}

// A metric that knows two sizes jumps over every number in between.
TEST(TuneThreshold, EndsWhereTheNumberJumps) {
  RecordField field = bumpyField(32);
  const auto makers = field.records;
  field.records = [makers](MetricChoice choice) {
    choice.metric = "circle";
    choice.threshold = choice.threshold < 0.37 ? 0.05 : 0.2;
    return makers(choice);
  };
  const std::size_t many = place(field, field.records(choiceOf("circle", 0.1)), {}).records.size();
  const std::size_t few = place(field, field.records(choiceOf("circle", 0.9)), {}).records.size();
  const TunedPlacement tuned = tuneThreshold(field, choiceOf("circle", 1.0), {}, few + (many - few) / 4);
  EXPECT_FALSE(tuned.is_within);
  EXPECT_EQ(tuned.placement.records.size(), few);
  EXPECT_LE(tuned.steps, kMostSearchSteps);
  EXPECT_EQ(tuneThreshold(field, choiceOf("circle", 1.0), {}, many - (many - few) / 4).placement.records.size(), many);
}

// Choosing a region may take long: each is chosen once at each threshold, that of the result too.
TEST(TuneThreshold, MakesEachRecordOnceForEachThreshold) {
  RecordField field = bumpyField(32);
  std::map<std::pair<double, std::size_t>, int> times;
  const auto makers = field.records;
  field.records = [makers, &times](const MetricChoice& choice) {
    return [maker = makers(choice), &times, threshold = choice.threshold](std::size_t receiver) {
      ++times[{threshold, receiver}];
      return maker(receiver);
    };
  };
  EXPECT_TRUE(tuneThreshold(field, choiceOf("hessian", 1e-3), {}, 200).is_within);
  EXPECT_GT(times.size(), 300U);
  for (const auto& [place, count] : times) EXPECT_EQ(count, 1);
}

// Radii of a metric that takes a distance are the threshold times it, and clamped as such.
TEST(TuneThreshold, ClampsWithTheSlopeOfTheMetric) {
  RecordField field = bumpyField(32);
  const auto makers = field.records;
  field.records = [makers](MetricChoice choice) {
    choice.metric = "bright";
    return makers(choice);
  };
  PlacementOptions options;
  options.clamps_neighbours = true;
  for (const char* metric : {"split-sphere", "other"}) {
    const TunedPlacement tuned = tuneThreshold(field, choiceOf(metric, 0.1), options, 200);
    PlacementOptions same = options;
    same.clamping_slope = clampingSlope(tuned.choice);
    EXPECT_TRUE(tuned.is_within);
    EXPECT_EQ(tuned.placement.irradiance, place(field, field.records(tuned.choice), same).irradiance);
    same.clamping_slope = metric == std::string("other") ? tuned.choice.threshold : 1.0;
    EXPECT_NE(tuned.placement.irradiance, place(field, field.records(tuned.choice), same).irradiance);
  }
}

// What first order leaves out grows with the area of a record, and so falls with their number.
TEST(TuneThreshold, GivesErrorsThatFallWithTheNumberOfRecords) {
  const RecordField field = bumpyField(256);
  const std::vector<std::size_t> numbers{150, 500, 1700, 5000};
  std::vector<double> logs;
  std::vector<double> errors;
  double threshold = 1e-4;
  for (const std::size_t records : numbers) {
    const TunedPlacement tuned = tuneThreshold(field, choiceOf("hessian", threshold), {}, records);
    threshold = tuned.choice.threshold;
    logs.push_back(std::log(static_cast<double>(tuned.placement.records.size())));
    errors.push_back(std::log(imageError(tuned.placement.irradiance, field.reference).rms));
    std::cout << tuned.placement.records.size() << " records: RMSE " << std::exp(errors.back()) << '\n';
  }
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    const double slope = (errors[i] - errors[i - 1]) / (logs[i] - logs[i - 1]);
    std::cout << "slope " << slope << '\n';
    EXPECT_NEAR(slope, -1.0, 0.15);
  }
}

// At equal numbers of records. In rows a record has its neighbours on one side when it is made, and without an overture
// all that it gives to the other side is extrapolated.
TEST(TuneThreshold, TellsWhatOrderAndOvertureAreWorth) {
  const RecordField field = bumpyField(128);
  const auto error = [&](PlacementOrder order, bool has_overture, std::size_t records) {
    PlacementOptions options;
    options.order = order;
    options.has_overture = has_overture;
    const TunedPlacement tuned = tuneThreshold(field, choiceOf("hessian", 1e-4), options, records);
    EXPECT_TRUE(tuned.is_within);
    return imageError(tuned.placement.irradiance, field.reference).rms;
  };
  for (const std::size_t records : {100, 300, 1000}) {
    const double refining = error(PlacementOrder::kRefining, true, records);
    const double refining_alone = error(PlacementOrder::kRefining, false, records) / refining;
    const double rows = error(PlacementOrder::kRows, true, records) / refining;
    const double rows_alone = error(PlacementOrder::kRows, false, records) / refining;
    std::cout << records << " records: RMSE over that of refining with overture: refining without " << refining_alone
              << ", rows with " << rows << ", rows without " << rows_alone << '\n';
    EXPECT_GE(refining_alone, 1.0);
    EXPECT_GT(rows, 1.0);
    EXPECT_GT(rows_alone, 1.3 * rows);
  }
}

TEST(TuneThreshold, RefusesWhatItCannotSearch) {
  const RecordField field = bumpyField(16);
  const auto refused = [&](double threshold, std::size_t records, double tolerance) {
    return refusal([&] { tuneThreshold(field, choiceOf("circle", threshold), {}, records, tolerance); });
  };
  EXPECT_EQ(refused(0.0, 10, 0.02),
            "search for the threshold of circle: the first threshold is 0, must be positive and finite");
  EXPECT_THAT(refused(std::numeric_limits<double>::infinity(), 10, 0.02), HasSubstr("is inf"));
  EXPECT_THAT(refused(1.0, 0, 0.02), HasSubstr("the number of records is 0, must be positive"));
  EXPECT_THAT(refused(1.0, 10, -0.1), HasSubstr("the tolerance is -0.1"));
}

}  // namespace
}  // namespace irradiff
