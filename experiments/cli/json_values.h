#pragma once

#include "experiments/io/json_text.h"

#include <Eigen/Core>

#include <string>
#include <string_view>

namespace irradiff {

/// A text as a JSON string in ASCII; U+FFFD where it is no UTF-8.
std::string jsonString(std::string_view text);

/// A vector as a JSON array and a matrix as one of its rows, whose numbers read back to the same doubles. Throw
/// std::domain_error naming `field` for a number that is not finite.
template <int Size>
std::string jsonVector(const Eigen::Matrix<double, Size, 1>& value, std::string_view field) {
  std::string text = "[";
  for (int i = 0; i < Size; ++i) text += (i > 0 ? "," : "") + jsonNumber(value(i), field);
  return text + "]";
}

template <int Size>
std::string jsonMatrix(const Eigen::Matrix<double, Size, Size>& value, std::string_view field) {
  std::string text = "[";
  for (int i = 0; i < Size; ++i) {
    text += (i > 0 ? "," : "") + jsonVector<Size>(value.row(i).transpose(), field);
  }
  return text + "]";
}

}  // namespace irradiff
