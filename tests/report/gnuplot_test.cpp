#include "verification/report/gnuplot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace irradiff {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Gnuplot, DrawsAScriptOfAnyLength) {
  const std::string script = "set terminal svg\n" + std::string(1 << 20, '#') + "\nplot x title 'the last line'\n";
  EXPECT_THAT(runGnuplot(script), AllOf(HasSubstr("the last line"), HasSubstr("</svg>")));
}

TEST(Gnuplot, ThrowsWhereTheScriptIsWrong) {
  EXPECT_THAT([] { runGnuplot("set terminal svg\nplot x\nplat x\n"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("gnuplot")));
}

TEST(Gnuplot, KeepsItsScriptInTheFolderForTemporaryFiles) {
  const char* const before = std::getenv("TMPDIR");
  const std::string old = before != nullptr ? before : "";
  // A folder that exists and takes no files.
  setenv("TMPDIR", "/proc", 1);
  EXPECT_THAT([] { runGnuplot("set terminal svg\nplot x\n"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("cannot write a script for gnuplot in /proc")));
  before != nullptr ? setenv("TMPDIR", old.c_str(), 1) : unsetenv("TMPDIR");
}

}  // namespace
}  // namespace irradiff
