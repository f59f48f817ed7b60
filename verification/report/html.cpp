#include "verification/report/html.h"

#include <regex>
#include <stdexcept>

namespace irradiff {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string element(std::string_view name, std::string_view content, std::string_view attributes) {
  std::string result = "<";
  result += name;
  if (!attributes.empty()) {
    result += ' ';
    result += attributes;
  }
  result += '>';
  result += content;
  result += "</";
  result += name;
  result += '>';
  return result;
}

std::string inlineSvg(const std::string& svg, const std::string& prefix, const std::string& title) {
  const std::size_t begin = svg.find("<svg");
  const std::size_t end = svg.find('>', begin);
  if (begin == std::string::npos || end == std::string::npos) {
    throw std::runtime_error("the plot '" + prefix + "' is not an SVG document");
  }
  std::string head = svg.substr(begin, end - begin);
  // A page names no namespaces; its parser knows them.
  head = std::regex_replace(head, std::regex(R"re(\s+xmlns(:\w+)?="[^"]*")re"), "");
  std::string body = svg.substr(end);
  body = std::regex_replace(body, std::regex(R"re((\sid=)(["'])([^"']+)\2)re"), "$1\"" + prefix + "-$3\"");
  body = std::regex_replace(body, std::regex(R"re(href=(["'])#([^"']+)\1)re"), "href=\"#" + prefix + "-$2\"");
  body = std::regex_replace(body, std::regex(R"re(url\(#([^)]+)\))re"), "url(#" + prefix + "-$1)");
  body = std::regex_replace(body, std::regex(R"re(<title>[^<]*</title>)re"), element("title", escaped(title)));
  return head + " role=\"img\" aria-label=\"" + escaped(title) + "\"" + body;
}

}  // namespace irradiff
