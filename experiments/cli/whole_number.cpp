#include "experiments/cli/whole_number.h"

#include <algorithm>
#include <string>

namespace irradiff {

CLI::Validator wholeNumber(unsigned first, unsigned last) {
  return CLI::Validator(
      [first, last](const std::string& given) {
        const bool is_number = !given.empty() && given.size() <= 9 &&
                               std::ranges::all_of(given, [](char c) { return c >= '0' && c <= '9'; });
        const unsigned long value = is_number ? std::stoul(given) : 0;
        return is_number && value >= first && value <= last ? std::string()
                                                            : '"' + given + "\" must be a whole number from " +
                                                                  std::to_string(first) + " to " + std::to_string(last);
      },
      "");
}

}  // namespace irradiff
