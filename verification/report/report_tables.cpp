#include "verification/report/report_tables.h"

#include "derivatives/scene/number_text.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <variant>

namespace irradiff {
namespace {

using Cell = std::variant<std::string, double, std::size_t, bool>;

/// Rows under named columns, and how to write them.
class Table {
 public:
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  void add(std::vector<Cell> row) { rows_.push_back(std::move(row)); }

  std::string csv() const {
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

  std::string json() const {
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

 private:
  static std::string textOf(const Cell& cell) {
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

  static void appendLine(std::string& text, const std::vector<std::string>& cells) {
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

  std::vector<std::string> columns_;
  std::vector<std::vector<Cell>> rows_;
};

Table verdictTable(const AccuracyReport& report) {
  Table table({"formula", "promised", "quantity", "check", "family", "inputs", "peak", "rms", "tolerance",
               "uncertainty", "passed", "rule", "worst_input", "expected", "actual"});
  for (const FormulaResults& formula : report.formulas) {
    const auto add = [&](const Verdict& v, bool is_promised) {
      table.add({formula.name, is_promised, std::string(nameOf(v.quantity)), v.check, v.family, v.inputs, v.peak, v.rms,
                 v.tolerance, v.uncertainty, v.passed, v.rule, v.worst_input, v.expected, v.actual});
    };
    for (const Verdict& verdict : formula.verdicts) {
      add(verdict, formula.is_promised);
    }
    for (const Verdict& verdict : formula.unjudged) {
      add(verdict, false);
    }
  }
  return table;
}

Table sweepTable(const AccuracyReport& report) {
  Table table({"sweep", "formula", "quantity", "size", "median", "peak", "bound"});
  for (const ErrorSweep& sweep : report.sweeps) {
    for (const SweepCurve& curve : sweep.curves) {
      for (const SweepPoint& p : curve.points) {
        table.add({sweep.inputs->name, curve.formula, std::string(nameOf(curve.quantity)), p.size, p.median, p.peak,
                   p.bound});
      }
    }
  }
  return table;
}

Table errataTable(const AccuracyReport& report) {
  Table table({"equation", "subject", "quantity", "oracle", "inputs", "printed_smallest", "printed_largest",
               "corrected_largest", "allowance", "confirmed"});
  for (const Erratum& erratum : report.errata) {
    for (const ErratumMeasurement& m : erratum.measurements) {
      table.add({erratum.equation, erratum.subject, m.quantity, m.oracle, m.inputs, m.printed_smallest,
                 m.printed_largest, m.corrected_largest, m.allowance, m.isConfirmed()});
    }
  }
  return table;
}

Table gapFillingTable(const AccuracyReport& report) {
  Table table({"family", "apparent_vertices", "from", "to", "scenes"});
  for (const GapFillingLosses& losses : report.gap_filling) {
    table.add({losses.family, false, 0.0, 0.0, losses.losses.without_vertices});
    const ErrorHistogram histogram = histogramOf(losses.losses.errors);
    for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
      const bool is_last = i + 1 == histogram.counts.size();
      table.add({losses.family, true, i == 0 ? 0.0 : std::pow(10.0, ErrorHistogram::decadeOf(i)),
                 is_last ? std::numeric_limits<double>::infinity() : std::pow(10.0, ErrorHistogram::decadeOf(i + 1)),
                 histogram.counts[i]});
    }
  }
  return table;
}

}  // namespace

std::string verdictsCsv(const AccuracyReport& report) { return verdictTable(report).csv(); }
std::string verdictsJson(const AccuracyReport& report) { return verdictTable(report).json(); }
std::string sweepsCsv(const AccuracyReport& report) { return sweepTable(report).csv(); }
std::string sweepsJson(const AccuracyReport& report) { return sweepTable(report).json(); }
std::string errataCsv(const AccuracyReport& report) { return errataTable(report).csv(); }
std::string errataJson(const AccuracyReport& report) { return errataTable(report).json(); }
std::string gapFillingCsv(const AccuracyReport& report) { return gapFillingTable(report).csv(); }
std::string gapFillingJson(const AccuracyReport& report) { return gapFillingTable(report).json(); }

}  // namespace irradiff
