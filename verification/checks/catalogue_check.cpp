#include "verification/checks/catalogue_check.h"

#include "verification/checks/random.h"
#include "verification/checks/square_mean.h"
#include "verification/checks/verdict_builder.h"
#include "verification/closed_forms/closed_forms.h"

#include <algorithm>
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

std::vector<double> drawParameters(const std::vector<ParameterRange>& ranges, KeyedRandom& random) {
  std::vector<double> parameters;
  parameters.reserve(ranges.size());
  for (const ParameterRange& range : ranges) {
    parameters.push_back(drawParameter(range, random));
  }
  return parameters;
}

template <class Entry>
VerdictBuilder builderFor(const Candidate& candidate, const Entry& form, double tolerance, const char* rule) {
  const std::string number(form.catalogue_number);
  return {candidate.name,
          "closed form " + (number.empty() ? std::string(form.title) : number),
          std::string(form.title),
          Quantity::kFormFactor,
          tolerance,
          rule};
}

template <class Entry>
void addError(VerdictBuilder& builder, const Entry& form, const std::vector<double>& parameters,
              const Configuration& input, double actual, double uncertainty) {
  const HundredDigits expected = form.value_at_100_digits(parameters);
  const HundredDigits error = abs(HundredDigits(actual) - expected);
  const auto expected_double = expected.convert_to<double>();
  builder.add(error.convert_to<double>(), form.configuration_error * expected_double + uncertainty, input,
              Eigen::MatrixXd::Constant(1, 1, expected_double), Eigen::MatrixXd::Constant(1, 1, actual));
}

}  // namespace

std::vector<Verdict> checkClosedForms(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                      double tolerance) {
  std::vector<Verdict> verdicts;
  if (!candidate.form_factor) {
    return verdicts;
  }
  for (const ClosedForm& form : closedForms()) {
    VerdictBuilder builder = builderFor(
        candidate, form, tolerance, "the promise, relative to 1: the fraction of the hemisphere that is divided up");
    for (std::size_t i = 0; i < inputs; ++i) {
      KeyedRandom random(seed, form.title, i);
      const std::vector<double> parameters = drawParameters(form.parameters, random);
      const auto [polygon, receiver] = form.configuration(parameters);
      const Configuration input{polygon, receiver};
      builder.attempt(input, [&] { addError(builder, form, parameters, input, candidate.form_factor(input), 0.0); });
    }
    verdicts.push_back(builder.finish());
  }
  return verdicts;
}

std::vector<Verdict> checkClosedFormsBetweenAreas(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                                  double tolerance) {
  std::vector<Verdict> verdicts;
  if (!candidate.form_factor) {
    return verdicts;
  }
  for (const ClosedFormBetweenAreas& form : closedFormsBetweenAreas()) {
    VerdictBuilder builder =
        builderFor(candidate, form, tolerance,
                   "the promise, relative to 1, above the quadrature's own error estimate of at most as much");
    for (std::size_t i = 0; i < inputs; ++i) {
      KeyedRandom random(seed, form.title, i);
      const std::vector<double> parameters = drawParameters(form.parameters, random);
      const auto [polygon, area] = form.configuration(parameters);
      const auto seenFrom = [&, &polygon = polygon, &area = area](double s, double t) {
        return Configuration{polygon, {area.corner + s * area.edge_u + t * area.edge_v, area.normal}};
      };
      const Configuration middle = seenFrom(0.5, 0.5);
      builder.attempt(middle, [&, &area = area] {
        const SquareMean mean =
            meanOverUnitSquare([&](double s, double t) { return candidate.form_factor(seenFrom(s, t)); },
                               area.edge_u.norm(), area.edge_v.norm(), 0.25 * tolerance);
        // Capped: a candidate so noisy that the quadrature does not converge must not be excused by it.
        addError(builder, form, parameters, middle, mean.value, std::min(mean.error, tolerance));
      });
    }
    verdicts.push_back(builder.finish());
  }
  return verdicts;
}

}  // namespace irradiff
