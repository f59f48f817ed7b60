#include "tests/report/report_text.h"

#include <cctype>
#include <set>
#include <stdexcept>

namespace irradiff {
namespace {

const std::set<std::string>& voidElements() {
  static const std::set<std::string> names = {"meta", "br", "link", "img", "input", "hr"};
  return names;
}

std::string context(const std::string& html, std::size_t at) { return html.substr(at, 60); }

/// The position of the '>' that ends the tag, outside of quotes; npos if there is none.
std::size_t endOfTag(const std::string& html, std::size_t at) {
  char quote = '\0';
  for (; at < html.size(); ++at) {
    const char c = html[at];
    if (quote != '\0') {
      quote = c == quote ? '\0' : quote;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return at;
    }
  }
  return std::string::npos;
}

}  // namespace

std::string unbalancedTag(const std::string& html) {
  std::vector<std::string> open;
  for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at)) {
    if (html.compare(at, 4, "<!--") == 0) {
      at = html.find("-->", at);
      continue;
    }
    if (html.compare(at, 2, "<!") == 0) {
      ++at;
      continue;
    }
    const std::size_t end = endOfTag(html, at);
    const bool is_closing = html.compare(at, 2, "</") == 0;
    const std::size_t name_begin = at + (is_closing ? 2 : 1);
    std::size_t name_end = name_begin;
    while (name_end < html.size() && std::isalnum(static_cast<unsigned char>(html[name_end])) != 0) {
      ++name_end;
    }
    const std::string name = html.substr(name_begin, name_end - name_begin);
    if (name.empty() || end == std::string::npos) {
      return context(html, at);
    }
    if (is_closing) {
      if (open.empty() || open.back() != name) {
        return context(html, at);
      }
      open.pop_back();
    } else if (html[end - 1] != '/' && voidElements().count(name) == 0) {
      open.push_back(name);
      if (name == "style") {
        at = html.find("</style", end);
        continue;
      }
    }
    at = end;
  }
  return open.empty() ? "" : "<" + open.back() + "> is never closed";
}

std::vector<std::vector<std::string>> parseCsv(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> row(1);
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      row.back() += text[++i];
    } else if (c == '"') {
      is_quoted = !is_quoted;
    } else if (!is_quoted && c == ',') {
      row.emplace_back();
    } else if (!is_quoted && c == '\r' && i + 1 < text.size() && text[i + 1] == '\n') {
      ++i;
      rows.push_back(row);
      row.assign(1, "");
    } else {
      row.back() += c;
    }
  }
  if (is_quoted) {
    throw std::invalid_argument("a quote in the CSV is not closed");
  }
  return rows;
}

}  // namespace irradiff
