#include "verification/checks/catalogue_check.h"

#include "verification/checks/random.h"
#include "verification/checks/verdict_builder.h"
#include "verification/closed_forms/closed_forms.h"

#include <cmath>

namespace irradiff {
namespace {

/// A value in the range with 20 significant bits, for which the scene is the formula's to the last bit.
double drawParameter(const ParameterRange& range, KeyedRandom& random) {
  if (range.integer) {
    return range.lower + static_cast<double>(random.below(static_cast<std::size_t>(range.upper - range.lower) + 1));
  }
  const double value = random.between(range.lower, range.upper);
  if (value == 0.0) {
    return value;
  }
  const double short_value = std::ldexp(std::round(std::ldexp(value, 19 - std::ilogb(value))), std::ilogb(value) - 19);
  return short_value < range.lower || short_value > range.upper ? range.lower : short_value;
}

}  // namespace

std::vector<Verdict> checkClosedForms(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                      double tolerance) {
  std::vector<Verdict> verdicts;
  if (!candidate.form_factor) {
    return verdicts;
  }
  for (const ClosedForm& form : closedForms()) {
    const std::string number(form.catalogue_number);
    VerdictBuilder builder(candidate.name, "closed form " + (number.empty() ? std::string(form.title) : number),
                           std::string(form.title), Quantity::kFormFactor, tolerance,
                           "the promise, relative to 1: the fraction of the hemisphere that is divided up");
    for (std::size_t i = 0; i < inputs; ++i) {
      KeyedRandom random(seed, form.title, i);
      std::vector<double> parameters;
      for (const ParameterRange& range : form.parameters) {
        parameters.push_back(drawParameter(range, random));
      }
      const auto [polygon, receiver] = form.configuration(parameters);
      const Configuration input{polygon, receiver};
      builder.attempt(input, [&] {
        const HundredDigits expected = form.value_at_100_digits(parameters);
        const double actual = candidate.form_factor(input);
        const HundredDigits error = abs(HundredDigits(actual) - expected);
        const auto expected_double = expected.convert_to<double>();
        builder.add(error.convert_to<double>(), form.configuration_error * expected_double, input,
                    Eigen::MatrixXd::Constant(1, 1, expected_double), Eigen::MatrixXd::Constant(1, 1, actual));
      });
    }
    verdicts.push_back(builder.finish());
  }
  return verdicts;
}

}  // namespace irradiff
