#include "experiments/io/spooled_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>

namespace irradiff {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string written(const SpooledText& text) {
  std::ostringstream stream;
  text.writeTo(stream);
  return stream.str();
}

/// A million bytes that no other number gives.
std::string block(int number) {
  return std::to_string(number) + std::string(999'990, static_cast<char>('a' + number % 26));
}

TEST(SpooledText, GivesBackWhatWasAppendedInMemoryAndBeyond) {
  SpooledText text;
  std::string expected;
  EXPECT_EQ(written(text), "");
  for (int i = 0; expected.size() < 2 * kMaxHeldBytes + 1'000'000; ++i) {
    text.append(block(i));
    expected += block(i);
    if (i == 3) {
      EXPECT_TRUE(written(text) == expected);
    }
  }
  EXPECT_TRUE(written(text) == expected);
  EXPECT_TRUE(written(text) == expected) << "the second time";
  text.append("end");
  EXPECT_TRUE(written(text) == expected + "end");
}

TEST(SpooledText, ForgetsWhatWasInTheFileToo) {
  SpooledText text;
  text.append(std::string(kMaxHeldBytes, 'x'));
  text.append("y");
  text.clear();
  EXPECT_EQ(written(text), "");
  text.append("again");
  EXPECT_EQ(written(text), "again");
}

/// An environment variable for as long as this lives.
class EnvironmentVariable {
 public:
  EnvironmentVariable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    setenv(name, value, 1);
  }
  ~EnvironmentVariable() { old_.empty() ? unsetenv(name_) : setenv(name_, old_.c_str(), 1); }
  EnvironmentVariable(const EnvironmentVariable&) = delete;
  EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

 private:
  const char* name_;
  std::string old_;
};

TEST(SpooledText, NamesTheFolderWhereItCannotMakeAFile) {
  // A folder that exists and takes no files.
  const EnvironmentVariable folder("TMPDIR", "/proc");
  SpooledText text;
  text.append(std::string(kMaxHeldBytes, 'x'));
  EXPECT_THAT([&] { text.append("y"); }, ThrowsMessage<std::runtime_error>(
                                             AllOf(HasSubstr("cannot make a temporary file in"), HasSubstr("/proc"))));
}

}  // namespace
}  // namespace irradiff
