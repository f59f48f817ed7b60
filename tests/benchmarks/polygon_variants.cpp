#include "tests/benchmarks/polygon_variants.h"

#include "derivatives/form_factor/appendix_form.h"
#include "derivatives/form_factor/boundary_form.h"
#include "derivatives/form_factor/polygon_evaluation.h"

#include <array>
#include <cstddef>

namespace irradiff {

namespace {

constexpr std::size_t kMostEdges = 16;

template <VertexAngle kAngle>
FormFactor<double> appendix(const Polygon& polygon, const Receiver& receiver) {
  // No heap, as a renderer would have it.
  std::array<Vector3<double>, kMostEdges> relative;
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) relative[i] = polygon.vertices[i] - receiver.position;
  return appendixFormFactor<double>(std::span<const Vector3<double>>(relative.data(), polygon.vertices.size()),
                                    receiver.normal, kAngle);
}

template <class WideScalar>
FormFactor<double> boundary(const Polygon& polygon, const Receiver& receiver) {
  return boundaryFormFactor<double, WideScalar>(std::span<const Vector3<double>>(polygon.vertices), receiver.position,
                                                receiver.normal);
}

FormFactor<double> production(const Polygon& polygon, const Receiver& receiver) {
  const IrradianceDerivatives<double> d = evaluatePolygon(polygon, 0, receiver).derivatives;
  return {d.irradiance.value, d.gradient.value, d.hessian.value};
}

template <FormFactor<double> (*kEvaluate)(const Polygon&, const Receiver&)>
void batch(std::span<const Polygon> polygons, const Receiver& receiver, std::span<FormFactor<double>> results) {
  for (std::size_t i = 0; i < polygons.size(); ++i) results[i] = kEvaluate(polygons[i], receiver);
}

template <FormFactor<double> (*kEvaluate)(const Polygon&, const Receiver&)>
PolygonVariant variant(const char* name, SourceSize size) {
  return {name, size, kEvaluate, batch<kEvaluate>};
}

}  // namespace

std::vector<PolygonVariant> polygonVariants() {
  return {variant<appendix<VertexAngle::kArccos>>("appendix form, acos", SourceSize::kLarge),
          variant<appendix<VertexAngle::kArctangent>>("appendix form, atan2", SourceSize::kLarge),
          variant<boundary<double>>("boundary form, uncompensated", SourceSize::kLarge),
          variant<boundary<DoubleWord<double>>>("boundary form, compensated", SourceSize::kLarge),
          variant<production>("evaluatePolygon, boundary rule", SourceSize::kLarge),
          variant<production>("evaluatePolygon, area rule", SourceSize::kSmall)};
}

}  // namespace irradiff
