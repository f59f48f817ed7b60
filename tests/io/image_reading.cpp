#include "tests/io/image_reading.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <cstdint>
#include <cstring>
#include <png.h>
#include <stdexcept>
#include <utility>

namespace irradiff {
namespace {

class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(std::string bytes) : Imf::IStream("memory"), bytes_(std::move(bytes)) {}

  // OpenEXR's own signature.
  bool read(char c[], int n) override {  // NOLINT(modernize-avoid-c-arrays)
    const auto count = static_cast<std::size_t>(n);
    if (position_ + count > bytes_.size()) {
      throw std::runtime_error("an OpenEXR file ends too early");
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

}  // namespace

ReadExr readExr(const std::string& bytes) {
  MemoryInput stream(bytes);
  Imf::InputFile file(stream, 0);
  const Imf::Header& header = file.header();
  if (header.lineOrder() != Imf::INCREASING_Y) {
    throw std::runtime_error("the lines do not run downwards");
  }
  ReadExr result;
  result.width = static_cast<std::size_t>(header.dataWindow().max.x) + 1;
  result.height = static_cast<std::size_t>(header.dataWindow().max.y) + 1;
  Imf::FrameBuffer pixels;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    if (channel.channel().type != Imf::FLOAT) {
      throw std::runtime_error(std::string(channel.name()) + " is not 32-bit float");
    }
    std::vector<float>& values = result.channels[channel.name()];
    values.assign(result.width * result.height, -1.0F);
    pixels.insert(channel.name(), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float),
                                             sizeof(float) * result.width));
  }
  file.setFrameBuffer(pixels);
  file.readPixels(0, static_cast<int>(result.height) - 1);
  for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute())) {
      result.texts[attribute.name()] = text->value();
    }
  }
  return result;
}

RgbImage readPng(const std::string& bytes) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0) {
    throw std::runtime_error(header.message);
  }
  if (header.format != static_cast<png_uint_32>(PNG_FORMAT_RGB)) {
    throw std::runtime_error("the pixels are not 8-bit RGB");
  }
  RgbImage image(header.width, header.height, {});
  if (png_image_finish_read(&header, nullptr, image.pixels.data(), 0, nullptr) == 0) {
    throw std::runtime_error(header.message);
  }
  return image;
}

std::string bytesOfBase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  unsigned count = 0;
  for (const char c : text.substr(0, text.find('='))) {
    const std::size_t digit = digits.find(c);
    if (digit == std::string::npos) {
      throw std::runtime_error("no base64");
    }
    bits = (bits << 6U) | static_cast<unsigned>(digit);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes += static_cast<char>((bits >> count) & 255U);
    }
  }
  return bytes;
}

}  // namespace irradiff
