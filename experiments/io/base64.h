#pragma once

#include <string>
#include <string_view>

namespace irradiff {

/// Bytes as the text that data URIs and JavaScript's atob read (RFC 4648, section 4, with padding).
std::string base64(std::string_view bytes);

}  // namespace irradiff
