#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace irradiff {

/// A file that cannot be read: its text is not JSON, or its fields are not those of the format. The message names the
/// place (line and column, or the path of the field), the value and the rule; it is printable ASCII but for names from
/// the file.
class SceneFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Limits that keep hostile text from exhausting stack and memory. A scene needs 5 levels
/// and 4 values for a vertex.
inline constexpr std::size_t kMaxJsonDepth = 16;
inline constexpr std::size_t kMaxJsonValues = std::size_t{1} << 22;

/// The JSON value that is the whole of `text`. In the place of a number that no double holds (1e999, and NaN and
/// Infinity, which are no JSON) stands a mark, so that who reads the fields can name the one it was found in. Throws
/// SceneFileError for other text that is not JSON (with line and column), for a field given twice in one object, and
/// beyond the limits above.
nlohmann::json parseJson(std::string_view text);

/// What nlohmann-json's parser says of a text, without its leading "[json.exception...] ", short and in printable
/// ASCII: it quotes the text, which may be of any length and in no encoding.
std::string parserMessage(std::string message);

/// How the number was written that `value` marks; nothing where it is no mark.
std::optional<std::string> nonFiniteNumber(const nlohmann::json& value);

/// How a text begins, read as JSON in which NaN and Infinity are numbers.
enum class JsonText {
  kComplete,    ///< one complete value
  kUnfinished,  ///< the beginning of a value, which more text might complete
  kBroken,      ///< no text that follows makes it JSON
};
JsonText jsonText(std::string_view text);

/// A double as a JSON number that reads back to the same double. Throws std::domain_error naming `field` if it is NaN
/// or infinite, which JSON cannot express (nlohmann-json silently writes null).
std::string jsonNumber(double value, std::string_view field);

}  // namespace irradiff
