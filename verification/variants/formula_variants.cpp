#include "verification/variants/formula_variants.h"

#include "derivatives/form_factor/appendix_form.h"
#include "derivatives/form_factor/boundary_form.h"
#include "derivatives/form_factor/polygon_evaluation.h"
#include "derivatives/scene/invalid_scene.h"
#include "verification/certified/certified_polygon.h"
#include "verification/variants/area_quadrature.h"
#include "verification/variants/boundary_closed_form.h"
#include "verification/variants/boundary_quadrature.h"

#include <array>
#include <limits>

namespace irradiff {
namespace {

/// A polygon's vertices in another scalar; without the heap for as many as polygons usually have.
template <class Scalar>
class ConvertedVertices {
 public:
  explicit ConvertedVertices(const Polygon& polygon) : count_(polygon.vertices.size()) {
    if (count_ > few_.size()) many_.resize(count_);
    Vector3<Scalar>* const out = data();
    for (std::size_t i = 0; i < count_; ++i) out[i] = polygon.vertices[i].template cast<Scalar>();
  }

  void subtract(const Vector3<Scalar>& position) {
    for (std::size_t i = 0; i < count_; ++i) data()[i] -= position;
  }
  std::span<const Vector3<Scalar>> all() { return {data(), count_}; }

 private:
  Vector3<Scalar>* data() { return count_ > few_.size() ? many_.data() : few_.data(); }

  std::size_t count_;
  std::array<Vector3<Scalar>, 8> few_;
  std::vector<Vector3<Scalar>> many_;
};

template <class Scalar>
FormFactor<long double> widened(const FormFactor<Scalar>& f) {
  return {f.value, f.gradient.template cast<long double>(), f.hessian.template cast<long double>()};
}

template <class Scalar, VertexAngle kAngle>
FormFactor<long double> appendix(const Polygon& polygon, const Receiver& receiver) {
  ConvertedVertices<Scalar> relative(polygon);
  relative.subtract(receiver.position.cast<Scalar>());
  return widened(appendixFormFactor<Scalar>(relative.all(), receiver.normal.cast<Scalar>(), kAngle));
}

template <class Scalar>
FormFactor<long double> appendixWithAcos(const Polygon& polygon, const Receiver& receiver) {
  return appendix<Scalar, VertexAngle::kArccos>(polygon, receiver);
}

template <class Scalar>
FormFactor<long double> appendixWithAtan2(const Polygon& polygon, const Receiver& receiver) {
  return appendix<Scalar, VertexAngle::kArctangent>(polygon, receiver);
}

template <class Scalar>
FormFactor<long double> boundaryClosedForm(const Polygon& polygon, const Receiver& receiver) {
  ConvertedVertices<Scalar> vertices(polygon);
  return widened(sumOverEdges<Scalar>(vertices.all(), receiver.position.cast<Scalar>(), receiver.normal.cast<Scalar>(),
                                      closedAngleIntegrals<Scalar>));
}

template <class Scalar>
FormFactor<long double> boundaryEndpointWeights(const Polygon& polygon, const Receiver& receiver) {
  ConvertedVertices<Scalar> vertices(polygon);
  return widened(boundaryFormFactor<Scalar, Scalar>(vertices.all(), receiver.position.cast<Scalar>(),
                                                    receiver.normal.cast<Scalar>()));
}

template <class Scalar>
FormFactor<long double> boundaryQuadrature(const Polygon& polygon, const Receiver& receiver) {
  ConvertedVertices<Scalar> vertices(polygon);
  return widened(sumOverEdges<Scalar>(vertices.all(), receiver.position.cast<Scalar>(), receiver.normal.cast<Scalar>(),
                                      gaussAngleIntegrals<Scalar>));
}

template <class Scalar>
FormFactor<long double> areaRuleAlone(const Polygon& polygon, const Receiver& receiver) {
  ConvertedVertices<Scalar> vertices(polygon);
  return widened(
      areaQuadrature<Scalar>(vertices.all(), receiver.position.cast<Scalar>(), receiver.normal.cast<Scalar>()));
}

/// Signed F and its derivatives, from irradiance seen from either side; NaN where `evaluate` refuses.
template <class Evaluate>
FormFactor<long double> signedFormFactor(const Evaluate& evaluate) {
  try {
    const PolygonEvaluation evaluation = evaluate();
    const IrradianceDerivatives<double>& d = evaluation.derivatives;
    const long double unit = (evaluation.is_clockwise ? 1.0L : -1.0L) / pi<long double>();
    return {unit * static_cast<long double>(d.irradiance.value), unit * d.gradient.value.cast<long double>(),
            unit * d.hessian.value.cast<long double>()};
  } catch (const InvalidScene&) {
    constexpr long double kNone = std::numeric_limits<long double>::quiet_NaN();
    return {kNone, Vector3<long double>::Constant(kNone), Matrix3<long double>::Constant(kNone)};
  }
}

FormFactor<long double> production(const Polygon& polygon, const Receiver& receiver) {
  return signedFormFactor([&] { return evaluatePolygon(polygon, 0, receiver); });
}

FormFactor<long double> certified(const Polygon& polygon, const Receiver& receiver) {
  return signedFormFactor([&] { return certifyPolygon(polygon, 0, receiver, kDefaultTolerance).evaluation; });
}

}  // namespace

const char* nameOf(ScalarType scalar) {
  switch (scalar) {
    case ScalarType::kFloat:
      return "float";
    case ScalarType::kDouble:
      return "double";
    default:
      return "long double";
  }
}

const std::vector<FormulaVariant>& formulaVariants() {
  static const std::vector<FormulaVariant> variants = [] {
    std::vector<FormulaVariant> all;
    const auto add = [&all](const char* formula, auto in_double, auto in_float, auto in_long_double) {
      all.push_back({formula, ScalarType::kDouble, in_double});
      all.push_back({formula, ScalarType::kFloat, in_float});
      all.push_back({formula, ScalarType::kLongDouble, in_long_double});
    };
    add("appendix, acos", appendixWithAcos<double>, appendixWithAcos<float>, appendixWithAcos<long double>);
    add("appendix, atan2", appendixWithAtan2<double>, appendixWithAtan2<float>, appendixWithAtan2<long double>);
    add("boundary, closed form", boundaryClosedForm<double>, boundaryClosedForm<float>,
        boundaryClosedForm<long double>);
    add("boundary, endpoint weights", boundaryEndpointWeights<double>, boundaryEndpointWeights<float>,
        boundaryEndpointWeights<long double>);
    add("boundary, quadrature", boundaryQuadrature<double>, boundaryQuadrature<float>, boundaryQuadrature<long double>);
    add("area rule", areaRuleAlone<double>, areaRuleAlone<float>, areaRuleAlone<long double>);
    all.push_back({"evaluatePolygon", ScalarType::kDouble, production});
    all.push_back({"certified", ScalarType::kDouble, certified});
    return all;
  }();
  return variants;
}

}  // namespace irradiff
