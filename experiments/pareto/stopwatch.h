#pragma once

#include <chrono>
#include <cstddef>

namespace irradiff {

/// Makes the compiler believe that somebody reads the value.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "r"(&value) : "memory");
}

/// Nanoseconds for each of `calls` calls, on the calling thread.
template <class Work>
double nanosecondsOf(const Work& work, std::size_t calls) {
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < calls; ++i) work();
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() /
         static_cast<double>(calls);
}

/// How many calls take about `nanoseconds`, at least one, at most 1000; tried out with a few.
template <class Work>
std::size_t callsFor(const Work& work, double nanoseconds) {
  const double once = nanosecondsOf(work, 1);
  const double each = once * 4.0 < nanoseconds ? nanosecondsOf(work, 4) : once;
  const double calls = nanoseconds / (each > 1.0 ? each : 1.0);
  return calls < 1.0 ? 1 : calls > 1000.0 ? 1000 : static_cast<std::size_t>(calls);
}

}  // namespace irradiff
