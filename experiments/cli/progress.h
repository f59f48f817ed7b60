#pragma once

#include <chrono>
#include <string>

namespace irradiff {

/// A line on standard error that tells how far long work has come, and goes when this does. Nothing is shown unless
/// standard error is a terminal, nor in the first second, nor more often than five times a second.
class Progress {
 public:
  /// With `is_hidden` nothing is ever shown: for work that writes its results to the same terminal.
  explicit Progress(bool is_hidden);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Whether it is time to show something new; costs a look at the clock.
  bool isDue() const;
  void show(const std::string& text);

 private:
  using Clock = std::chrono::steady_clock;
  bool is_enabled_;
  bool is_shown_ = false;
  Clock::time_point next_;
};

}  // namespace irradiff
