// What a signal leaves of an output file that is being written.

#include "tests/cli/program_run.h"

#include <gtest/gtest.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace irradiff {
namespace {

constexpr std::string_view kScene =
    R"({"format": "irradiff-scene", "version": 1, "dimension": 3, "polygons": [{"name": "lamp", "radiance": 1,)"
    R"( "vertices": [[0,0,1],[1,0,1],[0,1,1]]}], "points": [{"position": [0,0,0], "normal": [0,0,1]}]})"
    "\n";

/// `irradiff evaluate --output` in the middle of its work: after one scene it waits for the next.
class WaitingEvaluation {
 public:
  explicit WaitingEvaluation(const std::filesystem::path& output) {
    const char* program = std::getenv("IRRADIFF_PROGRAM");
    if (program == nullptr) throw std::runtime_error("IRRADIFF_PROGRAM is not set, must be the path of irradiff");
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    process_ = fork();
    if (process_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (process_ == 0) {
      dup2(ends[0], STDIN_FILENO);
      close(ends[0]);
      close(ends[1]);
      execl(program, program, "evaluate", "--output", output.c_str(), static_cast<char*>(nullptr));
      _exit(127);
    }
    close(ends[0]);
    input_ = ends[1];
    EXPECT_EQ(write(input_, kScene.data(), kScene.size()), static_cast<ssize_t>(kScene.size()));
  }
  ~WaitingEvaluation() {
    if (input_ >= 0) close(input_);
  }
  WaitingEvaluation(const WaitingEvaluation&) = delete;
  WaitingEvaluation& operator=(const WaitingEvaluation&) = delete;

  /// The signal that ended it, 0 if it ended by itself.
  int endBy(int signal_number) const {
    kill(process_, signal_number);
    int status = 0;
    waitpid(process_, &status, 0);
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }

 private:
  pid_t process_ = -1;
  int input_ = -1;
};

/// Whether a file in the folder of `path` holds something before ten seconds are over.
bool somethingIsWritten(const std::filesystem::path& path) {
  for (int i = 0; i < 1000; ++i) {
    for (const auto& entry : std::filesystem::directory_iterator(path.parent_path())) {
      if (entry.file_size() > 0) return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// The number of files beside the output when the signal has ended the program.
std::size_t filesLeftBy(int signal_number) {
  const ScratchFolder scratch;
  const WaitingEvaluation evaluation(scratch.file("results"));
  EXPECT_TRUE(somethingIsWritten(scratch.file("results")));
  EXPECT_EQ(evaluation.endBy(signal_number), signal_number);
  EXPECT_FALSE(std::filesystem::exists(scratch.file("results")));
  return scratch.fileCount();
}

TEST(Interruption, LeavesNoPartOfAnOutputFile) {
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) EXPECT_EQ(filesLeftBy(signal_number), 0) << signal_number;
}

// Nothing can be done against it. That it is seen here shows that the files above were there before the signal.
TEST(Interruption, BySigkillLeavesThePart) { EXPECT_EQ(filesLeftBy(SIGKILL), 1); }

}  // namespace
}  // namespace irradiff
