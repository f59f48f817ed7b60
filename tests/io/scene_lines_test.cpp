#include "experiments/io/scene_lines.h"

#include "experiments/io/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <streambuf>
#include <vector>

namespace irradiff {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

std::vector<std::string> textsIn(const std::string& content) {
  std::istringstream stream(content);
  SceneLines lines(stream);
  std::vector<std::string> texts;
  for (std::string text; lines.next(text);) texts.push_back(text);
  return texts;
}

TEST(SceneLines, FindsNothingInNothing) {
  EXPECT_THAT(textsIn(""), IsEmpty());
  EXPECT_THAT(textsIn("\n \r\n\t\n"), IsEmpty());
}

TEST(SceneLines, ReadsASceneALine) {
  EXPECT_THAT(textsIn("{\"a\":1}\n{\"a\":2}\n{\"a\":3}\n"), ElementsAre("{\"a\":1}", "{\"a\":2}", "{\"a\":3}"));
  EXPECT_THAT(textsIn("\n{\"a\":1}\r\n\r\n{\"a\":2}"), ElementsAre("{\"a\":1}\r", "{\"a\":2}"));
}

TEST(SceneLines, ReadsOneSceneOverManyLines) {
  const std::string scene = "{\n  \"format\": \"irradiff-scene\",\n\n  \"polygons\": [\n{\"name\": \"a\"}\n]\n}";
  EXPECT_THAT(textsIn(scene), ElementsAre(scene));
  EXPECT_THAT(textsIn("\n\n" + scene + "\n"), ElementsAre(scene));
  EXPECT_THAT(textsIn("{\"a\": [NaN,\n-Infinity]}"), ElementsAre("{\"a\": [NaN,\n-Infinity]}"));
}

TEST(SceneLines, KeepsALineThatIsBrokenInItsPlace) {
  EXPECT_THAT(textsIn("oops\n{\"a\":2}\n"), ElementsAre("oops", "{\"a\":2}"));
  EXPECT_THAT(textsIn("{\"a\":1}\n{\"a\":\n{\"a\":3}\n"), ElementsAre("{\"a\":1}", "{\"a\":", "{\"a\":3}"));
}

TEST(SceneLines, TellsACutOffFirstLineFromASceneOverManyLines) {
  EXPECT_THAT(textsIn("{\"format\":\n{\"format\":2}\n{\"format\":\n{\"format\":4}"),
              ElementsAre("{\"format\":", "{\"format\":2}", "{\"format\":", "{\"format\":4}"));
  EXPECT_THAT(textsIn("{\"format\":\n{\"form\n{\"format\":3}\n"),
              ElementsAre("{\"format\":", "{\"form", "{\"format\":3}"));
  EXPECT_THAT(textsIn("{\"format\":\n"), ElementsAre("{\"format\":"));
}

// Bytes made as they are read, so that the test does not hold what the reader must not hold either.
class LongStream : public std::streambuf {
 public:
  LongStream(std::string head, std::size_t fill, std::string tail)
      : head_(std::move(head)), fill_(fill), tail_(std::move(tail)) {}

 protected:
  int_type underflow() override {
    if (part_ == 0) return part_ = 1, put(head_);
    if (fill_ > 0) {
      block_.assign(std::min<std::size_t>(fill_, 1 << 16), ' ');
      fill_ -= block_.size();
      return put(block_);
    }
    if (part_ == 1) return part_ = 2, put(tail_);
    return traits_type::eof();
  }

 private:
  int_type put(std::string& text) {
    setg(text.data(), text.data(), text.data() + text.size());
    return traits_type::to_int_type(text.front());
  }

