#include "experiments/io/exr_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <stdexcept>

namespace irradiff {
namespace {

/// Bytes in memory, which must outlive it.
class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(const std::string& bytes) : Imf::IStream("an OpenEXR file in memory"), bytes_(&bytes) {}

  // OpenEXR's own signature.
  bool read(char c[], int n) override {  // NOLINT(modernize-avoid-c-arrays)
    const auto count = static_cast<std::size_t>(n);
    if (position_ > bytes_->size() || count > bytes_->size() - position_) {
      throw std::runtime_error("an OpenEXR file ends too early");
    }
    std::copy_n(bytes_->data() + position_, count, c);
    position_ += count;
    return position_ < bytes_->size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  const std::string* bytes_;
  std::size_t position_ = 0;
};

}  // namespace

ExrImage parseExr(const std::string& bytes) {
  MemoryInput stream(bytes);
  Imf::InputFile file(stream, 0);
  const Imf::Header& header = file.header();
  const Imath::Box2i window = header.dataWindow();
  ExrImage image;
  image.width = static_cast<std::size_t>(window.max.x - window.min.x) + 1;
  image.height = static_cast<std::size_t>(window.max.y - window.min.y) + 1;
  std::map<std::string, std::vector<float>> floats;
  Imf::FrameBuffer pixels;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    if (channel.channel().type != Imf::FLOAT) {
      throw std::runtime_error("channel \"" + std::string(channel.name()) + "\" of an OpenEXR file is not of floats");
    }
    std::vector<float>& values = floats[channel.name()];
    values.resize(image.width * image.height);
    pixels.insert(channel.name(),
                  Imf::Slice::Make(Imf::FLOAT, values.data(), window, sizeof(float), sizeof(float) * image.width));
  }
  file.setFrameBuffer(pixels);
  file.readPixels(window.min.y, window.max.y);
  for (const auto& [name, values] : floats) image.channels.push_back({name, {values.begin(), values.end()}});
  for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute())) {
      image.attributes.push_back({attribute.name(), text->value()});
    }
  }
  return image;
}

}  // namespace irradiff
