#pragma once

#include "experiments/io/whole_file.h"

#include <fstream>
#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace irradiff {

/// Adds --output FILE, a path that is not empty; `path` stays empty without it.
void addOutputOption(CLI::App& command, std::string& path, const std::string& description);

/// The file that a command reads. Throws CLI::ValidationError for one that cannot be opened.
std::ifstream openInput(const std::string& path);

/// The file that a command writes, or null for standard output where `path` is empty. Throws CLI::ValidationError for
/// one that cannot be opened.
std::unique_ptr<WholeFile> openOutput(const std::string& path);

/// Ends a command with status 1 after "irradiff COMMAND: message" on standard error: throws CLI::RuntimeError.
[[noreturn]] void fail(const std::string& command, const std::string& message);

/// Fails after an error of standard output; silently where its reader has left, who wants no more.
[[noreturn]] void failToWrite(const std::string& command, int error);

}  // namespace irradiff
