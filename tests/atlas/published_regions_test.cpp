// The inequalities in data/atlas/regions.json, which docs/atlas.md quotes, put to the test with inputs that had no part
// in finding them.

#include "derivatives/scene/number_text.h"
#include "experiments/atlas/event_map.h"
#include "experiments/atlas/region_check.h"
#include "experiments/atlas/region_file.h"
#include "tests/cli/program_run.h"
#include "verification/checks/input_families.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <set>
#include <thread>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 20120806;
/// What a region promises: errors have tails, and one input in so many may be worse.
constexpr double kInputsForAViolation = 20000.0;
/// Of all checks together; at the ordinary length of the test that is none.
constexpr std::size_t kChecksForAViolation = 2000000;

/// Whether as many violations or more would be seen with a probability below 1e-6 if the promise were kept: the
/// Poisson distribution. There are about a thousand statements.
bool isRefuted(const SafetyStatement& s) {
  const double expected = static_cast<double>(s.checked) / kInputsForAViolation;
  double term = std::exp(-expected);
  double fewer = 0.0;
  for (std::size_t k = 0; k < s.violations; ++k) {
    fewer += term;
    term *= expected / static_cast<double>(k + 1);
  }
  return s.violations > 0 && 1.0 - fewer < 1e-6;
}

/// Two of the cells that the bounds were found with, or more.
double enlargementOf(const SafetyStatement& s) { return s.map == "scale_size" ? 1e13 : 100.0; }

std::vector<StabilityMap> maps() {
  AtlasPlan plan;
  std::vector<StabilityMap> result;
  for (const PolygonMap& map : polygonMaps()) result.push_back(emptyMap(map, plan));
  result.push_back(emptyEventMap(plan));
  return result;
}

std::vector<SafetyStatement> published() { return readRegions(readFile("data/atlas/regions.json")); }

void check(std::vector<SafetyStatement>& statements, std::size_t inputs) {
  const std::vector<StabilityMap> all = maps();
  const unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  countViolations(all, probeRegions(all, statements, {"published", kSeed, inputs, inputs / 10}, threads, {}),
                  statements);
}

std::string describe(const SafetyStatement& s) {
  for (const StabilityMap& map : maps()) {
    if (map.file != s.map) continue;
    return s.map + ", " + s.formula + ", " + nameOf(s.scalar) + ", " + kAtlasQuantityNames[s.quantity] + ": safe for " +
           numberText(s.tolerance) + " (log) where " + textOf(s.region, map.x, map.y);
  }
  return s.map;
}

TEST(PublishedRegions, AreThereForEveryVariantQuantityAndTolerance) {
  std::set<std::string> expected;
  for (const StabilityMap& map : maps()) {
    for (const VariantErrors& variant : map.variants) {
      for (std::size_t quantity = 0; quantity < kAtlasQuantities; ++quantity) {
        for (const double tolerance : kAtlasTolerances) {
          expected.insert(map.file + variant.name() + std::to_string(quantity) + numberText(tolerance));
        }
      }
    }
  }
  std::set<std::string> found;
  for (const SafetyStatement& s : published()) {
    found.insert(s.map + s.formula + ", " + nameOf(s.scalar) + std::to_string(s.quantity) + numberText(s.tolerance));
  }
  EXPECT_EQ(found, expected);
}

TEST(PublishedRegions, AreThoseOfTheDocument) {
  const std::string document = readFile("docs/atlas.md");
  for (const StabilityMap& map : maps()) {
    for (const VariantErrors& variant : map.variants) {
      std::string row = "| " + variant.name();
      for (const SafetyStatement& s : published()) {
        const bool is_of_row = s.map == map.file && s.formula == variant.formula && s.scalar == variant.scalar &&
                               kAtlasQuantityNames[s.quantity] == std::string("Hessian");
        if (is_of_row) row += " | " + textOf(s.region, map.x, map.y);
      }
      EXPECT_THAT(document, testing::HasSubstr(row + " |\n"));
    }
  }
}

TEST(PublishedRegions, HoldForFreshInputs) {
  std::vector<SafetyStatement> statements = published();
  check(statements, lengthened(4000));
  std::size_t checked = 0;
  std::size_t violations = 0;
  for (const SafetyStatement& s : statements) {
    EXPECT_FALSE(isRefuted(s)) << describe(s) << ": worse at " << s.violations << " of " << s.checked;
    EXPECT_TRUE(!s.region || s.checked >= 10) << describe(s) << ": tested with " << s.checked << " inputs alone";
    if (s.violations > 0) std::cout << describe(s) << ": worse at " << s.violations << " of " << s.checked << '\n';
    checked += s.checked;
    violations += s.violations;
  }
  std::cout << "seed " << kSeed << ", " << checked << " checks, " << violations << " violations\n";
  EXPECT_LE(violations, checked / kChecksForAViolation);
}

TEST(PublishedRegions, DoNotHoldWhenEnlarged) {
  std::vector<SafetyStatement> statements = published();
  for (SafetyStatement& s : statements) {
    if (!s.region) continue;
    for (SizeInequality& i : s.region->inequalities)
      i.bound *= i.is_at_least ? 1.0 / enlargementOf(s) : enlargementOf(s);
  }
  check(statements, 4000);
  std::size_t bounded = 0;
  std::size_t refuted = 0;
  for (const SafetyStatement& s : statements) {
    // Where coordinates do not hold what is beyond the bound, nothing can refute it: all of the events' are so. Of the
    // others a few bounds are so near the edge of their map that it has not much beyond them.
    if (!s.region || s.region->inequalities.empty() || s.map == "event_angle") continue;
    ++bounded;
    refuted += isRefuted(s) ? 1 : 0;
  }
  std::cout << refuted << " of " << bounded << " enlarged regions fail\n";
  EXPECT_GT(static_cast<double>(refuted), 0.8 * static_cast<double>(bounded));
}

}  // namespace
}  // namespace irradiff
