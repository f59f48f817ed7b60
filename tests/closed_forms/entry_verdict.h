#pragma once

#include "tests/closed_forms/adaptive_quadrature.h"
#include "tests/closed_forms/entry_sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace irradiff::closed_forms_test {

/// Whether a value lies within what the quadrature and the configuration themselves leave open.
struct Verdict {
  long double difference = 0;
  long double tolerance = 0;
  [[nodiscard]] bool accepted() const { return difference <= tolerance; }
};

inline Verdict compare(long double value, const Quadrature& reference, double configuration_error) {
  return {std::abs(value - reference.value),
          reference.error_estimate + configuration_error * std::abs(reference.value)};
}

inline std::string describe(std::span<const ParameterRange> ranges, std::span<const double> values) {
  std::ostringstream text;
  text << std::hexfloat;
  for (std::size_t i = 0; i < ranges.size(); ++i) text << ranges[i].name << " = " << values[i] << "  ";
  return text.str();
}

/// Compares every entry with `reference(polygon, receiving)` on random parameters, and requires of the same comparison
/// that it rejects the twins that are wrong: 1 % more, `smallest_error` more or less, and any two parameters swapped
/// unless `symmetric(entry, i, j)`.
template <class Entry, class Reference, class Symmetric>
void expectAgreement(std::span<const Entry> entries, const Reference& reference, const Symmetric& symmetric,
                     long double smallest_error) {
  std::mt19937_64 random(kSeed);
  for (const Entry& entry : entries) {
    SCOPED_TRACE(std::string(entry.catalogue_number) + " " + std::string(entry.title));
    long double worst_margin = 0;
    long double worst_tolerance = 0;
    int rejected_swaps = 0;
    for (int set = 0; set < parameterSets(); ++set) {
      const std::vector<double> parameters = drawParameters(entry.parameters, random);
      SCOPED_TRACE(describe(entry.parameters, parameters));
      const auto [polygon, receiving] = entry.configuration(parameters);
      const Quadrature expected = reference(polygon, receiving);
      const auto value = entry.value_at_100_digits(parameters).template convert_to<long double>();
      const auto judge = [&](long double v) { return compare(v, expected, entry.configuration_error); };

      EXPECT_GT(value, 0);
      EXPECT_LE(value, 1);
      const Verdict verdict = judge(value);
      EXPECT_TRUE(verdict.accepted()) << std::setprecision(21) << "closed form " << value << ", quadrature "
                                      << expected.value << " +- " << verdict.tolerance;
      EXPECT_EQ(static_cast<double>(value), entry.value(parameters));
      worst_margin = std::max(worst_margin, verdict.difference / verdict.tolerance);
      worst_tolerance = std::max(worst_tolerance, verdict.tolerance / value);

      EXPECT_FALSE(judge(value * 1.01L).accepted());
      EXPECT_FALSE(judge(value * (1 + smallest_error)).accepted());
      EXPECT_FALSE(judge(value * (1 - smallest_error)).accepted());
      for (std::size_t i = 0; i < parameters.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          std::vector<double> swapped = parameters;
          std::swap(swapped[i], swapped[j]);
          if (swapped[i] == swapped[j]) continue;
          long double twin = 0;
          try {
            twin = entry.value_at_100_digits(swapped).template convert_to<long double>();
          } catch (const std::invalid_argument&) {
            continue;  // outside the ranges
          }
          EXPECT_EQ(judge(twin).accepted(), symmetric(entry, j, i))
              << entry.parameters[j].name << " and " << entry.parameters[i].name << " swapped";
          if (!judge(twin).accepted()) ++rejected_swaps;
        }
      }
    }
    EXPECT_GT(rejected_swaps, 0);
    std::cout << std::setw(5) << entry.catalogue_number << "  " << entry.title << ": largest relative tolerance "
              << static_cast<double>(worst_tolerance) << ", largest difference/tolerance "
              << static_cast<double>(worst_margin) << ", swaps rejected " << rejected_swaps << '\n';
  }
}

}  // namespace irradiff::closed_forms_test