  std::string head_;
  std::size_t fill_;
  std::string tail_;
  std::string block_;
  int part_ = 0;
};

TEST(SceneLines, RefusesALineOfAHundredMegabytesAndGoesOn) {
  for (const std::string head : {"{\"format\": [", "{\"format\": 0}\n{\"format\": ["}) {
    LongStream buffer(head, 100'000'000, "]}\n{\"format\": 2}\n");
    std::istream stream(&buffer);
    SceneLines lines(stream);
    std::string text;
    if (head.find('\n') != std::string::npos) {
      ASSERT_TRUE(lines.next(text));
    }
    EXPECT_THAT([&] { lines.next(text); }, ThrowsMessage<SceneFileError>(HasSubstr("longer than 67108864 bytes")));
    ASSERT_TRUE(lines.next(text));
    EXPECT_EQ(text, "{\"format\": 2}");
    EXPECT_FALSE(lines.next(text));
  }
}

TEST(SceneLines, RefusesASceneOfAHundredMegabytesOverManyLines) {
  LongStream buffer("{\n\"polygons\": [1,\n", 60'000'000, '\n' + std::string(30'000'000, ' ') + "]}\n");
  std::istream stream(&buffer);
  SceneLines lines(stream);
  std::string text;
  EXPECT_THAT([&] { lines.next(text); }, ThrowsMessage<SceneFileError>(HasSubstr("longer than 67108864 bytes")));
  EXPECT_FALSE(lines.next(text));
}

TEST(SceneLines, GoesOnBehindACutOffBeginningOfAHundredMegabytes) {
  LongStream buffer("{\"format\": [\n0,", 100'000'000, "\n0,\n{\"format\": 2}\n{\"format\": 3}\n");
  std::istream stream(&buffer);
  SceneLines lines(stream);
  std::string text;
  EXPECT_THAT([&] { lines.next(text); }, ThrowsMessage<SceneFileError>(HasSubstr("longer than 67108864 bytes")));
  ASSERT_TRUE(lines.next(text));
  EXPECT_EQ(text, "{\"format\": 2}");
  ASSERT_TRUE(lines.next(text));
  EXPECT_EQ(text, "{\"format\": 3}");
  EXPECT_FALSE(lines.next(text));
}

TEST(SceneLines, ReadsALineAtTheLimit) {
  LongStream buffer("{\"a\":", kMaxSceneBytes - 7, "1}\n{\"a\":2}");
  std::istream stream(&buffer);
  SceneLines lines(stream);
  std::string text;
  ASSERT_TRUE(lines.next(text));
  EXPECT_EQ(text.size(), kMaxSceneBytes);
  ASSERT_TRUE(lines.next(text));
  EXPECT_EQ(text, "{\"a\":2}");
}

// The reader takes chunks of a power of two bytes.
TEST(SceneLines, DoesNotMindWhereItsChunksEnd) {
  for (std::size_t size = (1 << 14) - 3; size <= (1 << 14) + 3; ++size) {
    for (const std::size_t count : {size, 2 * size}) {
      std::string line(count, ' ');
      line.front() = '[';
      line.back() = ']';
      EXPECT_THAT(textsIn(line + "\n" + line), ElementsAre(line, line)) << count;
    }
  }
}

// Below the limit of bytes, but every two of them a value.
TEST(SceneLines, ALineOfTooManyValuesIsRefusedByTheParser) {
  std::string text = "[";
  for (std::size_t i = 0; i < kMaxJsonValues; ++i) text += "0,";
  ASSERT_LT(text.size(), kMaxSceneBytes);
  EXPECT_THAT([&] { parseScene(text + "0]"); }, ThrowsMessage<SceneFileError>(HasSubstr("more than 4194304 values")));
}

TEST(SceneLines, SaysThatAFileCannotBeOpened) {
  std::ifstream stream(std::filesystem::temp_directory_path() / "irradiff" / "no such file");
  SceneLines lines(stream);
  std::string text;
  EXPECT_THAT([&] { lines.next(text); }, ThrowsMessage<SceneFileError>(HasSubstr("cannot be read")));
}

TEST(SceneLines, SaysThatAFolderCannotBeRead) {
  std::ifstream stream(std::filesystem::temp_directory_path());
  SceneLines lines(stream);
  std::string text;
  EXPECT_THAT([&] { lines.next(text); }, ThrowsMessage<SceneFileError>(HasSubstr("cannot be read")));
}

}  // namespace
}  // namespace irradiff
