#include "experiments/io/obj_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

std::vector<ObjLine> linesOf(const std::string& text) {
  std::istringstream stream(text);
  return readObjLines(stream, "model.obj");
}

std::vector<std::string> textsOf(const std::string& text) {
  std::vector<std::string> texts;
  for (const ObjLine& line : linesOf(text)) texts.push_back(std::to_string(line.number) + ":" + line.text);
  return texts;
}

TEST(ObjLines, SkipsBlankLinesAndCommentsAndKeepsNumbers) {
  EXPECT_THAT(textsOf("# a cube\n\nv 1 2 3 \n \t \n  # more\n\tf 1 2 3"), ElementsAre("3:v 1 2 3", "6:f 1 2 3"));
  EXPECT_THAT(textsOf(""), IsEmpty());
}

TEST(ObjLines, EndInAnyWay) {
  EXPECT_THAT(textsOf("a\nb\r\nc\rd\n"), ElementsAre("1:a", "2:b", "3:c", "4:d"));
  EXPECT_THAT(textsOf("\xEF\xBB\xBFv 1 2 3"), ElementsAre("1:v 1 2 3"));
}

TEST(ObjLines, GoOnBehindABackslash) {
  EXPECT_THAT(textsOf("f 1 2 \\\n  3 4\\\r\n 5\ng"), ElementsAre("1:f 1 2 3 4 5", "4:g"));
  EXPECT_THAT(textsOf("f 1 2 \\"), ElementsAre("1:f 1 2"));
  EXPECT_THAT(textsOf("\\\n\\\nf 1 2 3"), ElementsAre("1:f 1 2 3"));
  EXPECT_THAT(textsOf("\\\n"), IsEmpty());
}

TEST(ObjLines, SplitIntoKeywordAndWords) {
  const ObjLine line = linesOf("v\t1  2 3 # a corner").at(0);
  EXPECT_EQ(line.keyword(), "v");
  EXPECT_EQ(line.arguments(), "1  2 3 # a corner");
  EXPECT_THAT(line.words(), ElementsAre("1", "2", "3"));
  EXPECT_EQ(linesOf("g").at(0).arguments(), "");
  EXPECT_THAT(linesOf("g").at(0).words(), IsEmpty());
}

TEST(ObjLines, AreText) {
  EXPECT_THAT([] { linesOf(std::string("v 1 2 3\nv 1\0 2 3", 16)); },
              ThrowsMessage<ObjFileError>("model.obj: line 2: holds a NUL byte, must be text"));
}

TEST(ObjLines, HaveALimitInAll) {
  // An endless file, such as a device.
  class Endless : public std::streambuf {
    int_type underflow() override {
      setg(chunk_.data(), chunk_.data(), chunk_.data() + chunk_.size());
      return traits_type::to_int_type(chunk_.front());
    }
    std::string chunk_ = std::string(1 << 20, '#');
  } endless;
  std::istream stream(&endless);
  EXPECT_THAT([&] { readObjLines(stream, "/dev/endless"); },
              ThrowsMessage<ObjFileError>(HasSubstr("/dev/endless: longer than 134217728 bytes")));
}

}  // namespace
}  // namespace irradiff
