#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace irradiff {

/// sRGB, 8 bits each.
struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// Row-major, the topmost row first.
struct RgbImage {
  RgbImage() = default;
  RgbImage(std::size_t columns, std::size_t rows, Rgb colour)
      : width(columns), height(rows), pixels(columns * rows, colour) {}

  Rgb& at(std::size_t column, std::size_t row) { return pixels[row * width + column]; }
  const Rgb& at(std::size_t column, std::size_t row) const { return pixels[row * width + column]; }

  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<Rgb> pixels;
};

/// The bytes of a PNG file. Throws std::invalid_argument for an image without pixels or with another number of them
/// than its size says, std::runtime_error with libpng's reason where that fails.
std::string pngFile(const RgbImage& image);

}  // namespace irradiff
