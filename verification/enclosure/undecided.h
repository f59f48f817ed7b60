#pragma once

#include <stdexcept>

namespace irradiff {

/// A formula came to a branch that the error bounds of its numbers do not decide: more precision may.
class Undecided : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace irradiff
