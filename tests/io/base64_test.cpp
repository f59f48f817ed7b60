#include "experiments/io/base64.h"

#include <gtest/gtest.h>

namespace irradiff {
namespace {

// Section 10 of RFC 4648.
TEST(Base64, AgreesWithTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

// Section 9 of RFC 4648 names it "A": 0 and "/": 63; all six bits set in each place.
TEST(Base64, TakesBytesAsUnsigned) {
  EXPECT_EQ(base64(std::string_view("\xff\xff\xff", 3)), "////");
  EXPECT_EQ(base64(std::string_view("\0\0\0", 3)), "AAAA");
  EXPECT_EQ(base64("\xfb\xf0"), "+/A=");
}

}  // namespace
}  // namespace irradiff
