#pragma once

#include <iosfwd>

namespace irradiff {

/// Measures what each simplification of the production path saves and prints it as text: the time without it over the
/// time with it, as median (smallest .. largest) over rounds in each of which both are measured; then the times that
/// `irradiff inspect` estimates beside those measured, in units of one square that is not hidden.
/// Times of the processor, on one thread.
void printSimplificationSection(std::ostream& out);

}  // namespace irradiff
