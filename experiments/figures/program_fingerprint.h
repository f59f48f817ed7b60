#pragma once

#include <string>

namespace irradiff {

/// Tells this program from any other that might compute something else: its version and a hash of its file, where the
/// system says which that is (Linux).
std::string programFingerprint();

}  // namespace irradiff
