#pragma once

#include "verification/report/accuracy_report.h"

#include <string>

namespace irradiff {

// The report's tables for other programs. CSV as in RFC 4180, first line the column names; numbers read back to the
// same double, "inf" and "nan" as such. JSON: the same rows as objects; a number that is infinite or not a number is
// null.

/// formula, promised, quantity, check, family, inputs, peak, rms, tolerance, passed, rule, worst_input, expected,
/// actual
std::string verdictsCsv(const AccuracyReport& report);
std::string verdictsJson(const AccuracyReport& report);

/// sweep, formula, quantity, size, median, peak, bound
std::string sweepsCsv(const AccuracyReport& report);
std::string sweepsJson(const AccuracyReport& report);

/// equation, subject, quantity, oracle, inputs, printed_smallest, printed_largest, corrected_largest, allowance,
/// confirmed
std::string errataCsv(const AccuracyReport& report);
std::string errataJson(const AccuracyReport& report);

/// family, apparent_vertices, from, to, scenes: the number of scenes whose gap-filled Hessian is off by from <= error <
/// to, max|dH|/max|H|; one row of scenes without apparent vertices, whose error is 0, for each family.
std::string gapFillingCsv(const AccuracyReport& report);
std::string gapFillingJson(const AccuracyReport& report);

/// evaluator, inputs ("polygons", "scenes" or "segments"), family, quantity, values, exact, unbounded, least, median,
/// percentile_99, largest: reported bound over actual error
std::string boundTightnessCsv(const AccuracyReport& report);
std::string boundTightnessJson(const AccuracyReport& report);

}  // namespace irradiff
