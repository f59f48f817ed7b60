#include "tests/cli/program_run.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <spawn.h>
#include <sstream>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace irradiff {

namespace fs = std::filesystem;

namespace {

fs::path makeFolder() {
  std::string pattern = (fs::temp_directory_path() / "irradiff_cli_XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::system_error(errno, std::generic_category(), pattern);
  return pattern;
}

}  // namespace

ScratchFolder::ScratchFolder() : path_(makeFolder()) {}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::size_t ScratchFolder::fileCount() const {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
}

std::string readFile(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

void writeFile(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path.string());
}

ProgramRun runProgramBetween(const std::vector<std::string>& arguments, const fs::path& input, const fs::path& output) {
  const char* program = std::getenv("IRRADIFF_PROGRAM");
  if (program == nullptr) throw std::runtime_error("IRRADIFF_PROGRAM is not set, must be the path of irradiff");
  const ScratchFolder scratch;
  const fs::path messages = scratch.file("messages");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, input.c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, messages.c_str(), O_WRONLY | O_CREAT, 0600);
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);

  const auto start = std::chrono::steady_clock::now();
  pid_t process = 0;
  const int spawn_error = posix_spawn(&process, program, &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (spawn_error != 0) throw std::system_error(spawn_error, std::generic_category(), program);
  int status = 0;
  rusage usage{};
  if (wait4(process, &status, 0, &usage) != process) throw std::system_error(errno, std::generic_category(), "wait4");
  ProgramRun run;
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  run.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  run.peak_kilobytes = usage.ru_maxrss;
  run.messages = readFile(messages);
  return run;
}

ProgramRun runProgram(const std::vector<std::string>& arguments, const std::string& input) {
  const ScratchFolder scratch;
  writeFile(scratch.file("input"), input);
  ProgramRun run = runProgramBetween(arguments, scratch.file("input"), scratch.file("output"));
  run.output = readFile(scratch.file("output"));
  return run;
}

std::vector<nlohmann::json> jsonLines(const std::string& text) {
  std::vector<nlohmann::json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(nlohmann::json::parse(line));
  return lines;
}

}  // namespace irradiff
