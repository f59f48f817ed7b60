#include "verification/checks/oracle_check.h"

#include "verification/checks/verdict_builder.h"

#include <algorithm>
#include <cmath>

namespace irradiff {
namespace {

using DynamicMultiprecision = Eigen::Matrix<Multiprecision, Eigen::Dynamic, Eigen::Dynamic>;

bool knows(const Oracle& oracle, Quantity quantity) {
  return std::find(oracle.knows.begin(), oracle.knows.end(), quantity) != oracle.knows.end();
}

DynamicMultiprecision expectedOf(const OracleValue& value, Quantity quantity) {
  switch (quantity) {
    case Quantity::kFormFactor:
      return DynamicMultiprecision::Constant(1, 1, value.form_factor);
    case Quantity::kGradient:
      return value.gradient;
    case Quantity::kHessian:
      return value.hessian;
    case Quantity::kTangentialHessian:
      return value.tangential_hessian;
    case Quantity::kRotationalGradient:
      return value.rotational_gradient;
    case Quantity::kIrradiance:
      break;
  }
  return {};
}

double uncertaintyOf(const OracleValue& value, Quantity quantity) {
  switch (quantity) {
    case Quantity::kFormFactor:
      return value.form_factor_uncertainty;
    case Quantity::kGradient:
      return value.gradient_uncertainty;
    case Quantity::kHessian:
      return value.hessian_uncertainty;
    case Quantity::kTangentialHessian:
      return value.tangential_hessian_uncertainty;
    case Quantity::kRotationalGradient:
      return value.rotational_gradient_uncertainty;
    case Quantity::kIrradiance:
      break;
  }
  return 0.0;
}

double allowanceOf(const Allowance& allowance, Quantity quantity) {
  switch (quantity) {
    case Quantity::kFormFactor:
      return allowance.form_factor;
    case Quantity::kGradient:
      return allowance.gradient;
    case Quantity::kHessian:
      return allowance.hessian;
    case Quantity::kTangentialHessian:
      return allowance.tangential_hessian;
    case Quantity::kRotationalGradient:
      return allowance.rotational_gradient;
    case Quantity::kIrradiance:
      break;
  }
  return 0.0;
}

Multiprecision maxNorm(const DynamicMultiprecision& m) {
  Multiprecision largest = 0;
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    largest = std::max<Multiprecision>(largest, abs(m(i)));
  }
  return largest;
}

/// Largest difference; NaN in the candidate's value stays NaN.
Multiprecision maxDifference(const DynamicMultiprecision& expected, const Eigen::MatrixXd& actual) {
  if (!actual.allFinite()) {
    return std::numeric_limits<Multiprecision>::quiet_NaN();
  }
  return maxNorm(actual.cast<Multiprecision>() - expected);
}

/// What an error is relative to.
Multiprecision normOf(const OracleValue& value, Quantity quantity) {
  const Multiprecision norm = maxNorm(expectedOf(value, quantity));
  return quantity == Quantity::kRotationalGradient ? std::max<Multiprecision>(norm, abs(value.form_factor)) : norm;
}

Eigen::MatrixXd toDouble(const DynamicMultiprecision& m) {
  Eigen::MatrixXd result(m.rows(), m.cols());
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    result(i) = m(i).convert_to<double>();
  }
  return result;
}

std::vector<std::optional<OracleValue>> valuesOf(const Oracle& oracle, std::span<const Configuration> inputs) {
  std::vector<std::optional<OracleValue>> values;
  values.reserve(inputs.size());
  for (const Configuration& input : inputs) {
    values.push_back(oracle.evaluate(input));
  }
  return values;
}

}  // namespace

std::vector<Verdict> checkAgainst(const Oracle& oracle, const Candidate& candidate,
                                  std::span<const Configuration> inputs, const std::string& family,
                                  const Allowance& allowance) {
  std::vector<Verdict> verdicts;
  const std::vector<std::optional<OracleValue>> values = valuesOf(oracle, inputs);
  for (const Quantity quantity : kQuantities) {
    if (!knows(oracle, quantity) || !candidate.has(quantity) || allowanceOf(allowance, quantity) == 0.0) {
      continue;
    }
    VerdictBuilder builder(candidate.name, oracle.name, family, quantity, allowanceOf(allowance, quantity),
                           allowance.rule);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      if (!values[i] || std::isinf(uncertaintyOf(*values[i], quantity))) {
        continue;
      }
      const DynamicMultiprecision expected = expectedOf(*values[i], quantity);
      const Multiprecision norm = normOf(*values[i], quantity);
      if (norm == 0) {
        continue;
      }
      builder.attempt(inputs[i], [&] {
        const Eigen::MatrixXd actual = candidate.evaluate(quantity, inputs[i]);
        const Multiprecision error = maxDifference(expected, actual) / norm;
        const Multiprecision uncertainty = Multiprecision(uncertaintyOf(*values[i], quantity)) / norm;
        builder.add(error.convert_to<double>(), uncertainty.convert_to<double>(), inputs[i], toDouble(expected),
                    actual);
      });
    }
    verdicts.push_back(builder.finish());
  }
  return verdicts;
}

std::vector<Verdict> checkBounds(const Oracle& oracle, const Candidate& candidate,
                                 std::span<const Configuration> inputs, const std::string& family) {
  std::vector<Verdict> verdicts;
  if (!candidate.bounds) {
    return verdicts;
  }
  const std::vector<std::optional<OracleValue>> values = valuesOf(oracle, inputs);
  for (const Quantity quantity : kQuantities) {
    if (!knows(oracle, quantity) || !candidate.has(quantity)) {
      continue;
    }
    VerdictBuilder builder(candidate.name, "claimed bound", family, quantity, 1.0,
                           "the error is at most the claimed bound");
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      if (!values[i] || std::isinf(uncertaintyOf(*values[i], quantity))) {
        continue;
      }
      builder.attempt(inputs[i], [&] {
        const DynamicMultiprecision expected = expectedOf(*values[i], quantity);
        const Eigen::MatrixXd actual = candidate.evaluate(quantity, inputs[i]);
        const Multiprecision bound = boundOf(candidate.bounds(inputs[i]), quantity);
        const Multiprecision error = maxDifference(expected, actual);
        const Multiprecision uncertainty = uncertaintyOf(*values[i], quantity);
        const double ratio = error == 0 ? 0.0 : Multiprecision(error / bound).convert_to<double>();
        const double slack = uncertainty == 0 ? 0.0 : Multiprecision(uncertainty / bound).convert_to<double>();
        builder.add(ratio, slack, inputs[i], toDouble(expected), actual);
      });
    }
    verdicts.push_back(builder.finish());
  }
  return verdicts;
}

}  // namespace irradiff
