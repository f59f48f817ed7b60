#include "verification/report/parallel_tasks.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace irradiff {

void runTasks(const std::vector<std::function<void()>>& tasks, unsigned threads,
              const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<std::exception_ptr> failures(tasks.size());
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> has_failed = false;
  std::size_t done = 0;
  std::mutex reporting;
  const auto work = [&] {
    for (std::size_t i = next++; i < tasks.size() && !has_failed; i = next++) {
      try {
        tasks[i]();
      } catch (...) {
        failures[i] = std::current_exception();
        has_failed = true;
      }
      const std::scoped_lock lock(reporting);
      ++done;
      if (progress) {
        progress(done, tasks.size());
      }
    }
  };
  {
    const std::size_t count = std::min<std::size_t>(std::max(1U, threads), std::max<std::size_t>(1, tasks.size()));
    std::vector<std::jthread> helpers;
    for (std::size_t i = 1; i < count; ++i) {
      helpers.emplace_back(work);
    }
    work();
  }
  for (const std::exception_ptr& failure : failures) {
    if (failure) {
      std::rethrow_exception(failure);
    }
  }
}

}  // namespace irradiff
