#include "experiments/cache/field_pictures.h"
#include "experiments/cache/footprint_picture.h"
#include "experiments/cache/irradiance_cache.h"
#include "experiments/figures/colour_maps.h"
#include "tests/cache/synthetic_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using cache_test::bumpyField;
using cache_test::capField;
using testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

CacheRecord recordAt(double x, double y, double first_half_axis, double second_half_axis) {
  CacheRecord record;
  record.receiver = {{x, y, 0.0}, Eigen::Vector3d::UnitZ()};
  record.gradient.setZero();
  record.rotational_gradient.setZero();
  record.first_axis = {0.8, 0.6, 0.0};
  record.second_axis = {-0.6, 0.8, 0.0};
  record.half_axes = {first_half_axis, second_half_axis};
  return record;
}

bool isGrey(Rgb colour) { return colour.red == colour.green && colour.green == colour.blue && colour != Rgb{0, 0, 0}; }

bool isBlack(Rgb colour) { return colour == Rgb{0, 0, 0}; }

TEST(FootprintPicture, HasEachRecordAtItsShare) {
  const RecordField field = bumpyField(64);
  const std::vector<CacheRecord> records{recordAt(0.3, 0.4, 0.5, 0.5), recordAt(0.75, 0.6, 0.2, 0.4)};
  const MapPicture picture = footprintPicture(field, records, {.enlargement = 3});
  ASSERT_EQ(picture.image.width, 192U);
  ASSERT_EQ(picture.image.height, 192U);
  for (std::size_t row = 0; row < 192; ++row) {
    for (std::size_t column = 0; column < 192; ++column) {
      const Eigen::Vector3d place(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5, 0.0);
      const bool is_inside = std::ranges::any_of(records, [&](const CacheRecord& record) {
        return translationalDistance(record, place / 192.0) < kFootprintShare;
      });
      ASSERT_EQ(!isGrey(picture.image.at(column, row)), is_inside) << column << ' ' << row;
    }
  }
  // The circle green, the ellipse of the largest aspect blue.
  const Rgb circle = picture.image.at(58, 77);
  const Rgb ellipse = picture.image.at(144, 115);
  EXPECT_GT(circle.green, circle.blue + 50);
  EXPECT_GT(ellipse.blue, ellipse.green + 50);
  // A closed line one pixel wide: 8 r of a circle's in steps along rows or columns, less at the diagonals.
  const auto outline = static_cast<double>(std::ranges::count_if(picture.image.pixels, isBlack));
  const double radius = kFootprintShare * 0.5 * 192.0;
  EXPECT_GT(outline, 4.0 * std::numbers::sqrt2 * radius);
  EXPECT_LT(outline, 16.0 * radius);
}

TEST(FootprintPicture, HasSymmetricOutlines) {
  const CacheRecord record = recordAt(0.5, 0.5, 0.5, 0.5);
  const RgbImage image = footprintPicture(bumpyField(64), {&record, 1}).image;
  EXPECT_GT(std::ranges::count_if(image.pixels, isBlack), 60);
  for (std::size_t row = 0; row < 64; ++row) {
    for (std::size_t column = 0; column < 64; ++column) {
      EXPECT_EQ(isBlack(image.at(column, row)), isBlack(image.at(63 - column, row)));
      EXPECT_EQ(isBlack(image.at(column, row)), isBlack(image.at(row, column)));
    }
  }
}

TEST(FootprintPicture, HasTheNewestOnTop) {
  const std::vector<CacheRecord> records{recordAt(0.5, 0.5, 0.5, 0.5), recordAt(0.5, 0.5, 0.2, 0.4)};
  const Rgb middle = footprintPicture(bumpyField(64), records).image.at(32, 32);
  EXPECT_GT(middle.blue, middle.green + 50);
}

TEST(FootprintPicture, ShowsOneSideOfASurface) {
  const RecordField field = bumpyField(32);
  CacheRecord record = recordAt(0.5, 0.5, 0.5, 0.5);
  const auto coloured = [&] {
    return std::ranges::count_if(footprintPicture(field, {&record, 1}).image.pixels, [](Rgb c) { return !isGrey(c); });
  };
  EXPECT_GT(coloured(), 100);
  record.receiver.normal *= -1.0;
  EXPECT_EQ(coloured(), 0);
}

TEST(FootprintPicture, LeavesPixelsWithoutAReceiver) {
  const RecordField field = capField(32, {});
  const MapPicture picture = footprintPicture(field, {}, {});
  EXPECT_EQ(picture.image.at(0, 0), kNoValueColour);
  EXPECT_NE(picture.image.at(16, 16), kNoValueColour);
}

TEST(FieldPictures, HaveTheColoursOfTheirScales) {
  const RecordField field = bumpyField(16);
  std::vector<double> irradiance = field.reference;
  irradiance[5] = kNaN;
  irradiance[6] += 0.1;
  const RgbImage image = irradiancePicture(field, irradiance, 4.0).image;
  EXPECT_EQ(image.pixels[3], sequentialColour(field.reference[3] / 4.0));
  EXPECT_EQ(image.pixels[5], kNoValueColour);

  double mean = 0.0;
  for (const double value : field.reference) mean += value / 256.0;
  const RgbImage error = errorPicture(field, irradiance, 0.2 / mean).image;
  EXPECT_EQ(error.pixels[3], divergingColour(0.0));
  EXPECT_EQ(error.pixels[5], kNoValueColour);
  EXPECT_EQ(error.pixels[6], divergingColour(0.5));

  MetricChoice choice;
  choice.metric = "circle";
  choice.threshold = 0.1;
  const RgbImage radius = radiusPicture(field, field.records(choice), 0.01, 10.0).image;
  EXPECT_EQ(radius.pixels[0], sequentialColour(1.0 / 3.0));
}

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing refused";
}

TEST(Pictures, RefuseScalesAndSizes) {
  const RecordField field = bumpyField(16);
  MetricChoice choice;
  choice.metric = "circle";
  choice.threshold = 0.1;
  EXPECT_THAT(refusal([&] { irradiancePicture(field, field.reference, 0.0); }), HasSubstr("from 0 to 0, must rise"));
  EXPECT_THAT(refusal([&] { errorPicture(field, field.reference, kNaN); }), HasSubstr("from 0 to nan"));
  EXPECT_THAT(refusal([&] { irradiancePicture(field, std::vector<double>(3), 1.0); }),
              HasSubstr("with 3 values, must be one for each of its 256 receivers"));
  EXPECT_THAT(refusal([&] { radiusPicture(field, field.records(choice), 0.0, 1.0); }),
              HasSubstr("from 0 m, must be positive"));
  EXPECT_THAT(refusal([&] { footprintPicture(field, {}, {.largest_aspect = 1.0}); }),
              HasSubstr("aspect of footprints is 1, must be finite and above 1"));
  EXPECT_THAT(refusal([&] { footprintPicture(field, {}, {.enlargement = 0}); }), HasSubstr("is 0, must be 1 to 16"));
}

}  // namespace
}  // namespace irradiff
