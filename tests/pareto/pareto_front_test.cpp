#include "experiments/pareto/pareto_front.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace irradiff {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ParetoFront, HasWhatNothingBeats) {
  const std::vector<TimeAndError> points{{1.0, 1e-3}, {2.0, 1e-6}, {1.5, 1e-2}, {4.0, 1e-9},
                                         {3.0, 1e-6}, {0.5, 1.0},  {5.0, 1e-8}};
  EXPECT_THAT(paretoFront(points), ElementsAre(true, true, false, true, false, true, false));
}

TEST(ParetoFront, HasBothOfTwoEqualPoints) {
  const std::vector<TimeAndError> points{{1.0, 1e-3}, {1.0, 1e-3}, {1.0, 1e-2}, {2.0, 1e-3}};
  EXPECT_THAT(paretoFront(points), ElementsAre(true, true, false, false));
}

TEST(ParetoFront, LeavesOutWhatHasNoValue) {
  const std::vector<TimeAndError> points{
      {0.1, std::numeric_limits<double>::infinity()}, {0.1, std::nan("")}, {1.0, 1e-3}};
  EXPECT_THAT(paretoFront(points), ElementsAre(false, false, true));
  EXPECT_THAT(paretoFront({}), IsEmpty());
}

}  // namespace
}  // namespace irradiff
