#include "derivatives/form_factor/appendix_evaluation.h"

#include "derivatives/boundary/edge_arcs.h"
#include "derivatives/boundary/edge_kernel.h"
#include "derivatives/form_factor/appendix_form.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

namespace irradiff {
namespace {

using PlainClippedPolygon = ClippedPolygon<double, double>;

/// Half the sum of Gamma_i of Eq. (19), horizon edges included: for the rotational gradient, which the paper has not.
Vector3<double> vectorIrradiance(const std::vector<Vector3<double>>& relative) {
  Vector3<double> sum = Vector3<double>::Zero();
  for (std::size_t i = 0; i < relative.size(); ++i) {
    const Vector3<double>& r = relative[i];
    const Vector3<double>& r_next = relative[(i + 1) % relative.size()];
    sum += 0.5 * appendixIntegrals(r, r_next, VertexAngle::kArctangent).I1 * cross(r, r_next);
  }
  return sum;
}

/// What the closing edges along the horizon add to the Hessian while they count as fixed edges.
Matrix3<double> horizonEdgeTerms(const PlainClippedPolygon& clipped, const Vector3<double>& normal) {
  std::vector<BoundaryArc<double>> arcs;
  for (std::size_t i = 0; i < clipped.vertices.size(); ++i) {
    const ClippedVertex<double, double>& start = clipped.vertices[i];
    const ClippedVertex<double, double>& end = clipped.vertices[(i + 1) % clipped.vertices.size()];
    if (start.height == 0.0 && end.height == 0.0) {
      appendEdgeArcs(start, end, normal, 1.0, arcs);
    }
  }
  Matrix3<double> sum = Matrix3<double>::Zero();
  for (const BoundaryArc<double>& arc : arcs) {
    const Matrix3<double> terms = arcTerms(arc, normal).hessian;
    sum += 0.5 * (terms + terms.transpose());
  }
  return sum;
}

IrradianceDerivatives<double> appendixDerivatives(const PlainClippedPolygon& clipped, const Vector3<double>& normal,
                                                  double sign) {
  std::vector<Vector3<double>> relative;
  relative.reserve(clipped.vertices.size());
  for (const ClippedVertex<double, double>& vertex : clipped.vertices) {
    relative.push_back(vertex.position);
  }
  const FormFactor<double> form_factor =
      appendixFormFactor<double>(std::span<const Vector3<double>>(relative), normal, VertexAngle::kArctangent);
  const double factor = sign * std::numbers::pi;
  const Matrix3<double> hessian = factor * form_factor.hessian - sign * horizonEdgeTerms(clipped, normal);
  return {{factor * form_factor.value},
          {factor * form_factor.gradient},
          {hessian},
          tangentialHessian(hessian, normal),
          {sign * cross(normal, vectorIrradiance(relative))}};
}

/// Largest difference of two entries; infinite if one of them is not finite.
template <class Value>
double distance(const Value& a, const Value& b) {
  return a.allFinite() && (a - b).allFinite() ? (a - b).cwiseAbs().maxCoeff() : std::numeric_limits<double>::infinity();
}

/// Bound of a value's error from its distance to a reference with a bound of its own.
double measuredBound(double distance, double reference_bound) {
  // Rounded once in the difference and once in the sum.
  constexpr double kRounding = 1.0 + 4.0 * 0x1p-53;
  return kRounding * (distance + reference_bound);
}

}  // namespace

AppendixEvaluation evaluateAppendix(const Polygon& polygon, std::size_t index, const Receiver& receiver) {
  const PolygonEvaluation boundary = evaluatePolygon(polygon, index, receiver);
  AppendixEvaluation appendix{boundary, {}, boundary.no_gradient};
  if (boundary.rule != PolygonRule::kBoundary && boundary.rule != PolygonRule::kArea) {
    return appendix;
  }
  const PlainClippedPolygon clipped = clipAtHorizon<double, double>(std::span<const Vector3<double>>(polygon.vertices),
                                                                    receiver.position, receiver.normal);
  IrradianceDerivatives<double>& values = appendix.derivatives;
  values = appendixDerivatives(clipped, receiver.normal, boundary.is_clockwise ? 1.0 : -1.0);

  const std::string not_finite =
      "polygons[" + std::to_string(index) + "] \"" + polygon.name +
      "\": the appendix form has no finite value here: it divides by squares that vanish or exceed the range of double";
  const IrradianceDerivatives<double>& reference = boundary.derivatives;
  DerivativeBounds& bounds = appendix.bounds;
  bounds.irradiance = measuredBound(std::abs(values.irradiance.value - reference.irradiance.value), bounds.irradiance);
  bounds.gradient = measuredBound(distance(values.gradient.value, reference.gradient.value), bounds.gradient);
  bounds.hessian = measuredBound(distance(values.hessian.value, reference.hessian.value), bounds.hessian);
  bounds.tangential_hessian = measuredBound(
      distance(values.tangential_hessian.value, reference.tangential_hessian.value), bounds.tangential_hessian);
  bounds.rotational_gradient = measuredBound(
      distance(values.rotational_gradient.value, reference.rotational_gradient.value), bounds.rotational_gradient);
  if (!std::isfinite(bounds.irradiance) || !std::isfinite(bounds.rotational_gradient)) {
    appendix.no_irradiance = not_finite;
    values.irradiance.value = 0.0;
    values.rotational_gradient.value.setZero();
    bounds.irradiance = 0.0;
    bounds.rotational_gradient = 0.0;
  }
  if (!std::isfinite(bounds.gradient)) {
    appendix.no_gradient = not_finite;
    values.gradient.value.setZero();
    bounds.gradient = 0.0;
  }
  if (!std::isfinite(bounds.hessian) || !std::isfinite(bounds.tangential_hessian)) {
    appendix.no_hessian = not_finite;
    appendix.no_tangential_hessian = not_finite;
    values.hessian.value.setZero();
    values.tangential_hessian.value.setZero();
    bounds.hessian = 0.0;
    bounds.tangential_hessian = 0.0;
  }
  return appendix;
}

}  // namespace irradiff
