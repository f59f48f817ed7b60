#include "experiments/pareto/family_inputs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace irradiff {

namespace {

double relative(const Multiprecision& difference, const Multiprecision& size) {
  return size == 0 ? std::numeric_limits<double>::quiet_NaN() : Multiprecision(difference / size).convert_to<double>();
}

template <class Values, class Truth>
double relativeError(const Values& values, const Truth& truth) {
  Multiprecision difference = 0;
  Multiprecision size = 0;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values(i))) return std::numeric_limits<double>::infinity();
    difference = std::max<Multiprecision>(difference, abs(truth(i) - Multiprecision(values(i))));
    size = std::max<Multiprecision>(size, abs(truth(i)));
  }
  return relative(difference, size);
}

}  // namespace

FamilyInputs familyInputs(const InputFamily& family, std::size_t count, std::uint64_t seed) {
  FamilyInputs result;
  result.family = &family;
  result.inputs = drawInputs(family, count, seed);
  const Oracle oracle = multiprecisionOracle();
  for (const Configuration& input : result.inputs) {
    result.truths.push_back(oracle.evaluate(input).value());
    result.above_horizon.push_back(std::ranges::all_of(input.polygon.vertices, [&input](const Eigen::Vector3d& v) {
      return input.receiver.normal.dot(v - input.receiver.position) > 0.0;
    }));
  }
  return result;
}

std::array<double, 4> relativeErrors(const FormFactor<long double>& value, const OracleValue& truth) {
  std::array<double, 4> errors{};
  const Eigen::Matrix<long double, 1, 1> form_factor(value.value);
  const Eigen::Matrix<Multiprecision, 1, 1> true_form_factor(truth.form_factor);
  errors[0] = relativeError(form_factor, true_form_factor);
  errors[1] = relativeError(value.gradient, truth.gradient);
  errors[2] = relativeError(value.hessian, truth.hessian);
  errors[kLargestError] = errors[0];
  for (const double error : {errors[1], errors[2]}) {
    if (!(error <= errors[kLargestError])) errors[kLargestError] = error;
  }
  return errors;
}

}  // namespace irradiff
