#pragma once

#include "experiments/cache/record_field.h"
#include "experiments/curves/metric_study.h"

#include <cstddef>
#include <string>
#include <vector>

namespace irradiff::curves_test {

/// The bumps of tests/cache/synthetic_field.h under the names of metrics: "bounded-split-sphere" has circles of the
/// threshold, "occlusion-hessian" ellipses of the Hessian, "oracle" the same with twice the half-axes for the same
/// threshold. The true error is integrated over the ellipse on a grid of polar cells.
RecordField studyField(std::size_t width);

/// The same with all published metrics: split spheres are circles, all Hessians the same.
RecordField publishedField(std::size_t width);

/// Curves of rms = factor * records^power at some counts, on some fields of which each is 1 + spread * field times as
/// wrong.
struct PowerLaw {
  std::string metric;
  double factor;
  double power;
};
ErrorCurves powerCurves(const std::vector<PowerLaw>& laws, const std::vector<std::size_t>& counts,
                        std::size_t fields = 1, double spread = 0.0);

/// The five published metrics with the RMS errors of Figure 1, `reprojection` and `oracle`, at 1700 records and others.
ErrorCurves publishedCurves();

/// A scene with these curves, without pictures.
SceneStudy sceneOf(const ErrorCurves& curves);

}  // namespace irradiff::curves_test
