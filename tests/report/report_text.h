#pragma once

#include <string>
#include <vector>

namespace irradiff {

/// The first tag of an HTML page that is not closed, or closed without having been opened, with where it stands; empty
/// if every tag is balanced. Also finds a '<' that begins no tag and a quote that is not closed.
std::string unbalancedTag(const std::string& html);

/// The cells of a CSV text as in RFC 4180. Throws std::invalid_argument for a quote that is not closed.
std::vector<std::vector<std::string>> parseCsv(const std::string& text);

}  // namespace irradiff
