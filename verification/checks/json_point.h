#pragma once

#include <Eigen/Core>

#include <array>
#include <charconv>
#include <string>

namespace irradiff {

/// Appends the shortest decimal text that reads back to the same double. Requires a finite value.
inline void appendNumber(std::string& text, double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  text.append(buffer.data(), result.ptr);
}

/// Appends a point or direction as a JSON array.
inline void appendPoint(std::string& text, const Eigen::Vector3d& point) {
  text += '[';
  for (int i = 0; i < 3; ++i) {
    text += i > 0 ? "," : "";
    appendNumber(text, point(i));
  }
  text += ']';
}

}  // namespace irradiff
