#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <ostream>

namespace irradiff {

/// Most files that removePartsWhenInterrupted() takes care of at once; a command writes one.
inline constexpr std::size_t kMostParts = 16;

/// An output file that appears whole or not at all: written aside in the same folder, renamed to its path by commit(),
/// and removed if it is not committed. What was at the path stays until then. A symbolic link is followed; what is
/// neither a regular file nor a folder (a pipe, /dev/stdout) is written to directly, because renaming would replace it.
/// A process that a signal ends leaves the file aside behind, unless removePartsWhenInterrupted() was called.
/// Every failure throws std::runtime_error with the path and the reason.
class WholeFile {
 public:
  explicit WholeFile(const std::filesystem::path& path);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// Where to write; nothing may be written after commit().
  std::ostream& stream() { return stream_; }

  /// Puts the file in its place. Throws also if something could not be written; then there is no file.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path aside_;  // empty where there is nothing to rename or remove
  std::size_t part_;             // its place among those that a signal removes
  std::ofstream stream_;
};

/// From now on SIGHUP, SIGINT and SIGTERM, unless they are ignored, remove what WholeFile has not committed before they
/// end the process as they do anyway. Against SIGKILL nothing helps: what it leaves ends in ".part".
void removePartsWhenInterrupted();

}  // namespace irradiff
