#pragma once

#include "experiments/io/json_text.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace irradiff {

/// Most samples that a record may have.
inline constexpr std::size_t kMostSamples = std::size_t{1} << 26;

/// A record of a samples file as it is written. Only its form is known: hits and radiances are numbers or null.
// NOLINTNEXTLINE(bugprone-exception-escape): a JSON value checks itself when it is moved, and does not throw.
struct SamplesRecord {
  nlohmann::json fields;  ///< an object; its "hits" and "radiance", where they are arrays, are empty: they are below
  std::vector<double> hit_x, hit_y, hit_z;  ///< NaN for null, which is a ray that hit nothing
  std::vector<double> radiance;             ///< NaN for null
};

/// Reads a stream of samples records, one after the other: JSON Lines, or objects over any number of lines. A record is
/// never held as text, and its numbers once.
class SamplesRecords {
 public:
  /// The stream must outlive this.
  explicit SamplesRecords(std::istream& stream) : stream_(stream) {}

  /// The next record; nothing at the end of the stream. Throws SceneFileError that names the field, the value and the
  /// rule for a record that is not one, which may follow text that is: the next call goes on behind the record, or,
  /// where it is not JSON, at the next line that begins with "{".
  std::optional<SamplesRecord> next();

 private:
  bool skipBlanks();
  void skipToNextRecord();
  /// The parser stops at the first letter that is wrong.
  std::string restOfWord(std::string word);

  std::istream& stream_;
};

}  // namespace irradiff
