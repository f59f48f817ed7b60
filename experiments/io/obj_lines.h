#pragma once

#include <cstddef>
#include <filesystem>
#include <istream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace irradiff {

/// A Wavefront file that cannot be read or made a scene of. The message names the file, the line or face, the value and
/// the rule.
class ObjFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws ObjFileError("FILE: line N: reason").
[[noreturn]] void refuseLine(const std::filesystem::path& file, std::size_t line, const std::string& reason);

/// Longest Wavefront file in bytes.
inline constexpr std::size_t kMaxObjBytes = std::size_t{128} << 20;

/// A line of an OBJ or MTL file: a keyword and what follows it.
struct ObjLine {
  std::size_t number = 0;  ///< in the file, from 1
  std::string text;        ///< without blanks at its ends; never empty

  std::string_view keyword() const;
  /// What follows the keyword and its blanks; may be empty.
  std::string_view arguments() const;
  /// The arguments up to a comment, split at blanks.
  std::vector<std::string_view> words() const;
};

/// The lines of a file, called `file` in messages, that are neither blank nor comments. Lines end in LF, CR LF or CR;
/// one that ends in a backslash goes on in the next one. Throws ObjFileError for a file that cannot be read, is longer
/// than kMaxObjBytes, or holds a NUL byte, which no text does.
std::vector<ObjLine> readObjLines(std::istream& stream, const std::filesystem::path& file);

}  // namespace irradiff
