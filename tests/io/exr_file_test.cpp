// Files are read back by OpenEXR itself and compared bit for bit.

#include "experiments/io/exr_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace irradiff {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(std::string bytes) : Imf::IStream("memory"), bytes_(std::move(bytes)) {}
  bool read(char c[], int n) override {  // NOLINT(modernize-avoid-c-arrays)
    const auto count = static_cast<std::size_t>(n);
    if (position_ + count > bytes_.size()) {
      throw std::runtime_error("read beyond the end");
    }
    std::memcpy(c, bytes_.data() + position_, count);
    position_ += count;
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  std::string bytes_;
  std::size_t position_ = 0;
};

std::vector<float> readChannel(Imf::InputFile& file, const std::string& name, std::size_t width, std::size_t height) {
  std::vector<float> values(width * height, -1.0F);
  Imf::FrameBuffer pixels;
  pixels.insert(name,
                Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float), sizeof(float) * width));
  file.setFrameBuffer(pixels);
  file.readPixels(0, static_cast<int>(height) - 1);
  return values;
}

std::vector<std::uint32_t> bitsOf(const std::vector<float>& values) {
  std::vector<std::uint32_t> bits;
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
  MemoryInput stream(exrFile(image));
  Imf::InputFile file(stream, 0);
  const Imf::Header& header = file.header();
  EXPECT_EQ(header.dataWindow().max.x, 2);
  EXPECT_EQ(header.dataWindow().max.y, 1);
  std::size_t count = 0;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    EXPECT_EQ(channel.channel().type, Imf::FLOAT) << channel.name();
    ++count;
  }
  EXPECT_EQ(count, image.channels.size());
  for (const ExrImage::Channel& channel : image.channels) {
    const std::vector<float> expected(channel.values.begin(), channel.values.end());
    EXPECT_EQ(bitsOf(readChannel(file, channel.name, 3, 2)), bitsOf(expected)) << channel.name;
  }
  EXPECT_EQ(header.typedAttribute<Imf::StringAttribute>("configuration").value(), image.attributes[0].text);
}

// The first value is that of the upper left pixel: OpenEXR's lines run downwards.
TEST(ExrFile, BeginsAtTheTop) {
  MemoryInput stream(exrFile(smallImage()));
  Imf::InputFile file(stream, 0);
  EXPECT_EQ(file.header().lineOrder(), Imf::INCREASING_Y);
  EXPECT_EQ(readChannel(file, "gradient.x", 3, 2)[0], -1.0F);
}

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
