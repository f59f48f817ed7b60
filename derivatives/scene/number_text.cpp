#include "derivatives/scene/number_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace irradiff {

std::string numberText(double value) {
  // to_chars writes the sign bit of a NaN, which says nothing here.
  if (std::isnan(value)) return "nan";
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

std::string pointText(const Eigen::Ref<const Eigen::VectorXd>& point) {
  std::string text = "(";
  for (Eigen::Index i = 0; i < point.size(); ++i) {
    if (i > 0) text += ", ";
    text += numberText(point[i]);
  }
  return text + ")";
}

}  // namespace irradiff
