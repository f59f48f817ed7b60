#include "experiments/figures/tile_store.h"

#include "experiments/figures/byte_hash.h"
#include "verification/report/result_folder.h"

#include <bit>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <sys/file.h>
#include <unistd.h>

namespace irradiff {

namespace {

namespace fs = std::filesystem;

constexpr const char* kFingerprintFile = "fingerprint.json";

std::string readAll(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void writeWhole(const fs::path& path, std::string_view bytes) {
  fs::path aside = path;
  aside += ".tmp";
  std::ofstream file(aside, std::ios::binary);
  file << bytes;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + aside.string());
  fs::rename(aside, path);
}

std::string bytesOf(std::uint64_t number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

bool isOurs(const fs::path& path) {
  return fs::is_directory(path) && (fs::is_empty(path) || fs::exists(path / kFingerprintFile));
}

}  // namespace

fs::path unfinishedFolder(const fs::path& output) {
  const fs::path place = fs::weakly_canonical(fs::absolute(output));
  fs::path folder = place.has_filename() ? place : place.parent_path();
  folder += ".part";
  return folder;
}

TileStore::TileStore(const fs::path& path, const std::string& fingerprint)
    : path_(path), fingerprint_hash_(byteHash(fingerprint)) {
  if (fs::exists(path_) && !isOurs(path_)) {
    throw RefusedFolder("cannot keep unfinished work in " + path_.string() + ": it exists and holds something else");
  }
  fs::create_directories(path_);
  lock_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0) throw std::runtime_error("cannot open " + path_.string());
  if (flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    close(lock_);
    throw RefusedFolder("cannot keep unfinished work in " + path_.string() + ": another run does so");
  }
  if (readAll(path_ / kFingerprintFile) == fingerprint) return;
  try {
    for (const fs::directory_entry& entry : fs::directory_iterator(path_)) {
      if (entry.path().filename() != kFingerprintFile) fs::remove(entry.path());
    }
    writeWhole(path_ / kFingerprintFile, fingerprint);
  } catch (...) {
    close(lock_);
    throw;
  }
}

TileStore::~TileStore() {
  if (lock_ >= 0) close(lock_);
}

fs::path TileStore::fileOf(std::size_t tile) const { return path_ / ("tile-" + std::to_string(tile)); }

// A tile: the hash of the fingerprint, the numbers, the hash of both.
std::optional<std::vector<double>> TileStore::read(std::size_t tile, std::size_t count) const {
  const std::string bytes = readAll(fileOf(tile));
  const std::string head = bytesOf(fingerprint_hash_);
  if (bytes.size() != head.size() + count * sizeof(double) + sizeof(std::uint64_t) || !bytes.starts_with(head)) {
    return std::nullopt;
  }
  const std::string_view hashed = std::string_view(bytes).substr(0, bytes.size() - sizeof(std::uint64_t));
  if (!bytes.ends_with(bytesOf(byteHash(hashed)))) return std::nullopt;
  std::vector<double> numbers(count);
  std::memcpy(numbers.data(), bytes.data() + head.size(), count * sizeof(double));
  return numbers;
}

void TileStore::write(std::size_t tile, std::span<const double> numbers) const {
  std::string bytes = bytesOf(fingerprint_hash_);
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
  bytes += bytesOf(byteHash(bytes));
  writeWhole(fileOf(tile), bytes);
}

void TileStore::remove() { fs::remove_all(path_); }

}  // namespace irradiff
