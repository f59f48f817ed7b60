#pragma once

#include <cstddef>
#include <ostream>
#include <string>
#include <string_view>

namespace irradiff {

/// Most bytes of a text that are held in memory.
inline constexpr std::size_t kMaxHeldBytes = std::size_t{64} << 20;

/// A text of any length that is written when all of it is known, or thrown away: in memory up to kMaxHeldBytes, beyond
/// them in a file without a name in the folder for temporary files (TMPDIR, else /tmp), which is gone when this is or
/// the process ends.
class SpooledText {
 public:
  SpooledText() = default;
  ~SpooledText();
  SpooledText(const SpooledText&) = delete;
  SpooledText& operator=(const SpooledText&) = delete;

  /// Throws std::runtime_error that names the folder and the reason if the file cannot be made or grow.
  void append(std::string_view text);

  /// Forgets the text.
  void clear();

  /// Writes all of the text, until the stream fails. Throws std::runtime_error if the file cannot be read.
  void writeTo(std::ostream& stream) const;

 private:
  void spill();

  std::string held_;  // the end of the text
  int file_ = -1;     // what comes before it, if that is not nothing
};

}  // namespace irradiff
