#pragma once

#include <string>

namespace irradiff {

/// For options that name an error metric: why the name is refused, with those that there are; empty if it is one.
std::string wrongMetric(const std::string& name);

}  // namespace irradiff
