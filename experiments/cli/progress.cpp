#include "experiments/cli/progress.h"

#include <iostream>
#include <unistd.h>

namespace irradiff {

namespace {

constexpr std::chrono::seconds kQuietStart(1);
constexpr std::chrono::milliseconds kInterval(200);
/// Return to the line's start and erase it (ECMA-48).
constexpr const char* kClearLine = "\r\x1b[K";

}  // namespace

Progress::Progress(bool is_hidden)
    : is_enabled_(!is_hidden && isatty(STDERR_FILENO) == 1), next_(Clock::now() + kQuietStart) {}

Progress::~Progress() {
  if (is_shown_) std::cerr << kClearLine << std::flush;
}

bool Progress::isDue() const { return is_enabled_ && Clock::now() >= next_; }

void Progress::show(const std::string& text) {
  if (!is_enabled_) return;
  std::cerr << kClearLine << text << std::flush;
  is_shown_ = true;
  next_ = Clock::now() + kInterval;
}

}  // namespace irradiff
