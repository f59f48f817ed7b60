#include "experiments/cli/outside_program.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <poll.h>
#include <stdexcept>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace irradiff {
namespace {

constexpr int kPatienceSeconds = 30;

std::array<int, 2> makePipe() {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  return ends;
}

}  // namespace

OutsideProgram::OutsideProgram(std::string command) : command_(std::move(command)) {
  // A program that has ended is told of by write(), not by a signal.
  std::signal(SIGPIPE, SIG_IGN);
  const std::array<int, 2> to = makePipe();
  const std::array<int, 2> from = makePipe();
  process_ = fork();
  if (process_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (process_ == 0) {
    std::signal(SIGPIPE, SIG_DFL);
    dup2(to[0], STDIN_FILENO);
    dup2(from[1], STDOUT_FILENO);
    for (const int end : {to[0], to[1], from[0], from[1]}) close(end);
    execl("/bin/sh", "sh", "-c", command_.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  close(to[0]);
  close(from[1]);
  to_program_ = to[1];
  from_program_ = from[0];
}

OutsideProgram::~OutsideProgram() {
  close(to_program_);
  close(from_program_);
  waitpid(process_, nullptr, 0);
}

void OutsideProgram::giveUp(const std::string& reason) {
  failure_ = "the program `" + command_ + "` " + reason;
  throw std::runtime_error(failure_);
}

void OutsideProgram::write(const std::string& text) {
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t count = ::write(to_program_, text.data() + written, text.size() - written);
    if (count < 0 && errno != EINTR) giveUp("has ended before it has read all");
    if (count > 0) written += static_cast<std::size_t>(count);
  }
}

std::string OutsideProgram::answer(const std::string& line) {
  if (!failure_.empty()) throw std::runtime_error(failure_);
  write(line + '\n');
  for (;;) {
    if (const std::size_t end = heard_.find('\n'); end != std::string::npos) {
      std::string answer = heard_.substr(0, end);
      heard_.erase(0, end + 1);
      return answer;
    }
    pollfd waiting{from_program_, POLLIN, 0};
    const int ready = poll(&waiting, 1, 1000 * kPatienceSeconds);
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) {
      giveUp("has answered nothing for " + std::to_string(kPatienceSeconds) +
             " s, must write a line for each that it reads, and flush it");
    }
    std::array<char, 65536> buffer{};
    const ssize_t count = read(from_program_, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) giveUp("has ended without answering");
    heard_.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace irradiff
