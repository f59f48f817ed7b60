// Files are read back by OpenEXR itself and compared bit for bit.

#include "experiments/io/exr_file.h"

#include "tests/io/image_reading.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace irradiff {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<std::uint32_t> bitsOf(const std::vector<float>& values) {
  std::vector<std::uint32_t> bits;
  bits.reserve(values.size());
  for (const float value : values) {
    bits.push_back(std::bit_cast<std::uint32_t>(value));
  }
  return bits;
}

/// 3 x 2, with every kind of number that a map may hold.
ExrImage smallImage() {
  ExrImage image;
  image.width = 3;
  image.height = 2;
  image.channels = {{"E", {0.0, -0.0, 1.0 / 3.0, 1e30, kNan, 1e-40}}, {"gradient.x", {-1, -2, -3, -4, -5, -6}}};
  image.attributes = {{"configuration", R"({"resolution": [3, 2]})"}};
  return image;
}

TEST(ExrFile, ReadsBackToTheSameBits) {
  const ExrImage image = smallImage();
  const ReadExr read = readExr(exrFile(image));
  EXPECT_EQ(read.width, 3U);
  EXPECT_EQ(read.height, 2U);
  EXPECT_EQ(read.channels.size(), image.channels.size());
  for (const ExrImage::Channel& channel : image.channels) {
    const std::vector<float> expected(channel.values.begin(), channel.values.end());
    EXPECT_EQ(bitsOf(read.channels.at(channel.name)), bitsOf(expected)) << channel.name;
  }
  EXPECT_EQ(read.texts.at("configuration"), image.attributes[0].text);
}

// The first value is that of the upper left pixel: lines run downwards.
TEST(ExrFile, BeginsAtTheTop) { EXPECT_EQ(readExr(exrFile(smallImage())).channels.at("gradient.x")[0], -1.0F); }

TEST(ExrFile, IsTheSameEachTime) { EXPECT_EQ(exrFile(smallImage()), exrFile(smallImage())); }

TEST(ExrFile, NamesWhatItCannotHold) {
  const auto message = [](const auto& change) {
    ExrImage image = smallImage();
    change(image);
    try {
      exrFile(image);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("nothing was refused");
  };
  EXPECT_THAT(message([](ExrImage& image) { image.channels[1].values[2] = 1e39; }),
              AllOf(HasSubstr("gradient.x"), HasSubstr("1e+39"), HasSubstr("range of 32-bit floats")));
  EXPECT_THAT(message([](ExrImage& image) { image.channels[0].values[2] = -HUGE_VAL; }), HasSubstr("-inf"));
  EXPECT_THAT(message([](ExrImage& image) { image.channels[0].values.pop_back(); }),
              AllOf(HasSubstr("\"E\""), HasSubstr("has 5 values"), HasSubstr("must have 6")));
  EXPECT_THAT(message([](ExrImage& image) { image.channels[1].name = "E"; }), HasSubstr("\"E\""));
  EXPECT_THAT(message([](ExrImage& image) { image.channels[1].name = ""; }), HasSubstr("\"\""));
  EXPECT_THAT(message([](ExrImage& image) { image.channels.clear(); }), HasSubstr("0 channels"));
  EXPECT_THAT(message([](ExrImage& image) { image.width = 0; }), HasSubstr("0 x 2"));
}

}  // namespace
}  // namespace irradiff
