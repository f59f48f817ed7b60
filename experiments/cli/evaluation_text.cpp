#include "experiments/cli/evaluation_text.h"

#include "experiments/cli/json_values.h"
#include "experiments/io/json_text.h"

#include <array>
#include <string>

namespace irradiff {

namespace {

/// The text of a quantity that has a value, or null.
template <class MakeText>
std::string unlessMissing(const std::string& reason, MakeText makeText) {
  return reason.empty() ? makeText() : "null";
}

std::string boundText(const std::string& reason, double bound, std::string_view field) {
  return unlessMissing(reason, [&] { return jsonNumber(bound, field); });
}

/// The different reasons why something is null, one after the other.
template <int Dimension>
std::string joinReasons(const SceneEvaluation<Dimension>& evaluation) {
  std::string joined;
  for (const std::string* reason : {&evaluation.no_irradiance, &evaluation.no_gradient, &evaluation.no_hessian,
                                    &evaluation.no_tangential_hessian}) {
    if (joined.find(*reason) == std::string::npos) joined += (joined.empty() ? "" : "; ") + *reason;
  }
  return joined;
}

std::string countsText(const SourceCounts& counts) {
  return "{\"area_rule\":" + std::to_string(counts.area_rule) + ",\"boundary\":" + std::to_string(counts.boundary) +
         ",\"partly_hidden\":" + std::to_string(counts.partly_hidden) + ",\"black\":" + std::to_string(counts.black) +
         ",\"hidden\":" + std::to_string(counts.hidden) + ",\"edge_on\":" + std::to_string(counts.edge_on) +
         ",\"own_surface\":" + std::to_string(counts.own_surface) +
         ",\"below_horizon\":" + std::to_string(counts.below_horizon) + "}";
}

template <int Dimension>
std::string modelOf(const SceneEvaluation<Dimension>& evaluation, std::string_view precision,
                    const std::string& further) {
  std::string text = std::string("{\"occlusion\":") + (evaluation.has_occlusion ? "true" : "false") +
                     ",\"horizon\":" + (evaluation.crosses_horizon ? "true" : "false") +
                     ",\"apparent_vertices\":" + std::to_string(evaluation.apparent_vertices) + ",\"precision\":\"";
  text += precision;
  text += '"';
  if (evaluation.sources) {
    text += (Dimension == 3 ? ",\"polygons\":" : ",\"segments\":") + countsText(*evaluation.sources);
  }
  return text + further + '}';
}

template <int Dimension>
void append(const SceneEvaluation<Dimension>& evaluation, std::string_view precision, const FurtherFields& further,
            std::string& text) {
  const IrradianceDerivatives<double, Dimension>& d = evaluation.derivatives;
  const DerivativeBounds& bounds = evaluation.bounds;
  text += "{\"irradiance\":" +
          unlessMissing(evaluation.no_irradiance, [&] { return jsonNumber(d.irradiance.value, "irradiance"); });
  text += ",\"gradient\":" +
          unlessMissing(evaluation.no_gradient, [&] { return jsonVector(d.gradient.value, "gradient"); });
  text +=
      ",\"hessian\":" + unlessMissing(evaluation.no_hessian, [&] { return jsonMatrix(d.hessian.value, "hessian"); });
  text += ",\"tangential_hessian\":" + unlessMissing(evaluation.no_tangential_hessian, [&] {
            return jsonMatrix<Dimension - 1>(d.tangential_hessian.value, "tangential_hessian");
          });
  text += ",\"rotational_gradient\":" + unlessMissing(evaluation.no_irradiance, [&] {
            return jsonVector(d.rotational_gradient.value, "rotational_gradient");
          });
  text += ",\"error_bound\":{\"irradiance\":" +
          boundText(evaluation.no_irradiance, bounds.irradiance, "error_bound: irradiance") +
          ",\"gradient\":" + boundText(evaluation.no_gradient, bounds.gradient, "error_bound: gradient") +
          ",\"hessian\":" + boundText(evaluation.no_hessian, bounds.hessian, "error_bound: hessian") +
          ",\"tangential_hessian\":" +
          boundText(evaluation.no_tangential_hessian, bounds.tangential_hessian, "error_bound: tangential_hessian") +
          ",\"rotational_gradient\":" +
          boundText(evaluation.no_irradiance, bounds.rotational_gradient, "error_bound: rotational_gradient") + "}" +
          further.after_bounds;
  text += ",\"model\":" + modelOf(evaluation, precision, further.in_model);
  if (const std::string reasons = joinReasons(evaluation); !reasons.empty()) {
    text += ",\"reason\":" + jsonString(reasons);
  }
  text += '}';
}

}  // namespace

void appendResult(const SceneEvaluation<3>& evaluation, std::string_view precision, const FurtherFields& further,
                  std::string& text) {
  append(evaluation, precision, further, text);
}

void appendResult(const SceneEvaluation<2>& evaluation, std::string_view precision, const FurtherFields& further,
                  std::string& text) {
  append(evaluation, precision, further, text);
}

std::string modelText(const SceneEvaluation<3>& evaluation, std::string_view precision) {
  return modelOf(evaluation, precision, "");
}

std::string modelText(const SceneEvaluation<2>& evaluation, std::string_view precision) {
  return modelOf(evaluation, precision, "");
}

std::string errorLine(std::string_view message) { return "{\"error\":" + jsonString(message) + "}"; }

}  // namespace irradiff
