#include "experiments/cache/image_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using testing::DoubleEq;
using testing::HasSubstr;

TEST(ImageError, IsRelativeToTheMeanOfTheReference) {
  const ImageError error = imageError(std::vector{1.0, 5.0, 3.0, 2.0}, std::vector{1.0, 2.0, 3.0, 6.0});
  EXPECT_THAT(error.rms, DoubleEq(std::sqrt((9.0 + 16.0) / 4.0) / 3.0));
  EXPECT_THAT(error.maximum, DoubleEq(4.0 / 3.0));
  EXPECT_THAT(error.percentile_99, DoubleEq(4.0 / 3.0));
}

// Of 1000 receivers 990 are at most at the percentile: 10 outliers do not show in it, 11 do.
TEST(ImageError, HasAPercentileThatTenInAThousandAreBeyond) {
  const std::vector<double> reference(1000, 1.0);
  std::vector<double> irradiance(1000, 1.25);
  for (std::size_t i = 0; i < 10; ++i) irradiance[97 * i] = -8.0;
  EXPECT_EQ(imageError(irradiance, reference).percentile_99, 0.25);
  EXPECT_EQ(imageError(irradiance, reference).maximum, 9.0);
  irradiance[1] = -8.0;
  EXPECT_EQ(imageError(irradiance, reference).percentile_99, 9.0);
}

TEST(ImageError, OfTheReferenceIsZero) {
  const std::vector<double> reference{0.0, 2.0};
  const ImageError error = imageError(reference, reference);
  EXPECT_EQ(error.rms, 0.0);
  EXPECT_EQ(error.percentile_99, 0.0);
  EXPECT_EQ(error.maximum, 0.0);
}

// The bad twin squares errors in W/m^2, which is 0 or infinite here.
TEST(ImageError, DoesNotDependOnTheUnitOfIrradiance) {
  for (const double unit : {0x1p-1000, 0x1p-600, 0x1p600, 0x1p1000}) {
    const ImageError error = imageError(std::vector{unit, 5.0 * unit}, std::vector{unit, 2.0 * unit});
    EXPECT_THAT(error.rms, DoubleEq(std::sqrt(4.5) / 1.5)) << unit;
    EXPECT_EQ(error.maximum, 2.0) << unit;
  }
}

std::string refusal(const std::vector<double>& irradiance, const std::vector<double>& reference) {
  try {
    imageError(irradiance, reference);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing refused";
}

TEST(ImageError, RefusesWhatHasNoError) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal({1.0}, {1.0, 2.0}), HasSubstr("1 values of irradiance and 2 of its reference"));
  EXPECT_THAT(refusal({}, {}), HasSubstr("at least one"));
  EXPECT_EQ(refusal({1.0, kNaN}, {1.0, 2.0}), "receiver 1: irradiance nan with the reference 2, both must be finite");
  EXPECT_EQ(refusal({1.0, 0.0}, {0.0, 0.0}), "the mean of the reference is 0, must be positive");
}

}  // namespace
}  // namespace irradiff
