#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace irradiff {

/// Runs independent tasks, each once, on up to `threads` threads, the first ones first. Each task writes to a place of
/// its own, so that nothing depends on the number of threads. `progress(done, all)` is called after each, never twice
/// at a time; it may be empty. The first exception of the lowest task is thrown after all running tasks have ended.
void runTasks(const std::vector<std::function<void()>>& tasks, unsigned threads,
              const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace irradiff
