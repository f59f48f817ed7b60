#include "experiments/io/png_file.h"

#include <png.h>
#include <stdexcept>

namespace irradiff {

static_assert(sizeof(Rgb) == 3, "libpng reads the pixels as bytes in a row");

std::string pngFile(const RgbImage& image) {
  if (image.pixels.empty() || image.pixels.size() != image.width * image.height) {
    throw std::invalid_argument("an image of " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                                " with " + std::to_string(image.pixels.size()) +
                                " pixels cannot be written as PNG: it must have width x height pixels, at least 1");
  }
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  // Asked for the size first, libpng encodes twice; no file is larger than this.
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(header), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr) == 0) {
    throw std::runtime_error(std::string("cannot make a PNG file: ") + header.message);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace irradiff
