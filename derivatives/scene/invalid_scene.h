#pragma once

#include <stdexcept>

namespace irradiff {

/// A scene, or a receiver in it, that has no well-defined irradiance. The message names the thing (with its index), its
/// value and the rule it breaks.
class InvalidScene : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

}  // namespace irradiff
