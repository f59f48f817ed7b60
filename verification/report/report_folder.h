#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace irradiff {

/// A folder that a report must not replace.
class RefusedFolder : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A report's folder, which appears whole or not at all: written beside its place, put there by commit(), removed if it
/// is not committed. What was there before stays until then and must be an earlier report (its run.json says so) or an
/// empty folder.
class ReportFolder {
 public:
  /// Throws RefusedFolder, naming the path and the rule, if something else is there; std::runtime_error if nothing can
  /// be written.
  explicit ReportFolder(const std::filesystem::path& path);
  ~ReportFolder();
  ReportFolder(const ReportFolder&) = delete;
  ReportFolder& operator=(const ReportFolder&) = delete;

  /// `name` may have folders of its own, "plots/size.svg". Throws std::runtime_error.
  void write(const std::filesystem::path& name, const std::string& content) const;

  /// Throws RefusedFolder if something else has taken the place in the meantime.
  void commit();

  /// Where the report is after commit().
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::filesystem::path aside_;  // empty after commit()
};

}  // namespace irradiff
