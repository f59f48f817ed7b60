#include "derivatives/form_factor/boundary_form.h"
#include "derivatives/form_factor/pi.h"
#include "verification/checks/oracle.h"
#include "verification/finite_difference/ridders.h"
#include "verification/jets/form_factor_jets.h"

namespace irradiff {
namespace {

struct FormFactorFormula {
  template <class T>
  T operator()(std::span<const Vector3<T>> vertices, const Vector3<T>& position, const Vector3<T>& normal) const {
    return boundaryFormFactor<T>(vertices, position, normal).value;
  }
};

struct GradientFormula {
  template <class T>
  Vector3<T> operator()(std::span<const Vector3<T>> vertices, const Vector3<T>& position,
                        const Vector3<T>& normal) const {
    return boundaryFormFactor<T>(vertices, position, normal).gradient;
  }
};

/// A configuration without rounding.
struct ExactConfiguration {
  std::vector<Vector3<Multiprecision>> vertices;
  Vector3<Multiprecision> position;
  Vector3<Multiprecision> normal;

  explicit ExactConfiguration(const Configuration& c)
      : vertices(withoutRounding(c.polygon.vertices)),
        position(withoutRounding(c.receiver.position)),
        normal(withoutRounding(c.receiver.normal)) {}

  FormFactor<Multiprecision> at(const Vector3<Multiprecision>& x) const {
    return boundaryFormFactor<Multiprecision>(std::span<const Vector3<Multiprecision>>(vertices), x, normal);
  }

  FormFactor<Multiprecision> turnedTo(const Vector3<Multiprecision>& n) const {
    return boundaryFormFactor<Multiprecision>(std::span<const Vector3<Multiprecision>>(vertices), position, n);
  }

  /// The library's own tangential Hessian and rotational gradient, at this precision.
  void addTangentPlane(OracleValue& value) const {
    const ClippedPolygon<Multiprecision> clipped =
        clipAtHorizon<Multiprecision>(std::span<const Vector3<Multiprecision>>(vertices), position, normal);
    const IrradianceDerivatives<Multiprecision> d = boundarySums(polygonBoundary(clipped, normal), normal).derivatives;
    value.tangential_hessian = d.tangential_hessian.value / pi<Multiprecision>();
    value.rotational_gradient = d.rotational_gradient.value / pi<Multiprecision>();
  }

  /// Smallest sine of a vertex's height over the horizon, in absolute value.
  Multiprecision leastHeight() const {
    Multiprecision least = 1;
    for (const Vector3<Multiprecision>& v : vertices) {
      const Vector3<Multiprecision> r = difference(v, position);
      least = std::min<Multiprecision>(least, abs(dot(normal, r)) / norm(r));
    }
    return least;
  }

