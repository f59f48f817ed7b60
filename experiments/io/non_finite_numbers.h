#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace irradiff {

/// A number in JSON text that no double holds.
struct NonFiniteNumber {
  std::size_t ordinal;  ///< among all numbers in the text, from 0
  std::string written;  ///< "NaN", "-Infinity", "1e999"
};

/// The text with a 0 in the place of each of them, padded with blanks: every other byte stays where it is.
struct FiniteText {
  std::string text;
  std::vector<NonFiniteNumber> replaced;
};

/// Whether a word is one of "nan", "inf" and "infinity" in any case and with any sign.
bool isNonFiniteWord(std::string_view word);

/// Finds the numbers that no double holds in what is JSON but for them: nan, inf and infinity in any case and with any
/// sign, as the programs that write them by mistake spell them, and numerals that overflow. Text in quotes is not
/// touched. Time proportional to the length.
FiniteText withoutNonFiniteNumbers(std::string_view text);

}  // namespace irradiff
