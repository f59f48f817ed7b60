#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

namespace irradiff {

/// Rows under named columns, for other programs.
class ResultTable {
 public:
  using Cell = std::variant<std::string, double, std::size_t, bool>;

  explicit ResultTable(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  /// Requires a cell for each column.
  void add(std::vector<Cell> row) { rows_.push_back(std::move(row)); }

  /// CSV as in RFC 4180, first line the column names; numbers read back to the same double.
  std::string csv() const;
  /// An array with an object for each row; NaN is null.
  std::string json() const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace irradiff
