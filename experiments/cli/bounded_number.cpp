#include "experiments/cli/bounded_number.h"

#include <sstream>
#include <string>

namespace irradiff {

CLI::Validator boundedNumber(double least, double most) {
  return CLI::Validator(
      [least, most](const std::string& given) {
        double value = 0.0;
        if (CLI::detail::lexical_cast(given, value) && value >= least && value <= most) return std::string();
        std::ostringstream message;
        message << '"' << given << "\" must be a number from " << least << " to " << most;
        return message.str();
      },
      "");
}

}  // namespace irradiff
