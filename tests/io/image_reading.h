#pragma once

#include "experiments/io/png_file.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace irradiff {

/// What OpenEXR finds in a file: the float channels, topmost row first, and the texts of the header.
struct ReadExr {
  std::size_t width = 0;
  std::size_t height = 0;
  std::map<std::string, std::vector<float>> channels;
  std::map<std::string, std::string> texts;
};

/// Throws std::runtime_error, or what OpenEXR throws, for bytes that are no such file or have a channel that is not
/// float.
ReadExr readExr(const std::string& bytes);

/// What libpng finds. Throws std::runtime_error for bytes that are no PNG file of 8-bit RGB.
RgbImage readPng(const std::string& bytes);

/// The bytes of a base64 text. Throws std::runtime_error for one that is none.
std::string bytesOfBase64(const std::string& text);

}  // namespace irradiff
