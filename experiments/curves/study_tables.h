#pragma once

#include "experiments/curves/metric_study.h"
#include "verification/report/result_table.h"

namespace irradiff {

/// A row for each scene, metric, field and asked count.
ResultTable curveTable(const MetricStudy& study);
ResultTable ablationTable(const MetricStudy& study);
/// A row for each scene and metric: the slope of its RMS error; NaN where it reached fewer than two counts.
ResultTable slopeTable(const MetricStudy& study);
/// A row for each scene, metric and ratio ("radius", "error", "kept").
ResultTable ratioTable(const MetricStudy& study);
/// Figure 1: a row for each scene and metric.
ResultTable orderTable(const MetricStudy& study);
/// Figures 7 to 14: a row for each figure and variant.
ResultTable comparisonTable(const MetricStudy& study);

}  // namespace irradiff
