#include "verification/report/gnuplot.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <unistd.h>

namespace irradiff {
namespace {

/// A script in a file without a name, open at its beginning; gnuplot reads it while its output is read here.
class ScriptFile {
 public:
  explicit ScriptFile(const std::string& script) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path();
    std::string path = (folder / "irradiff-plot-XXXXXX").string();
    file_ = mkstemp(path.data());
    if (file_ < 0) {
      refuse(folder);
    }
    unlink(path.c_str());
    const bool is_written = write(file_, script.data(), script.size()) == static_cast<ssize_t>(script.size());
    if (!is_written || lseek(file_, 0, SEEK_SET) != 0) {
      close(file_);
      refuse(folder);
    }
  }
  ~ScriptFile() { close(file_); }
  ScriptFile(const ScriptFile&) = delete;
  ScriptFile& operator=(const ScriptFile&) = delete;

  int descriptor() const { return file_; }

 private:
  [[noreturn]] static void refuse(const std::filesystem::path& folder) {
    const std::string reason = std::generic_category().message(errno);
    throw std::runtime_error("cannot write a script for gnuplot in " + folder.string() + ": " + reason);
  }

  int file_;
};

}  // namespace

void requireGnuplot() {
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0) {
    throw std::runtime_error("the report's plots need gnuplot, which cannot be run; install the package gnuplot-nox");
  }
}

std::string runGnuplot(const std::string& script) {
  const ScriptFile file(script);
  FILE* pipe = popen(("gnuplot <&" + std::to_string(file.descriptor())).c_str(), "r");
  if (pipe == nullptr) {
    throw std::runtime_error("cannot run gnuplot: " + std::generic_category().message(errno));
  }
  std::string svg;
  std::array<char, 65536> buffer{};
  for (std::size_t count = 0; (count = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    svg.append(buffer.data(), count);
  }
  if (pclose(pipe) != 0 || svg.find("</svg>") == std::string::npos) {
    throw std::runtime_error("gnuplot (package gnuplot-nox) could not make a plot; its message is above");
  }
  return svg;
}

}  // namespace irradiff
