#include "experiments/io/whole_file.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <stdexcept>
#include <string>
#include <system_error>
#include <tuple>
#include <unistd.h>
#include <utility>

namespace irradiff {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw std::runtime_error("cannot write " + path.string() + ": " + reason);
}

std::string systemReason() { return std::generic_category().message(errno); }

// The paths of the files that are not committed. The signal handler may interrupt anything, in any thread: whoever
// takes a pointer out owns it.
std::array<std::atomic<char*>, kMostParts> parts{};
static_assert(std::atomic<char*>::is_always_lock_free);

// The place of the path among `parts`; kMostParts where there is none left.
std::size_t addPart(const fs::path& path) {
  char* const copy = strdup(path.c_str());
  for (std::size_t i = 0; i < kMostParts; ++i) {
    char* none = nullptr;
    if (parts[i].compare_exchange_strong(none, copy)) return i;
  }
  free(copy);
  return kMostParts;
}

void forgetPart(std::size_t place) {
  if (place < kMostParts) free(parts[place].exchange(nullptr));
}

// A new, empty file beside `path`, with the permissions that a file made by this process gets, and its place among
// `parts`: taken before the file is there, so that no signal finds the file and not the place.
std::pair<fs::path, std::size_t> createAside(const fs::path& path) {
  for (int attempt = 0;; ++attempt) {
    fs::path aside = path;
    aside += '.' + std::to_string(getpid()) + '-' + std::to_string(attempt) + ".part";
    const std::size_t place = addPart(aside);
    const int file = open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0) {
      close(file);
      return {aside, place};
    }
    const int error = errno;
    forgetPart(place);
    if (error != EEXIST) refuse(path, std::generic_category().message(error));
  }
}

extern "C" void removeParts(int signal_number) {
  for (std::atomic<char*>& part : parts) {
    if (const char* path = part.exchange(nullptr)) unlink(path);
  }
  // Its default action, which ends the process, is in force again: see SA_RESETHAND.
  raise(signal_number);
}

}  // namespace

WholeFile::WholeFile(const fs::path& path) : path_(path), part_(kMostParts) {
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (status.type() == fs::file_type::directory) refuse(path_, "it is a folder");
  const bool replaceable = status.type() == fs::file_type::regular || status.type() == fs::file_type::not_found;
  if (replaceable) {
    if (fs::is_symlink(path_)) path_ = fs::weakly_canonical(path_);
    std::tie(aside_, part_) = createAside(path_);
  }
  stream_.open(replaceable ? aside_ : path_, std::ios::binary);
  if (!stream_) {
    const std::string reason = systemReason();
    if (replaceable) fs::remove(aside_, error);
    forgetPart(part_);
    refuse(path_, reason);
  }
}

WholeFile::~WholeFile() {
  if (aside_.empty()) return;
  stream_.close();
  std::error_code ignored;
  fs::remove(aside_, ignored);
  forgetPart(part_);
}

void WholeFile::commit() {
  errno = 0;
  stream_.close();
  if (!stream_) refuse(path_, errno != 0 ? systemReason() : "not everything could be written");
  if (aside_.empty()) return;
  std::error_code error;
  fs::rename(aside_, path_, error);
  if (error) refuse(path_, error.message());
  aside_.clear();
  forgetPart(part_);
}

void removePartsWhenInterrupted() {
  for (const int signal_number : {SIGHUP, SIGINT, SIGTERM}) {
    struct sigaction action {};
    if (sigaction(signal_number, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = removeParts;
    action.sa_flags = SA_RESETHAND;
    sigemptyset(&action.sa_mask);
    sigaction(signal_number, &action, nullptr);
  }
}

}  // namespace irradiff
