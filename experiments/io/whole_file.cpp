#include "experiments/io/whole_file.h"

#include <cerrno>
#include <fcntl.h>
#include <stdexcept>
#include <string>
#include <system_error>
#include <unistd.h>

namespace irradiff {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw std::runtime_error("cannot write " + path.string() + ": " + reason);
}

std::string systemReason() { return std::generic_category().message(errno); }

// Creates a new, empty file beside `path`, with the permissions that a file made by this process gets.
fs::path createAside(const fs::path& path) {
  for (int attempt = 0;; ++attempt) {
    fs::path aside = path;
    aside += '.' + std::to_string(getpid()) + '-' + std::to_string(attempt) + ".part";
    const int file = open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0) {
      close(file);
      return aside;
    }
    if (errno != EEXIST) refuse(path, systemReason());
  }
}

}  // namespace

WholeFile::WholeFile(const fs::path& path) : path_(path) {
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (status.type() == fs::file_type::directory) refuse(path_, "it is a folder");
  const bool replaceable = status.type() == fs::file_type::regular || status.type() == fs::file_type::not_found;
  if (replaceable) {
    if (fs::is_symlink(path_)) path_ = fs::weakly_canonical(path_);
    aside_ = createAside(path_);
  }
  stream_.open(replaceable ? aside_ : path_, std::ios::binary);
  if (!stream_) {
    const std::string reason = systemReason();
    if (replaceable) fs::remove(aside_, error);
    refuse(path_, reason);
  }
}

WholeFile::~WholeFile() {
  if (aside_.empty()) return;
  stream_.close();
  std::error_code ignored;
  fs::remove(aside_, ignored);
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
}

}  // namespace irradiff
