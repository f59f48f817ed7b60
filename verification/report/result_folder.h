#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace irradiff {

/// A folder that the results of a command must not replace.
class RefusedFolder : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The folder of a command's results, which appears whole or not at all: written beside its place, put there by
/// commit(), removed if it is not committed. What was there before stays until then and must be earlier results of the
/// same command (its run.json says so) or an empty folder.
class ResultFolder {
 public:
  /// `command` is its name, "report", and the word for its results. Throws RefusedFolder, naming the path and the rule,
  /// if something else is there; std::runtime_error if nothing can be written.
  ResultFolder(const std::filesystem::path& path, std::string command);
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  /// `name` may have folders of its own, "plots/size.svg". Throws std::runtime_error.
  void write(const std::filesystem::path& name, const std::string& content) const;

  /// Throws RefusedFolder if something else has taken the place in the meantime.
  void commit();

  /// Where the results are after commit().
  const std::filesystem::path& path() const { return path_; }

 private:
  void requireReplaceable() const;

  std::filesystem::path path_;
  std::string command_;
  std::filesystem::path aside_;  // empty after commit()
};

}  // namespace irradiff
