#pragma once

#include "experiments/io/json_text.h"

#include <cstddef>
#include <istream>
#include <string>

namespace irradiff {

/// Longest text of one scene in bytes: a line of JSON Lines, or a whole file.
inline constexpr std::size_t kMaxSceneBytes = std::size_t{64} << 20;

/// Splits a stream into the texts of its scenes. The stream holds JSON Lines (a scene a line) or one scene over any
/// number of lines; blank lines between scenes are skipped. Decided on the first line that is not blank:
///   - it is a complete JSON value, or broken beyond repair by what follows: JSON Lines, read line by line;
///   - otherwise everything is one scene, unless a later line by itself is an object with a field "format", which
///   nothing
///     inside a scene is: then it is JSON Lines whose first line was cut off.
/// Memory is bounded by a small multiple of kMaxSceneBytes whatever the input.
class SceneLines {
 public:
  /// The stream must outlive this.
  explicit SceneLines(std::istream& stream) : stream_(stream) {}

  /// Puts the text of the next scene into `text`; false at the end of the stream, where `text` is empty. Does not check
  /// the text. Throws SceneFileError for a text longer than kMaxSceneBytes, and then the next call goes on behind that
  /// text; and when the stream cannot be read.
  bool next(std::string& text);

 private:
  enum class Line { kRead, kTooLong, kEnd };
  Line readLine(std::string& line);
  void completeScene(std::string& text);

  std::istream& stream_;
  bool first_ = true;
  std::string pending_;  // lines, each with its line break, read before it was clear that they are scenes of their own
  std::size_t pending_read_ = 0;
};

}  // namespace irradiff
