#pragma once

#include <string>

namespace irradiff {

/// Throws std::runtime_error that names the package unless the program gnuplot can be run.
void requireGnuplot();

/// The SVG document that gnuplot makes of a script, which writes to standard output. Throws std::runtime_error if
/// gnuplot cannot be run or does not accept the script.
std::string runGnuplot(const std::string& script);

}  // namespace irradiff
