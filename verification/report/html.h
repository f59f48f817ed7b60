#pragma once

#include <string>
#include <string_view>

namespace irradiff {

/// Text for an HTML document: & < > " ' as entities, safe in content and in quoted attributes.
std::string escaped(std::string_view text);

/// <name attributes>content</name>; the content is HTML already.
std::string element(std::string_view name, std::string_view content, std::string_view attributes = "");

/// An SVG document as an element of an HTML page: without prologue, its ids made unique by `prefix`.
std::string inlineSvg(const std::string& svg, const std::string& prefix, const std::string& title);

}  // namespace irradiff
