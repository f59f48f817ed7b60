#pragma once

#include <CLI/CLI.hpp>

namespace irradiff {

inline constexpr unsigned kMostThreads = 1024;
inline constexpr unsigned kLargestSeed = 999999999;

/// Checks that an option is a whole number from `first` to `last`, at most 999999999, written in digits alone.
CLI::Validator wholeNumber(unsigned first, unsigned last);

}  // namespace irradiff
