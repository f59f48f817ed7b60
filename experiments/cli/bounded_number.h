#pragma once

#include <CLI/CLI.hpp>

namespace irradiff {

/// Checks that an option is a number from `least` to `most`; NaN is none.
CLI::Validator boundedNumber(double least, double most);

}  // namespace irradiff
