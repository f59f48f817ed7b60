#include "verification/report/result_table.h"

#include "derivatives/scene/number_text.h"

#include <nlohmann/json.hpp>

namespace irradiff {
namespace {

std::string textOf(const ResultTable::Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) {
    return *text;
  }
  if (const auto* number = std::get_if<double>(&cell)) {
    return numberText(*number);
  }
  if (const auto* count = std::get_if<std::size_t>(&cell)) {
    return std::to_string(*count);
  }
  return std::get<bool>(cell) ? "true" : "false";
}

void appendLine(std::string& text, const std::vector<std::string>& cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    text += i > 0 ? "," : "";
    if (cells[i].find_first_of(",\"\r\n") == std::string::npos) {
      text += cells[i];
      continue;
    }
    text += '"';
    for (const char c : cells[i]) {
      text += c == '"' ? "\"\"" : std::string(1, c);
    }
    text += '"';
  }
  text += "\r\n";
}

}  // namespace

std::string ResultTable::csv() const {
  std::string text;
  appendLine(text, columns_);
  for (const std::vector<Cell>& row : rows_) {
    std::vector<std::string> cells;
    for (const Cell& cell : row) {
      cells.push_back(textOf(cell));
    }
    appendLine(text, cells);
  }
  return text;
}

std::string ResultTable::json() const {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const std::vector<Cell>& row : rows_) {
    nlohmann::ordered_json object;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      std::visit([&](const auto& value) { object[columns_[i]] = value; }, row.at(i));
    }
    rows.push_back(std::move(object));
  }
  return rows.dump(1) + '\n';
}

}  // namespace irradiff
