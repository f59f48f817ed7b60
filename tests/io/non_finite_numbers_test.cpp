#include "experiments/io/non_finite_numbers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::pair<std::size_t, std::string>> found(const std::string& text) {
  std::vector<std::pair<std::size_t, std::string>> numbers;
  for (const NonFiniteNumber& number : withoutNonFiniteNumbers(text).replaced) {
    numbers.emplace_back(number.ordinal, number.written);
  }
  return numbers;
}

TEST(NonFiniteNumbers, AreFoundInEverySpelling) {
  EXPECT_THAT(found("[NaN,nan,-NaN,inf,-inf,+Inf,Infinity,-Infinity,1e999,-1e999]"),
              ElementsAre(std::pair(0, "NaN"), std::pair(1, "nan"), std::pair(2, "-NaN"), std::pair(3, "inf"),
                          std::pair(4, "-inf"), std::pair(5, "+Inf"), std::pair(6, "Infinity"),
                          std::pair(7, "-Infinity"), std::pair(8, "1e999"), std::pair(9, "-1e999")));
  EXPECT_THAT(found("1" + std::string(400, '0')), ElementsAre(std::pair(0, "1" + std::string(400, '0'))));
}

TEST(NonFiniteNumbers, AreCountedAmongNumbersAlone) {
  EXPECT_THAT(found(R"({"a": 1, "7": [true, null, "2"], "b": -3.5e2, "c": NaN})"), ElementsAre(std::pair(2, "NaN")));
}

TEST(NonFiniteNumbers, AreNotWhatDoublesHoldOrWhatIsQuoted) {
  for (const char* text :
       {"[1.7976931348623157e308, 5e-324, 1e-999, -0]", R"(["NaN", "\"NaN", "\\", "x\\\" 1e999"])",
        "[nano, infinite, null, NaNs, _]", "[1e999x, 1e999e1, 0x1p9999]", "", "\"", "\"\\", "-", "+"}) {
    EXPECT_THAT(found(text), IsEmpty()) << text;
    EXPECT_EQ(withoutNonFiniteNumbers(text).text, text);
  }
}

TEST(NonFiniteNumbers, LeaveEveryOtherByteInItsPlace) {
  EXPECT_EQ(withoutNonFiniteNumbers("[-Infinity, \"NaN\",\n 1e999]").text, "[0        , \"NaN\",\n 0    ]");
}

}  // namespace
}  // namespace irradiff
