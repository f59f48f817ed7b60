#include "derivatives/form_factor/appendix_form.h"
#include "verification/checks/input_families.h"
#include "verification/checks/oracle.h"
#include "verification/jets/form_factor_jets.h"
#include "verification/report/defining_integral.h"
#include "verification/report/errata.h"
#include "verification/report/residual_range.h"

#include <algorithm>
#include <utility>

namespace irradiff {
namespace {

using Digits = Multiprecision;
using DynamicDigits = Eigen::Matrix<Digits, Eigen::Dynamic, Eigen::Dynamic>;

std::vector<Vector3<Digits>> relativeVertices(const Configuration& c) {
  std::vector<Vector3<Digits>> relative = withoutRounding(c.polygon.vertices);
  for (Vector3<Digits>& r : relative) {
    r = difference(r, withoutRounding(c.receiver.position));
  }
  return relative;
}

/// max|actual - expected| / max|expected|.
double residual(const DynamicDigits& actual, const DynamicDigits& expected) {
  Digits error = 0;
  Digits norm = 0;
  for (Eigen::Index i = 0; i < expected.size(); ++i) {
    error = std::max<Digits>(error, abs(actual(i) - expected(i)));
    norm = std::max<Digits>(norm, abs(expected(i)));
  }
  return Digits(error / norm).convert_to<double>();
}

DynamicDigits scalar(const Digits& value) { return DynamicDigits::Constant(1, 1, value); }

/// Eq. (19) with Gamma_i = r_i x r_{i+1}, as printed.
Digits printedFormFactor(std::span<const Vector3<Digits>> r, const Vector3<Digits>& n) {
  Digits sum = 0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    sum += dot(n, cross(r[i], r[(i + 1) % r.size()]));
  }
  return sum / (2 * pi<Digits>());
}

/// Eq. (20) as printed. The angle gamma_i in I1 is left to the appendix's integrals.
Vector3<Digits> printedGradient(std::span<const Vector3<Digits>> r, const Vector3<Digits>& n) {
  Vector3<Digits> sum = Vector3<Digits>::Constant(0);
  for (std::size_t i = 0; i < r.size(); ++i) {
    const Vector3<Digits>& next = r[(i + 1) % r.size()];
    const Vector3<Digits> e = difference(next, r[i]);
    const auto k = appendixIntegrals(r[i], next, VertexAngle::kArctangent);
    const Digits twice_height = 2 * dot(n, cross(r[i], next));
    sum += scaled(cross(n, e), k.I1) + scaled(Vector3<Digits>(scaled(r[i], k.I2) + scaled(e, k.J2)), twice_height);
  }
  return scaled(sum, Digits(-1 / (2 * pi<Digits>())));
}

/// Eq. (21) as printed.
Matrix3<Digits> printedHessian(std::span<const Vector3<Digits>> r, const Vector3<Digits>& n) {
  Matrix3<Digits> sum = Matrix3<Digits>::Constant(0);
  for (std::size_t i = 0; i < r.size(); ++i) {
    const Vector3<Digits>& next = r[(i + 1) % r.size()];
    const Vector3<Digits> e = difference(next, r[i]);
    const auto k = appendixIntegrals(r[i], next, VertexAngle::kArctangent);
    const Digits height = dot(n, cross(r[i], e));
    const Matrix3<Digits> line = symmetricProduct(cross(n, e), Vector3<Digits>(scaled(r[i], k.I2) + scaled(e, k.J2)));
    const Matrix3<Digits> rr = symmetricProduct(r[i], r[i]);
    const Matrix3<Digits> ee = symmetricProduct(e, e);
    const Matrix3<Digits> re = symmetricProduct(r[i], e);
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        const Digits inner = rr(a, b) * k.I3 + ee(a, b) * k.K3 + 2 * k.J3 * re(a, b);
        sum(a, b) += line(a, b) - (a == b ? Digits(height * k.I2) : Digits(0)) + 2 * height * inner;
      }
    }
  }
  return sum * Digits(-1 / pi<Digits>());
}

/// Eq. (2) for a polygon of radiance 1 above the horizon, as an integral over its area.
struct IrradianceByDefinition {
  template <class T>
  T operator()(std::span<const Vector3<T>> vertices, const Vector3<T>& position, const Vector3<T>& normal) const {
    std::vector<Eigen::Vector3d> fixed;
    for (const Vector3<T>& v : vertices) {
      fixed.emplace_back(v(0).a.a, v(1).a.a, v(2).a.a);
    }
    return sumOverArea(std::span<const Eigen::Vector3d>(fixed), lift<T>(0.0),
                       [&](const Eigen::Vector3d& point, const Eigen::Vector3d& area) {
                         Vector3<T> p;
                         Vector3<T> dA;
                         for (int i = 0; i < 3; ++i) {
                           p(i) = lift<T>(point(i)) - position(i);
                           dA(i) = lift<T>(area(i));
                         }
                         const T square = dot(p, p);
                         return T(dot(normal, p) * dot(dA, p) / (square * square));
                       });
  }
};

