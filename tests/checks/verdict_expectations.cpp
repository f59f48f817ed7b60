#include "tests/checks/verdict_expectations.h"

#include "experiments/io/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace irradiff {

using testing::HasSubstr;

void expectAllPass(const std::vector<Verdict>& verdicts) {
  EXPECT_FALSE(verdicts.empty());
  for (const Verdict& verdict : verdicts) {
    EXPECT_TRUE(verdict.passed) << describe(verdict);
    EXPECT_GT(verdict.inputs, 0U);
    EXPECT_EQ(verdict.likely_cause, "");
    EXPECT_LE(verdict.rms, verdict.peak);
  }
}

void expectOnlyRejected(Quantity quantity, const std::vector<Verdict>& verdicts, const std::string& likely_cause) {
  EXPECT_FALSE(verdicts.empty());
  std::size_t rejected = 0;
  for (const Verdict& verdict : verdicts) {
    if (verdict.quantity != quantity) {
      EXPECT_TRUE(verdict.passed) << describe(verdict);
      continue;
    }
    ++rejected;
    EXPECT_FALSE(verdict.passed) << describe(verdict);
    EXPECT_GT(verdict.peak, verdict.tolerance);
    EXPECT_GT(verdict.rms, 0.0);
    EXPECT_NE(verdict.expected, "");
    EXPECT_NE(verdict.actual, "");
    EXPECT_NE(verdict.expected, verdict.actual);
    EXPECT_THAT(verdict.likely_cause, HasSubstr(likely_cause)) << describe(verdict);
    EXPECT_THAT(describe(verdict), AllOf(HasSubstr("WRONG"), HasSubstr(verdict.check), HasSubstr(verdict.worst_input)));
    Scene scene;
    EXPECT_NO_THROW(scene = parseScene(verdict.worst_input)) << verdict.worst_input;
    EXPECT_EQ(scene.polygons.size() + scene.segments.size(), 1U);
    EXPECT_EQ(scene.receivers.size() + scene.flatland_receivers.size(), 1U);
  }
  EXPECT_GT(rejected, 0U);
}

}  // namespace irradiff
