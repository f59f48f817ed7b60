#include "experiments/io/decimal_number.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iomanip>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

namespace irradiff {
namespace {

using testing::ThrowsMessage;

TEST(DecimalNumber, ReadsEveryFormThatFilesUse) {
  EXPECT_EQ(decimalNumber("0.1"), 0.1);
  EXPECT_EQ(decimalNumber("1e-7"), 1e-7);
  EXPECT_EQ(decimalNumber("+.5E+2"), 50);
  EXPECT_EQ(decimalNumber("-2."), -2);
  EXPECT_EQ(decimalNumber("0.30000000000000004"), 0.1 + 0.2);
  EXPECT_TRUE(std::signbit(decimalNumber("-0")));
}

TEST(DecimalNumber, IsTheNearestDouble) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 20000; ++i) {
    const double number = std::bit_cast<double>(random());
    if (!std::isfinite(number) || (number != 0 && !std::isnormal(number))) continue;
    for (const int digits : {6, 9, 17, 25}) {
      std::ostringstream text;
      text << std::setprecision(digits) << number;
      const double expected = std::strtod(text.str().c_str(), nullptr);
      if (!std::isfinite(expected)) continue;
      ASSERT_EQ(std::bit_cast<std::uint64_t>(decimalNumber(text.str())), std::bit_cast<std::uint64_t>(expected))
          << text.str();
    }
  }
}

TEST(DecimalNumber, RefusesWhatIsNoFiniteNumber) {
  for (const std::string word :
       {"", "nan", "NaN", "inf", "-infinity", "1,5", "0x10", "1.0.3", "1e", "--1", "+-1", "++1", "x"}) {
    EXPECT_THAT([&] { decimalNumber(word); },
                ThrowsMessage<std::invalid_argument>("expected a finite number, got \"" + word + "\""));
  }
  EXPECT_THAT([] { decimalNumber("-1e999"); },
              ThrowsMessage<std::invalid_argument>("number out of range: \"-1e999\", must fit in a double"));
}

TEST(QuotedText, IsShortAsciiWhateverTheText) {
  EXPECT_EQ(quotedText("lamp"), "\"lamp\"");
  EXPECT_EQ(quotedText("K\xC3\xBC"
                       "che \"1\""),
            "\"K\\u00fcche \\\"1\\\"\"");
  for (const std::string& text : {std::string(1000, 'x'), std::string(1000, '\xff'), std::string(1000, '\n')}) {
    const std::string quoted = quotedText(text);
    EXPECT_LT(quoted.size(), 400U);
    for (const char c : quoted) EXPECT_TRUE(c >= ' ' && c <= '~') << quoted;
  }
}

}  // namespace
}  // namespace irradiff
