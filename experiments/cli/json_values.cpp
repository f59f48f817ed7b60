#include "experiments/cli/json_values.h"

#include <nlohmann/json.hpp>

namespace irradiff {

std::string jsonString(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

}  // namespace irradiff
