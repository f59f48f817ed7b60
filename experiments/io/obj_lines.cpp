#include "experiments/io/obj_lines.h"

#include <algorithm>
#include <array>

namespace irradiff {

namespace {

constexpr std::string_view kBlanks = " \t";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string readText(std::istream& stream, const std::filesystem::path& file) {
  std::string text;
  std::array<char, 1 << 16> chunk;
  while (stream.good()) {
    stream.read(chunk.data(), chunk.size());
    text.append(chunk.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kMaxObjBytes) {
      throw ObjFileError(file.string() + ": longer than " + std::to_string(kMaxObjBytes) +
                         " bytes, must be at most that long");
    }
  }
  if (!stream.eof()) throw ObjFileError(file.string() + ": cannot be read: the stream failed");
  return text;
}

}  // namespace

void refuseLine(const std::filesystem::path& file, std::size_t line, const std::string& reason) {
  throw ObjFileError(file.string() + ": line " + std::to_string(line) + ": " + reason);
}

std::string_view ObjLine::keyword() const { return std::string_view(text).substr(0, text.find_first_of(kBlanks)); }

std::string_view ObjLine::arguments() const { return trimmed(std::string_view(text).substr(keyword().size())); }

std::vector<std::string_view> ObjLine::words() const {
  std::vector<std::string_view> words;
  std::string_view rest = arguments();
  while (!rest.empty() && !rest.starts_with('#')) {
    words.push_back(rest.substr(0, rest.find_first_of(kBlanks)));
    rest = trimmed(rest.substr(words.back().size()));
  }
  return words;
}

std::vector<ObjLine> readObjLines(std::istream& stream, const std::filesystem::path& file) {
  const std::string text = readText(stream, file);
  std::vector<ObjLine> lines;
  std::string_view rest = text;
  if (rest.starts_with(kByteOrderMark)) rest.remove_prefix(kByteOrderMark.size());
  bool goes_on = false;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
    std::string_view line = rest.substr(0, end);
    const std::size_t line_break = rest.substr(end).starts_with("\r\n") ? 2 : 1;
    rest.remove_prefix(std::min(end + line_break, rest.size()));

    if (line.find('\0') != std::string_view::npos) refuseLine(file, number, "holds a NUL byte, must be text");
    const bool continues = goes_on;
    goes_on = line.ends_with('\\');
    if (goes_on) line.remove_suffix(1);
    line = trimmed(line);
    if (continues) {
      lines.back().text.append(" ").append(line);
    } else if (goes_on || (!line.empty() && !line.starts_with('#'))) {
      lines.push_back({number, std::string(line)});
    }
  }
  // Where a line goes on in blank ones, what was put together has blanks at its ends or is nothing but blanks.
  for (ObjLine& line : lines) line.text = std::string(trimmed(line.text));
  std::erase_if(lines, [](const ObjLine& line) { return line.text.empty() || line.text.starts_with('#'); });
  return lines;
}

}  // namespace irradiff
