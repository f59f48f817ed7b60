#include "experiments/atlas/region_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <stdexcept>

namespace irradiff {
namespace {

std::vector<SafetyStatement> statements() {
  SafetyStatement nowhere{"map", "appendix, acos", ScalarType::kFloat, 0, 1e-12, {}, 0, 0};
  SafetyStatement everywhere{"map", "area rule", ScalarType::kDouble, 1, 1e-6, SafeRegion{}, 0, 0};
  SafetyStatement somewhere{"other", "boundary", ScalarType::kLongDouble, 2, 1e-3, SafeRegion{}, 0, 0};
  somewhere.region->inequalities = {{1, 0, true, 0.1}, {2, -1, false, 3e-7}};
  return {nowhere, everywhere, somewhere};
}

TEST(RegionFile, ReadsWhatItWrote) {
  const std::string text = regionsJson(statements());
  const std::vector<SafetyStatement> read = readRegions(text);
  ASSERT_EQ(read.size(), 3U);
  EXPECT_FALSE(read[0].region);
  EXPECT_TRUE(read[1].region && read[1].region->inequalities.empty());
  ASSERT_TRUE(read[2].region);
  EXPECT_EQ(read[2].region->inequalities[1].y_power, -1);
  EXPECT_FALSE(read[2].region->inequalities[1].is_at_least);
  EXPECT_EQ(read[2].region->inequalities[1].bound, 3e-7);
  EXPECT_EQ(read[2].scalar, ScalarType::kLongDouble);
  EXPECT_EQ(regionsJson(read), text);
}

TEST(RegionFile, NamesWhatItCannotRead) {
  nlohmann::json text = nlohmann::json::parse(regionsJson(statements()));
  text[1]["scalar"] = "half";
  EXPECT_THROW(
      {
        try {
          readRegions(text.dump());
        } catch (const std::invalid_argument& error) {
          EXPECT_THAT(error.what(), testing::HasSubstr("\"half\""));
          throw;
        }
      },
      std::invalid_argument);
  text[1]["scalar"] = "double";
  text[1]["quantity"] = "rotation";
  EXPECT_THROW(readRegions(text.dump()), std::invalid_argument);
  text[1].erase("quantity");
  EXPECT_THROW(readRegions(text.dump()), nlohmann::json::exception);
  EXPECT_THROW(readRegions("[{"), nlohmann::json::exception);
}

}  // namespace
}  // namespace irradiff
