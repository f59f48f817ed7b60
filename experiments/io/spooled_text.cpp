#include "experiments/io/spooled_text.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <stdexcept>
#include <sys/types.h>
#include <system_error>
#include <unistd.h>

namespace irradiff {

namespace {

[[noreturn]] void refuse(const std::string& action) {
  const int error = errno;
  throw std::runtime_error("cannot " + action + " a temporary file in " +
                           std::filesystem::temp_directory_path().string() + ": " +
                           std::generic_category().message(error));
}

int openUnnamed() {
  std::string path = (std::filesystem::temp_directory_path() / "irradiff-XXXXXX").string();
  const int file = mkostemp(path.data(), O_CLOEXEC);
  if (file < 0) refuse("make");
  unlink(path.c_str());
  return file;
}

}  // namespace

SpooledText::~SpooledText() { clear(); }

void SpooledText::append(std::string_view text) {
  if (held_.size() + text.size() > kMaxHeldBytes) spill();
  held_ += text;
}

void SpooledText::clear() {
  held_.clear();
  if (file_ >= 0) close(file_);
  file_ = -1;
}

void SpooledText::spill() {
  if (file_ < 0) file_ = openUnnamed();
  for (std::string_view rest = held_; !rest.empty();) {
    const ssize_t count = write(file_, rest.data(), rest.size());
    if (count < 0 && errno != EINTR) refuse("write");
    rest.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  }
  held_.clear();
}

void SpooledText::writeTo(std::ostream& stream) const {
  if (file_ >= 0) {
    std::string chunk(std::size_t{1} << 20, '\0');
    for (off_t position = 0; stream;) {
      const ssize_t count = pread(file_, chunk.data(), chunk.size(), position);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) refuse("read");
      if (count == 0) break;
      stream.write(chunk.data(), count);
      position += count;
    }
  }
  stream << held_;
}

}  // namespace irradiff
