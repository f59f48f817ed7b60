#pragma once

#include <string>
#include <string_view>

namespace irradiff {

/// The double nearest to a decimal number such as "-0.5", "+.5", "2." or "1e-7", which must be all of `word`. Throws
/// std::invalid_argument with the word and the rule where it is none, not finite, or out of the range of double.
double decimalNumber(std::string_view word);

/// A piece of a file as it stands in a message: in quotes, short and ASCII, whatever it is.
std::string quotedText(std::string_view text);

}  // namespace irradiff
