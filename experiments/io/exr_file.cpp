#include "experiments/io/exr_file.h"

#include "derivatives/scene/number_text.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>

namespace irradiff {
namespace {

/// A file in memory, which OpenEXR goes back in to fill the table of its lines.
class MemoryFile : public Imf::OStream {
 public:
  MemoryFile() : Imf::OStream("an OpenEXR file in memory") {}

  // OpenEXR's own signature.
  void write(const char c[], int n) override {  // NOLINT(modernize-avoid-c-arrays)
    const auto count = static_cast<std::size_t>(n);
    if (position_ + count > bytes_.size()) {
      bytes_.resize(position_ + count);
    }
    bytes_.replace(position_, count, c, count);
    position_ += count;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::size_t position_ = 0;
};

std::vector<float> floatsOf(const ExrImage::Channel& channel) {
  std::vector<float> floats;
  floats.reserve(channel.values.size());
  for (const double value : channel.values) {
    if (!std::isnan(value) && std::abs(value) > std::numeric_limits<float>::max()) {
      throw std::invalid_argument("channel \"" + channel.name + "\" has the value " + numberText(value) +
                                  ", must be within the range of 32-bit floats");
    }
    floats.push_back(static_cast<float>(value));
  }
  return floats;
}

void validate(const ExrImage& image) {
  const std::size_t pixels = image.width * image.height;
  if (pixels == 0 || image.channels.empty()) {
    throw std::invalid_argument("an image of " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                                " pixels and " + std::to_string(image.channels.size()) +
                                " channels cannot be written as OpenEXR: it must have at least 1 of each");
  }
  std::set<std::string> names;
  for (const ExrImage::Channel& channel : image.channels) {
    if (channel.name.empty() || !names.insert(channel.name).second) {
      throw std::invalid_argument("a channel's name is \"" + channel.name +
                                  "\", must not be empty and not that of another");
    }
    if (channel.values.size() != pixels) {
      throw std::invalid_argument("channel \"" + channel.name + "\" has " + std::to_string(channel.values.size()) +
                                  " values, must have " + std::to_string(pixels) + ", one for each pixel");
    }
  }
}

}  // namespace

std::string exrFile(const ExrImage& image) {
  validate(image);
  Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const ExrImage::Attribute& attribute : image.attributes) {
    header.insert(attribute.name, Imf::StringAttribute(attribute.text));
  }
  std::vector<std::vector<float>> floats;
  Imf::FrameBuffer pixels;
  for (const ExrImage::Channel& channel : image.channels) {
    header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
    floats.push_back(floatsOf(channel));
    pixels.insert(channel.name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(floats.back().data()), sizeof(float),
                                           sizeof(float) * image.width));
  }
  MemoryFile file;
  {
    // What is not written by the end of its life is lost.
    Imf::OutputFile output(file, header, 0);
    output.setFrameBuffer(pixels);
    output.writePixels(static_cast<int>(image.height));
  }
  return file.bytes();
}

}  // namespace irradiff
