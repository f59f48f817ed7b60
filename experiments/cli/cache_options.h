#pragma once

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>

namespace irradiff {

/// The call of `irradiff cache`.
struct CacheArguments {
  std::string file;
  std::string output;
  std::string metric = "occlusion-hessian";
  std::optional<double> threshold;
  std::optional<unsigned> records;
  std::string scale = "relative";
  std::string measure = "total";
  std::string ellipse = "equal-error";
  double aspect = 2.0;
  std::optional<bool> knows_geometry;  ///< nothing: as defaultChoice() has it
  std::string order = "refining";
  bool has_overture = true;
  bool clamps_neighbours = false;
  unsigned passes = 1;
  std::optional<unsigned> rays;
  std::optional<unsigned> width;
  std::uint64_t seed = 1;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  unsigned most_records = 0;
};

/// All options of the command, read into the arguments.
void addCacheOptions(CLI::App& command, CacheArguments& arguments);

}  // namespace irradiff