  /// Smallest distance of the receiver from a vertex.
  Multiprecision nearestVertex() const {
    Multiprecision nearest = -1;
    for (const Vector3<Multiprecision>& v : vertices) {
      const Multiprecision distance = norm(difference(v, position));
      if (nearest < 0 || distance < nearest) {
        nearest = distance;
      }
    }
    return nearest;
  }
};

OracleValue toOracleValue(const FormFactor<Multiprecision>& f) {
  OracleValue value;
  value.form_factor = f.value;
  value.gradient = f.gradient;
  value.hessian = f.hessian;
  return value;
}

Multiprecision maxNorm(const Eigen::Matrix<Multiprecision, Eigen::Dynamic, Eigen::Dynamic>& m) {
  Multiprecision largest = 0;
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    const Multiprecision size = abs(m(i));
    if (size > largest) {
      largest = size;
    }
  }
  return largest;
}

std::optional<OracleValue> differences(const Configuration& configuration) {
  const ExactConfiguration exact(configuration);
  const Vector3<Multiprecision>& x = exact.position;
  // So small a step, compared with the 1e-13 to be checked and the 200 digits carried, that no family's geometry
  // changes within it.
  const Multiprecision step = exact.nearestVertex() * Multiprecision("1e-30");
  const Multiprecision rounding("1e-140");
  OracleValue value;
  value.form_factor = exact.at(x).value;
  Multiprecision gradient_error = 0;
  Multiprecision hessian_error = 0;
  const auto shifted = [&](int i, const Multiprecision& h) {
    Vector3<Multiprecision> y = x;
    y(i) += h;
    return y;
  };
  for (int i = 0; i < 3; ++i) {
    const auto first = riddersDerivative<Multiprecision>(
        [&](const Multiprecision& h) { return exact.at(shifted(i, h)).value; }, step, rounding);
    value.gradient(i) = first.value;
    gradient_error = std::max(gradient_error, first.error);
    for (int j = 0; j <= i; ++j) {
      // A second difference of F alone: the gradient's formula takes no part in the Hessian's check.
      const auto second = riddersDerivative<Multiprecision>(
          [&](const Multiprecision& h) -> Multiprecision {
            const Vector3<Multiprecision> y = shifted(i, h);
            Vector3<Multiprecision> above = y;
            Vector3<Multiprecision> below = y;
            above(j) += step;
            below(j) -= step;
            return (exact.at(above).value - exact.at(below).value) / (2 * step);
          },
          step, rounding / step);
      value.hessian(i, j) = second.value;
      value.hessian(j, i) = second.value;
      hessian_error = std::max(hessian_error, second.error);
    }
  }
  const Eigen::Matrix<Multiprecision, 3, 2> axes = tangentFrame(exact.normal);
  Multiprecision turn_error = 0;
  const Multiprecision turn = exact.leastHeight() * Multiprecision("1e-30");
  for (int k = 0; k < 2; ++k) {
    // omega = h axis: the normal becomes n + h axis x n to first order, and differences see no other.
    const Vector3<Multiprecision> axis = axes.col(k);
    const Vector3<Multiprecision> motion = cross(axis, exact.normal);
    const auto slope = riddersDerivative<Multiprecision>(
        [&](const Multiprecision& h) {
          return exact.turnedTo(Vector3<Multiprecision>(exact.normal + h * motion)).value;
        },
        turn, rounding);
    value.rotational_gradient += slope.value * axis;
    turn_error += slope.error;
  }
  value.rotational_gradient_uncertainty = turn_error.convert_to<double>();
  // The inner difference is not extrapolated: its error is (step/distance)^2 of the Hessian, far below any tolerance in
  // use.
  const Multiprecision inner = Multiprecision("1e-50") * maxNorm(value.hessian);
  value.gradient_uncertainty = gradient_error.convert_to<double>();
  value.hessian_uncertainty = Multiprecision(hessian_error + inner).convert_to<double>();
  value.projectHessian(configuration);
  return value;
}

/// All but F itself.
std::vector<Quantity> derivatives() { return {kQuantities.begin() + 1, kQuantities.end()}; }

}  // namespace

void OracleValue::projectHessian(const Configuration& configuration) {
  tangential_hessian = tangentialHessian<Multiprecision>(hessian, withoutRounding(configuration.receiver.normal)).value;
  // Components of a unit vector add up to at most the root of 3.
  tangential_hessian_uncertainty = 3.0 * hessian_uncertainty;
}

Oracle multiprecisionOracle() {
  return {"multiprecision",
          "rounding; trusts the formula",
          {kQuantities.begin(), kQuantities.end()},
          [](const Configuration& c) {
            const ExactConfiguration exact(c);
            OracleValue value = toOracleValue(exact.at(exact.position));
            exact.addTangentPlane(value);
            return std::optional<OracleValue>(value);
          }};
}

Oracle jetOracle() {
  return {"nested Jets on F", "wrong derivative algebra; trusts F", derivatives(), [](const Configuration& c) {
            const ExactConfiguration exact(c);
            OracleValue value =
                toOracleValue(differentiateTwice(FormFactorFormula{}, exact.vertices, exact.position, exact.normal));
            value.projectHessian(c);
            value.rotational_gradient = cross(
                exact.normal, differentiateByNormal(FormFactorFormula{}, exact.vertices, exact.position, exact.normal));
            return std::optional<OracleValue>(value);
          }};
}

Oracle gradientJetOracle() {
  return {"Jets on the gradient",
          "wrong derivative algebra in the Hessian; trusts the gradient",
          {Quantity::kHessian, Quantity::kTangentialHessian},
          [](const Configuration& c) {
            const ExactConfiguration exact(c);
            OracleValue value;
            value.hessian = differentiateGradient(GradientFormula{}, exact.vertices, exact.position, exact.normal);
            value.projectHessian(c);
            return std::optional<OracleValue>(value);
          }};
}

Oracle differenceOracle() {
  return {"differences at 200 digits", "wrong derivative algebra; trusts F", derivatives(), differences};
}

}  // namespace irradiff
