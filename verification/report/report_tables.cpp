#include "verification/report/report_tables.h"

#include "verification/report/result_table.h"

#include <cmath>
#include <limits>

namespace irradiff {
namespace {

ResultTable verdictTable(const AccuracyReport& report) {
  ResultTable table({"formula", "promised", "quantity", "check", "family", "inputs", "peak", "rms", "tolerance",
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

ResultTable sweepTable(const AccuracyReport& report) {
  ResultTable table({"sweep", "formula", "quantity", "size", "median", "peak", "bound"});
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

ResultTable errataTable(const AccuracyReport& report) {
  ResultTable table({"equation", "subject", "quantity", "oracle", "inputs", "printed_smallest", "printed_largest",
                     "corrected_largest", "allowance", "confirmed"});
  for (const Erratum& erratum : report.errata) {
    for (const ErratumMeasurement& m : erratum.measurements) {
      table.add({erratum.equation, erratum.subject, m.quantity, m.oracle, m.inputs, m.printed_smallest,
                 m.printed_largest, m.corrected_largest, m.allowance, m.isConfirmed()});
    }
  }
  return table;
}

ResultTable gapFillingTable(const AccuracyReport& report) {
  ResultTable table({"family", "apparent_vertices", "from", "to", "scenes"});
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

ResultTable boundTightnessTable(const AccuracyReport& report) {
  ResultTable table({"evaluator", "inputs", "family", "quantity", "values", "exact", "unbounded", "least", "median",
                     "percentile_99", "largest"});
  for (const BoundTightness& t : report.tightness) {
    table.add({t.evaluator, std::string(nameOf(t.inputs)), t.family, std::string(nameOf(t.quantity)), t.values, t.exact,
               t.unbounded, t.least, t.median, t.percentile_99, t.largest});
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
std::string boundTightnessCsv(const AccuracyReport& report) { return boundTightnessTable(report).csv(); }
std::string boundTightnessJson(const AccuracyReport& report) { return boundTightnessTable(report).json(); }

}  // namespace irradiff
