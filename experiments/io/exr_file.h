#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace irradiff {

/// A map as OpenEXR holds it. Values are row-major, the topmost row first.
struct ExrImage {
  struct Channel {
    std::string name;  ///< such as "gradient.x"; the part before the last dot is its layer
    std::vector<double> values;
  };
  /// A text in the file's header.
  struct Attribute {
    std::string name;
    std::string text;
  };

  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<Channel> channels;
  std::vector<Attribute> attributes;
};

/// The bytes of an OpenEXR file with a 32-bit float channel for each of the image, losslessly compressed (ZIP). Each
/// value is rounded to the nearest float; a NaN stays a NaN and stands for a quantity that does not exist there.
///
/// Throws std::invalid_argument, naming the channel, the value and the rule, for an image without pixels or channels, a
/// channel of another size, a name that is empty or given twice, and a value that is infinite or beyond the range of
/// float.
std::string exrFile(const ExrImage& image);

/// The float channels, in the order of their names, and the texts in the header of an OpenEXR file's bytes. Throws
/// std::runtime_error for bytes that are no such file, or a channel that is not of 32-bit floats.
ExrImage parseExr(const std::string& bytes);

}  // namespace irradiff
