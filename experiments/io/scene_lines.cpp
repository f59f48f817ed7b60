#include "experiments/io/scene_lines.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace irradiff {

namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

bool isBlank(std::string_view text) { return text.find_first_not_of(kBlanks) == std::string_view::npos; }

// A complete object with a field "format", as every file of ours is. Other complete values occur as lines of one scene.
bool isSceneLine(std::string_view line) {
  return !isBlank(line) && line[line.find_first_not_of(kBlanks)] == '{' &&
         line.find("\"format\"") != std::string_view::npos && jsonText(line) == JsonText::kComplete;
}

[[noreturn]] void refuseLength() {
  throw SceneFileError("scene longer than " + std::to_string(kMaxSceneBytes) + " bytes, must be at most that long");
}

}  // namespace

SceneLines::Line SceneLines::readLine(std::string& line) {
  line.clear();
  if (!pending_.empty()) {
    const std::size_t end = pending_.find('\n', pending_read_);
    line.assign(pending_, pending_read_, end - pending_read_);
    pending_read_ = end + 1;
    if (pending_read_ == pending_.size()) pending_ = {};
    return Line::kRead;
  }
  std::array<char, 1 << 14> chunk;
  bool too_long = false;
  bool complete = false;
  while (!complete && stream_.good()) {
    stream_.getline(chunk.data(), chunk.size());
    const auto extracted = static_cast<std::size_t>(stream_.gcount());
    complete = stream_.good();  // then the line break was extracted too
    const std::size_t count = complete ? extracted - 1 : extracted;
    // What is beyond the limit is read and forgotten.
    too_long = too_long || line.size() + count > kMaxSceneBytes;
    if (!too_long) line.append(chunk.data(), count);
    const bool chunk_is_full = stream_.fail() && !stream_.eof() && !stream_.bad();
    if (chunk_is_full) stream_.clear();
  }
  if (!complete && !stream_.eof()) throw SceneFileError("cannot be read: the stream failed");
  if (too_long) return Line::kTooLong;
  return complete || !line.empty() ? Line::kRead : Line::kEnd;
}

bool SceneLines::next(std::string& text) {
  Line line = Line::kRead;
  do {
    line = readLine(text);
  } while (line == Line::kRead && isBlank(text));
  const bool first = std::exchange(first_, false);
  if (line == Line::kTooLong) {
    text.clear();
    refuseLength();
  }
  if (line == Line::kEnd) return false;
  if (first && jsonText(text) == JsonText::kUnfinished) completeScene(text);
  return true;
}

// Appends the lines that follow to the first one, `text`, unless they turn out to be scenes of their own.
void SceneLines::completeScene(std::string& text) {
  const std::size_t first_line_size = text.size();
  bool too_long = false;
  std::string line;
  for (Line state = readLine(line); state != Line::kEnd; state = readLine(line)) {
    if (state == Line::kRead && isSceneLine(line)) {
      pending_ = text.substr(std::min(first_line_size + 1, text.size())) + '\n' + line + '\n';
      pending_read_ = 0;
      text.resize(std::min(first_line_size, text.size()));
      break;
    }
    too_long = too_long || state == Line::kTooLong || text.size() + line.size() + 1 > kMaxSceneBytes;
    if (too_long) {
      text.clear();
    } else {
      text += '\n' + line;
    }
  }
  if (too_long) refuseLength();
}

}  // namespace irradiff
