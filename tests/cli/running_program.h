#pragma once

#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace irradiff {

/// The program in the background.
class RunningProgram {
 public:
  explicit RunningProgram(std::vector<std::string> arguments) {
    const char* program = std::getenv("IRRADIFF_PROGRAM");
    if (program == nullptr) throw std::runtime_error("IRRADIFF_PROGRAM is not set, must be the path of irradiff");
    arguments.insert(arguments.begin(), program);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    process_ = fork();
    if (process_ == 0) {
      execv(program, pointers.data());
      _exit(127);
    }
  }

  ~RunningProgram() {
    if (!has_ended_) kill();
  }
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  bool isRunning() {
    has_ended_ = has_ended_ || waitpid(process_, nullptr, WNOHANG) != 0;
    return !has_ended_;
  }
  void pause() const { ::kill(process_, SIGSTOP); }
  void kill() {
    ::kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
    has_ended_ = true;
  }

 private:
  pid_t process_ = -1;
  bool has_ended_ = false;
};

/// How many finished tiles (experiments/figures/tile_store.h) are in the folder.
inline std::size_t tilesIn(const std::filesystem::path& folder) {
  std::size_t tiles = 0;
  if (!std::filesystem::exists(folder)) return 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    tiles += name.starts_with("tile-") && !name.ends_with(".tmp") ? 1 : 0;
  }
  return tiles;
}

}  // namespace irradiff
