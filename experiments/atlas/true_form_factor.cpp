#include "experiments/atlas/true_form_factor.h"

#include "derivatives/form_factor/appendix_form.h"
#include "derivatives/form_factor/boundary_form.h"

#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

namespace irradiff {
namespace {

/// How far two formulas at 200 digits may be apart: 160 digits for what their closed forms lose.
constexpr double kAgreement = 1e-40;

const Multiprecision& larger(const Multiprecision& a, const Multiprecision& b) { return a < b ? b : a; }

/// The largest component of `expected` and that of `difference_at(i)`; as a quotient.
template <class Count, class ActualAt, class ExpectedAt>
double relativeError(Count count, const ActualAt& actual_at, const ExpectedAt& expected_at) {
  Multiprecision error = 0;
  Multiprecision size = 0;
  for (Count i = 0; i < count; ++i) {
    const Multiprecision& expected = expected_at(i);
    error = larger(error, abs(Multiprecision(actual_at(i)) - expected));
    size = larger(size, abs(expected));
  }
  return error == 0 ? 0.0 : Multiprecision(error / size).convert_to<double>();
}

template <class Scalar>
AtlasErrors errorsOf(const FormFactor<Scalar>& actual, const FormFactor<Multiprecision>& expected) {
  return {relativeError(
              1, [&](int) -> const Scalar& { return actual.value; },
              [&](int) -> const Multiprecision& { return expected.value; }),
          relativeError(
              3, [&](int i) -> const Scalar& { return actual.gradient(i); },
              [&](int i) -> const Multiprecision& { return expected.gradient(i); }),
          relativeError(
              9, [&](int i) -> const Scalar& { return actual.hessian(i / 3, i % 3); },
              [&](int i) -> const Multiprecision& { return expected.hessian(i / 3, i % 3); })};
}

}  // namespace

FormFactor<Multiprecision> trueFormFactor(const Configuration& input) {
  const std::vector<MultiprecisionVector> vertices = withoutRounding(input.polygon.vertices);
  const MultiprecisionVector position = withoutRounding(input.receiver.position);
  const MultiprecisionVector normal = withoutRounding(input.receiver.normal);
  std::vector<MultiprecisionVector> relative;
  relative.reserve(vertices.size());
  for (const MultiprecisionVector& vertex : vertices) relative.push_back(difference(vertex, position));
  const FormFactor<Multiprecision> boundary =
      boundaryFormFactor<Multiprecision>(std::span<const MultiprecisionVector>(vertices), position, normal);
  const FormFactor<Multiprecision> appendix = appendixFormFactor<Multiprecision>(
      std::span<const MultiprecisionVector>(relative), normal, VertexAngle::kArctangent);
  for (const double difference : errorsOf(appendix, boundary)) {
    if (!(difference <= kAgreement)) {
      throw std::logic_error("the boundary form and the appendix form at 200 digits differ by " +
                             std::to_string(difference) + ", relatively, at " + sceneLine(input));
    }
  }
  return boundary;
}

AtlasErrors relativeErrors(const FormFactor<long double>& actual, const FormFactor<Multiprecision>& expected) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const bool is_finite[] = {std::isfinite(actual.value), actual.gradient.allFinite(), actual.hessian.allFinite()};
  FormFactor<long double> finite = actual;
  if (!is_finite[0]) finite.value = 0;
  if (!is_finite[1]) finite.gradient.setZero();
  if (!is_finite[2]) finite.hessian.setZero();
  AtlasErrors errors = errorsOf(finite, expected);
  for (std::size_t q = 0; q < kAtlasQuantities; ++q) {
    if (!is_finite[q]) errors[q] = kInfinity;
  }
  return errors;
}

}  // namespace irradiff
