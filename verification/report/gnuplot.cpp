#include "verification/report/gnuplot.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <system_error>
#include <unistd.h>

namespace irradiff {
namespace {

/// A script in a file of its own, removed at the end; gnuplot reads it while its output is read here.
class ScriptFile {
 public:
  explicit ScriptFile(const std::string& script) {
    const int file = mkstemp(path_.data());
    if (file < 0) {
      throw std::runtime_error("cannot write a script for gnuplot: " + std::generic_category().message(errno));
    }
    const bool is_written = write(file, script.data(), script.size()) == static_cast<ssize_t>(script.size());
    close(file);
    if (!is_written) {
      unlink(path_.data());
      throw std::runtime_error("cannot write a script for gnuplot in " + std::string(path_.data()));
    }
  }
  ~ScriptFile() { unlink(path_.data()); }
  ScriptFile(const ScriptFile&) = delete;
  ScriptFile& operator=(const ScriptFile&) = delete;

  const char* path() const { return path_.data(); }

 private:
  std::array<char, 32> path_ = {"/tmp/irradiff-plot-XXXXXX"};
};

}  // namespace

void requireGnuplot() {
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0) {
    throw std::runtime_error("the report's plots need gnuplot, which cannot be run; install the package gnuplot-nox");
  }
}

std::string runGnuplot(const std::string& script) {
  const ScriptFile file(script);
  FILE* pipe = popen(("gnuplot " + std::string(file.path())).c_str(), "r");
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
