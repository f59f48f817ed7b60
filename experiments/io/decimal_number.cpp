#include "experiments/io/decimal_number.h"

#include <nlohmann/json.hpp>

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <system_error>

namespace irradiff {

double decimalNumber(std::string_view word) {
  std::string_view digits = word;
  // What from_chars leaves to its caller, but for "+-1".
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_whole_word = end == digits.data() + digits.size();
  if (error == std::errc::result_out_of_range && is_whole_word) {
    throw std::invalid_argument("number out of range: " + quotedText(word) + ", must fit in a double");
  }
  // "nan" and "inf" are numbers to from_chars.
  if (error != std::errc() || !is_whole_word || !std::isfinite(value)) {
    throw std::invalid_argument("expected a finite number, got " + quotedText(word));
  }
  return value;
}

std::string quotedText(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string shown(text.substr(0, kLongest));
  if (text.size() > kLongest) shown += "...";
  return nlohmann::json(shown).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

}  // namespace irradiff
