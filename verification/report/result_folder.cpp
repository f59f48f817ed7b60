#include "verification/report/result_folder.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <unistd.h>
#include <utility>

namespace irradiff {
namespace {

namespace fs = std::filesystem;

bool holdsResults(const fs::path& folder, const std::string& name) {
  std::ifstream file(folder / "run.json", std::ios::binary);
  const nlohmann::json run = nlohmann::json::parse(file, nullptr, false);
  const auto command = run.is_object() ? run.find("command") : run.end();
  return run.is_object() && run.value("format", nlohmann::json()) == "irradiff-run" && command != run.end() &&
         command->is_array() && command->size() >= 2 && (*command)[1] == name;
}

/// "a report", "an atlas".
std::string withArticle(const std::string& noun) {
  const bool has_vowel = noun.find_first_of("aeio") == 0;
  return (has_vowel ? "an " : "a ") + noun;
}

/// The path without links, dots or a slash at its end.
fs::path placeOf(const fs::path& path, const std::string& command) {
  if (path.empty()) {
    throw RefusedFolder("cannot write " + withArticle(command) + ": the path of its folder is empty");
  }
  const fs::path place = fs::weakly_canonical(fs::absolute(path));
  return place.has_filename() ? place : place.parent_path();
}

}  // namespace

ResultFolder::ResultFolder(const fs::path& path, std::string command)
    : path_(placeOf(path, command)), command_(std::move(command)) {
  requireReplaceable();
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

ResultFolder::~ResultFolder() {
  if (!aside_.empty()) {
    std::error_code ignored;
    fs::remove_all(aside_, ignored);
  }
}

void ResultFolder::write(const fs::path& name, const std::string& content) const {
  const fs::path file = aside_ / name;
  fs::create_directories(file.parent_path());
  std::ofstream stream(file, std::ios::binary);
  stream << content;
  stream.close();
  if (!stream) {
    throw std::runtime_error("cannot write " + (path_ / name).string());
  }
}

void ResultFolder::requireReplaceable() const {
  if (!fs::exists(path_)) {
    return;
  }
  const bool is_ours = fs::is_directory(path_) && (fs::is_empty(path_) || holdsResults(path_, command_));
  if (!is_ours) {
    throw RefusedFolder("cannot write " + withArticle(command_) + " to " + path_.string() + ": it exists and is not " +
                        withArticle(command_) + " of irradiff (no run.json of `irradiff " + command_ +
                        "` in it); only " + withArticle(command_) + " or an empty folder is replaced");
  }
}

void ResultFolder::commit() {
  requireReplaceable();
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
