#include "verification/report/report_folder.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <unistd.h>

namespace irradiff {
namespace {

namespace fs = std::filesystem;

bool isReport(const fs::path& folder) {
  std::ifstream file(folder / "run.json", std::ios::binary);
  const nlohmann::json run = nlohmann::json::parse(file, nullptr, false);
  const auto command = run.is_object() ? run.find("command") : run.end();
  return run.is_object() && run.value("format", nlohmann::json()) == "irradiff-run" && command != run.end() &&
         command->is_array() && command->size() >= 2 && (*command)[1] == "report";
}

void requireReplaceable(const fs::path& path) {
  if (!fs::exists(path)) {
    return;
  }
  const bool is_ours = fs::is_directory(path) && (fs::is_empty(path) || isReport(path));
  if (!is_ours) {
    throw RefusedFolder("cannot write a report to " + path.string() +
                        ": it exists and is not a report of irradiff (no run.json of `irradiff report` in it); only a "
                        "report or an empty folder is replaced");
  }
}

/// The path without links, dots or a slash at its end.
fs::path placeOf(const fs::path& path) {
  if (path.empty()) {
    throw RefusedFolder("cannot write a report: the path of its folder is empty");
  }
  const fs::path place = fs::weakly_canonical(fs::absolute(path));
  return place.has_filename() ? place : place.parent_path();
}

}  // namespace

ReportFolder::ReportFolder(const fs::path& path) : path_(placeOf(path)) {
  requireReplaceable(path_);
  fs::create_directories(path_.parent_path());
  for (int attempt = 0;; ++attempt) {
    fs::path aside = path_;
    aside += '.' + std::to_string(getpid()) + '-' + std::to_string(attempt) + ".part";
    if (fs::create_directory(aside)) {
      aside_ = aside;
      return;
    }
  }
}

ReportFolder::~ReportFolder() {
  if (!aside_.empty()) {
    std::error_code ignored;
    fs::remove_all(aside_, ignored);
  }
}

void ReportFolder::write(const fs::path& name, const std::string& content) const {
  const fs::path file = aside_ / name;
  fs::create_directories(file.parent_path());
  std::ofstream stream(file, std::ios::binary);
  stream << content;
  stream.close();
  if (!stream) {
    throw std::runtime_error("cannot write " + (path_ / name).string());
  }
}

void ReportFolder::commit() {
  requireReplaceable(path_);
  if (!fs::exists(path_)) {
    fs::rename(aside_, path_);
    aside_.clear();
    return;
  }
  fs::path old = aside_;
  old += ".old";
  fs::rename(path_, old);
  try {
    fs::rename(aside_, path_);
  } catch (...) {
    fs::rename(old, path_);
    throw;
  }
  aside_.clear();
  fs::remove_all(old);
}

}  // namespace irradiff
