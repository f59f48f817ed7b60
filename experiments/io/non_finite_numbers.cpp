#include "experiments/io/non_finite_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace irradiff {

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
// Of numerals and of words such as null.
bool isInWord(char c) { return isDigit(c) || isLetter(c) || c == '+' || c == '-' || c == '.'; }

bool isNumeral(std::string_view word) {
  return isDigit(word.front()) || (word.size() > 1 && word.front() == '-' && isDigit(word[1]));
}

// As the parser reads a numeral.
bool overflows(const std::string& numeral) {
  char* end = nullptr;
  return numeral.find_first_not_of("0123456789+-.eE") == std::string::npos &&
         std::isinf(std::strtod(numeral.c_str(), &end)) && *end == '\0';
}

// The byte behind the string that begins at `start`.
std::size_t endOfString(std::string_view text, std::size_t start) {
  std::size_t i = start + 1;
  while (i < text.size() && text[i] != '"') i += text[i] == '\\' ? 2 : 1;
  return std::min(i + 1, text.size());
}

}  // namespace

bool isNonFiniteWord(std::string_view word) {
  if (word.starts_with('+') || word.starts_with('-')) word.remove_prefix(1);
  static constexpr std::array<std::string_view, 3> kSpellings = {"nan", "inf", "infinity"};
  const auto same_letter = [](char a, char b) { return a == (isLetter(b) ? static_cast<char>(b | 0x20) : b); };
  return std::ranges::any_of(
      kSpellings, [&](std::string_view spelling) { return std::ranges::equal(spelling, word, same_letter); });
}

FiniteText withoutNonFiniteNumbers(std::string_view text) {
  FiniteText finite{std::string(text), {}};
  std::size_t numbers = 0;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '"') {
      i = endOfString(text, i);
      continue;
    }
    if (!isInWord(text[i])) {
      ++i;
      continue;
    }
    const auto* const word_end = std::find_if_not(text.begin() + static_cast<std::ptrdiff_t>(i), text.end(), isInWord);
    const std::string word(text.begin() + static_cast<std::ptrdiff_t>(i), word_end);
    const bool is_word = isNonFiniteWord(word);
    if (is_word || isNumeral(word)) {
      if (is_word || overflows(word)) {
        finite.replaced.push_back({numbers, word});
        finite.text.replace(i, word.size(), word.size(), ' ');
        finite.text[i] = '0';
      }
      ++numbers;
    }
    i += word.size();
  }
  return finite;
}

}  // namespace irradiff
