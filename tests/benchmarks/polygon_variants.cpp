#include "tests/benchmarks/polygon_variants.h"

#include "derivatives/form_factor/boundary_form.h"
#include "verification/variants/formula_variants.h"

#include <span>

namespace irradiff {

namespace {

/// The formula of the library without its safeguards: r x e in doubled precision.
FormFactor<long double> compensatedBoundary(const Polygon& polygon, const Receiver& receiver) {
  const FormFactor<double> f = boundaryFormFactor<double>(std::span<const Vector3<double>>(polygon.vertices),
                                                          receiver.position, receiver.normal);
  return {f.value, f.gradient.cast<long double>(), f.hessian.cast<long double>()};
}

}  // namespace

std::vector<PolygonVariant> polygonVariants() {
  std::vector<PolygonVariant> variants;
  for (const FormulaVariant& variant : formulaVariants()) {
    if (variant.scalar != ScalarType::kDouble) continue;
    if (variant.formula == "evaluatePolygon") {
      variants.push_back({"boundary, compensated", SourceSize::kLarge, compensatedBoundary});
      variants.push_back({"evaluatePolygon, boundary rule", SourceSize::kLarge, variant.evaluate});
      variants.push_back({"evaluatePolygon, area rule", SourceSize::kSmall, variant.evaluate});
    } else {
      const bool is_for_small = variant.formula == "area rule";
      variants.push_back({variant.formula, is_for_small ? SourceSize::kSmall : SourceSize::kLarge, variant.evaluate});
    }
  }
  return variants;
}

}  // namespace irradiff
