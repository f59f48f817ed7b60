#pragma once

#include <optional>
#include <string>

namespace irradiff {

/// Machine epsilon of double, 2^-52: the unit of the report's error tables.
inline constexpr double kEpsilon = 0x1p-52;

/// Two significant digits: "3.4e-15", "0.093", "0", "infinite".
std::string figureText(double value);
/// In units of kEpsilon, two significant digits; large figures as powers of ten.
std::string epsilonText(double relative_error);
/// As above, or a dash.
std::string figureText(const std::optional<double>& value);
std::string epsilonText(const std::optional<double>& relative_error);
/// 12 345 for 12345.
std::string countText(std::size_t count);

}  // namespace irradiff
