#include "experiments/cli/command_files.h"

#include <CLI/CLI.hpp>

#include <cerrno>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <system_error>

namespace irradiff {

namespace {

constexpr int kFailed = 1;

}  // namespace

void addOutputOption(CLI::App& command, std::string& path, const std::string& description) {
  command.add_option("--output", path, description)
      ->type_name("FILE")
      ->check([](const std::string& given) { return given.empty() ? "is empty, must be a path" : std::string(); }, "");
}

std::ifstream openInput(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  const int error = errno;
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw CLI::ValidationError("FILE", path + " is a folder");
  if (!file) throw CLI::ValidationError("FILE", path + ": " + std::generic_category().message(error));
  return file;
}

std::unique_ptr<WholeFile> openOutput(const std::string& path) {
  try {
    return path.empty() ? nullptr : std::make_unique<WholeFile>(path);
  } catch (const std::runtime_error& error) {
    throw CLI::ValidationError("--output", error.what());
  }
}

void fail(const std::string& command, const std::string& message) {
  std::cerr << "irradiff " << command << ": " << message << '\n';
  throw CLI::RuntimeError(kFailed);
}

void failToWrite(const std::string& command, int error) {
  if (error == EPIPE) throw CLI::RuntimeError(kFailed);
  fail(command, "cannot write standard output: " + std::generic_category().message(error));
}

}  // namespace irradiff
