#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace irradiff {

/// What one call of the program `irradiff` left behind.
struct ProgramRun {
  int status = -1;  ///< exit status, or 128 + the signal that ended it
  std::string output;
  std::string messages;  ///< standard error
  double seconds = 0.0;
  long peak_kilobytes = 0;  ///< of resident memory
};

/// Runs the program named by the environment variable IRRADIFF_PROGRAM with these arguments and standard input. Throws
/// std::runtime_error if it cannot be run.
ProgramRun runProgram(const std::vector<std::string>& arguments, const std::string& input = "");
/// The same with a file as standard input and another one, such as /dev/full, as standard output.
ProgramRun runProgramBetween(const std::vector<std::string>& arguments, const std::filesystem::path& input,
                             const std::filesystem::path& output);

/// Each line of the output as JSON. Throws nlohmann::json::exception where one is not.
std::vector<nlohmann::json> jsonLines(const std::string& text);

/// A folder of its own, removed with all that is in it.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path file(const std::string& name) const { return path_ / name; }
  std::size_t fileCount() const;

 private:
  std::filesystem::path path_;
};

std::string readFile(const std::filesystem::path& path);
void writeFile(const std::filesystem::path& path, const std::string& text);

}  // namespace irradiff