std::vector<Configuration> wellConditionedInputs(std::size_t count, std::uint64_t seed) {
  return drawInputs(inputFamily("well-conditioned"), count, seed);
}

}  // namespace

Erratum measureGammaLength(std::size_t inputs, std::uint64_t seed) {
  const Oracle oracle = enclosureOracle();
  ResidualRange value("form factor", oracle.name, 1e-35);
  // An enclosure takes seconds.
  for (const Configuration& input : wellConditionedInputs(std::min<std::size_t>(inputs, 4), seed)) {
    const OracleValue expected = oracle.evaluate(input).value();
    const std::vector<Vector3<Digits>> r = relativeVertices(input);
    const Vector3<Digits> n = withoutRounding(input.receiver.normal);
    const Digits corrected = appendixFormFactor<Digits>(r, n, VertexAngle::kArctangent).value;
    value.add(residual(scalar(printedFormFactor(r, n)), scalar(expected.form_factor)),
              residual(scalar(corrected), scalar(expected.form_factor)));
  }
  return {"Equation (19)",
          "the length of Gamma",
          "Gamma_i = r_i x r_{i+1}, with norm gamma_i",
          "Gamma_i has the direction of r_i x r_{i+1} and as its length the angle between them",
          "The same angle is gamma_i in I1; with the norm |r_i x r_{i+1}| in its place I1 would be 1 for every edge.",
          {value.measurement()}};
}

Erratum measureOverallSign(std::size_t inputs, std::uint64_t seed) {
  const Oracle oracle = differenceOracle();
  ResidualRange gradient("gradient, (20)", oracle.name, 1e-30);
  ResidualRange hessian("Hessian, (21)", oracle.name, 1e-30);
  for (const Configuration& input : wellConditionedInputs(inputs, seed)) {
    const OracleValue expected = oracle.evaluate(input).value();
    const std::vector<Vector3<Digits>> r = relativeVertices(input);
    const Vector3<Digits> n = withoutRounding(input.receiver.normal);
    const FormFactor<Digits> corrected = appendixFormFactor<Digits>(r, n, VertexAngle::kArctangent);
    gradient.add(residual(printedGradient(r, n), expected.gradient), residual(corrected.gradient, expected.gradient));
    hessian.add(residual(printedHessian(r, n), expected.hessian), residual(corrected.hessian, expected.hessian));
  }
  return {
      "Equations (20) and (21)",
      "the overall sign",
      "grad F = -1/(2 pi) sum (...), hess F = -1/pi sum (...)",
      "grad F = +1/(2 pi) sum (...), hess F = +1/pi sum (...), everything inside the sums as printed",
      "The integrals I2, I3, J2, J3, K3 and the product Q are right as printed: with the sign alone changed nothing "
      "is left.",
      {gradient.measurement(), hessian.measurement()}};
}

Erratum measureFactorPi(std::size_t inputs, std::uint64_t seed) {
  const char* oracle = "Jets on the integral (2), by quadrature";
  ResidualRange value("irradiance, (8)", oracle, 1e-12);
  ResidualRange gradient("gradient, (9)", oracle, 1e-12);
  ResidualRange hessian("Hessian, (10)", oracle, 1e-12);
  const auto widen_matrix = [](const auto& m) { return DynamicDigits(m.template cast<Digits>()); };
  for (const Configuration& input : wellConditionedInputs(inputs, seed)) {
    const FormFactor<double> expected = differentiateTwice<double>(IrradianceByDefinition{}, input.polygon.vertices,
                                                                   input.receiver.position, input.receiver.normal);
    const FormFactor<Digits> f = appendixFormFactor<Digits>(
        relativeVertices(input), withoutRounding(input.receiver.normal), VertexAngle::kArctangent);
    const Digits factor = pi<Digits>();
    value.add(residual(scalar(f.value), scalar(expected.value)),
              residual(scalar(f.value * factor), scalar(expected.value)));
    gradient.add(residual(f.gradient, widen_matrix(expected.gradient)),
                 residual(scaled(f.gradient, factor), widen_matrix(expected.gradient)));
    hessian.add(residual(f.hessian, widen_matrix(expected.hessian)),
                residual(DynamicDigits(f.hessian * factor), widen_matrix(expected.hessian)));
  }
  return {"Equations (8) to (10)",
          "the factor pi",
          "E = sum L F, and likewise for the gradient and the Hessian",
          "E = pi sum L F, grad E = pi sum L grad F, hess E = pi sum L hess F",
          "The factor cancels in the relative error (12), not in the absolute one (5).",
          {value.measurement(), gradient.measurement(), hessian.measurement()}};
}

}  // namespace irradiff
