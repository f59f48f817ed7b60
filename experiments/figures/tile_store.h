#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

/// The folder of a TileStore for results that go to `output`: beside it, with ".part" behind its name.
std::filesystem::path unfinishedFolder(const std::filesystem::path& output);

/// The finished parts of long work, in a folder beside its result, so that a run that was killed can go on.
///
/// A tile is an array of numbers. It is written whole or not at all, and taken up again only if its bytes are what was
/// written and the fingerprint, which says all that the numbers depend on, is the same.
class TileStore {
 public:
  /// The folder `path`, made if it is not there. Tiles of another fingerprint that are in it are removed. Throws
  /// RefusedFolder if it is in use by another run or was not made by a TileStore; std::runtime_error if nothing can be
  /// written.
  TileStore(const std::filesystem::path& path, const std::string& fingerprint);
  ~TileStore();
  TileStore(const TileStore&) = delete;
  TileStore& operator=(const TileStore&) = delete;

  /// A tile of `count` numbers, nothing if it is not there whole. Tiles may be read and written from several threads,
  /// each by one.
  std::optional<std::vector<double>> read(std::size_t tile, std::size_t count) const;
  void write(std::size_t tile, std::span<const double> numbers) const;

  /// Removes the folder: the result is there. Nothing is read or written afterwards.
  void remove();

 private:
  std::filesystem::path fileOf(std::size_t tile) const;

  std::filesystem::path path_;
  std::uint64_t fingerprint_hash_ = 0;
  int lock_ = -1;
};

}  // namespace irradiff
