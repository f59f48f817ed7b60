#include "experiments/io/json_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>

namespace irradiff {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Lt;
using testing::SizeIs;
using testing::ThrowsMessage;

std::string repeated(std::string_view text, std::size_t count) {
  std::string result;
  for (std::size_t i = 0; i < count; ++i) result += text;
  return result;
}

auto parsing(std::string text) {
  return [text = std::move(text)] { parseJson(text); };
}

TEST(ParseJson, SaysWhereTheTextIsNotJson) {
  EXPECT_THAT(parsing("{\"a\": 1,\n \"b\": [1, 2"),
              ThrowsMessage<SceneFileError>(
                  AllOf(HasSubstr("not JSON: line 2, column 12"), HasSubstr("unexpected end of input"))));
  EXPECT_THAT(parsing("<scene/>"), ThrowsMessage<SceneFileError>(HasSubstr("not JSON: line 1, column 1, byte 1")));
  EXPECT_THAT(parsing("{\"a\": NaN]"), ThrowsMessage<SceneFileError>(HasSubstr("not JSON: line 1, column 7")));
  EXPECT_THAT(parsing("{} {}"), ThrowsMessage<SceneFileError>(HasSubstr("not JSON: line 1, column 4")));
  EXPECT_THAT(parsing(std::string("{\"a\"\0: 1}", 9)), ThrowsMessage<SceneFileError>(HasSubstr("not JSON")));
}

TEST(ParseJson, RefusesEmptyText) {
  EXPECT_THAT(parsing(""), ThrowsMessage<SceneFileError>(HasSubstr("empty text")));
  EXPECT_THAT(parsing(" \n\t"), ThrowsMessage<SceneFileError>(HasSubstr("empty text")));
}

TEST(ParseJson, MarksANumberThatNoDoubleHolds) {
  const nlohmann::json parsed = parseJson("{\"NaN\": [1, -1e999, \"NaN, 1e999\", {\"x\": NaN}, 1e-999, true, 2]}");
  const nlohmann::json& list = parsed["NaN"];
  EXPECT_EQ(nonFiniteNumber(list[1]), "-1e999");
  EXPECT_EQ(nonFiniteNumber(list[3]["x"]), "NaN");
  EXPECT_EQ(list[0], 1);
  EXPECT_EQ(list[2], "NaN, 1e999");
  EXPECT_EQ(list[4], 0.0);
  EXPECT_EQ(list[5], true);
  EXPECT_EQ(list[6], 2);
  for (const std::size_t i : {0, 2, 4, 5, 6}) EXPECT_EQ(nonFiniteNumber(list[i]), std::nullopt) << i;
}

TEST(ParseJson, SaysWhereANumberOverflowsInWhatIsNotJson) {
  EXPECT_THAT(parsing("[1,\n -1e999"), ThrowsMessage<SceneFileError>(AllOf(HasSubstr("line 2"), HasSubstr("'-1e999'"),
                                                                           HasSubstr("fit in a double"))));
}

TEST(ParseJson, SaysWhereANumberOverflowsThatRunsIntoAWord) {
  EXPECT_THAT(parsing("[1e999V, NaN]"), ThrowsMessage<SceneFileError>(HasSubstr("number out of range: line 1")));
  EXPECT_THAT(parsing("[1e999, 1e999V]"), ThrowsMessage<SceneFileError>(HasSubstr("number out of range: line 1")));
}

TEST(ParseJson, HoldsMarkedTextToItsOtherRules) {
  EXPECT_THAT(parsing("{\"a\": NaN, \"a\": 1}"), ThrowsMessage<SceneFileError>(HasSubstr("\"a\" given twice")));
  EXPECT_THAT(parsing("[NaN, " + repeated("[", 20) + repeated("]", 20) + "]"),
              ThrowsMessage<SceneFileError>(HasSubstr("nested too deep")));
}

TEST(ParseJson, NamesAFieldGivenTwice) {
  EXPECT_THAT(parsing(R"({"a": {"b": 1, "c": [{"b": 2}], "b": 3}})"),
              ThrowsMessage<SceneFileError>(HasSubstr("\"b\" given twice")));
  EXPECT_NO_THROW(parseJson(R"([{"b": 1}, {"b": {"b": 2}}])"));
}

TEST(ParseJson, LimitsDepthAndSize) {
  const auto nested = [](std::size_t depth) { return repeated("[", depth) + repeated("]", depth); };
  EXPECT_NO_THROW(parseJson(nested(kMaxJsonDepth)));
  EXPECT_THAT(parsing(nested(kMaxJsonDepth + 1)),
              ThrowsMessage<SceneFileError>(HasSubstr("nested too deep: 17 levels, at most 16")));
  EXPECT_THAT(parsing(repeated("[", 5000000)), ThrowsMessage<SceneFileError>(HasSubstr("nested too deep")));
  EXPECT_THAT(parsing(repeated("{\"a\":", 1000000)), ThrowsMessage<SceneFileError>(HasSubstr("nested too deep")));
}

TEST(ParseJson, WritesShortAsciiMessagesWhateverTheText) {
  for (const std::string& text : {'"' + std::string(1000000, 'x'), std::string("[\"\xff\xfe\"]"),
                                  std::string("[1").append(100000, '1') + "e5x]"}) {
    try {
      parseJson(text);
      ADD_FAILURE() << "accepted";
    } catch (const SceneFileError& error) {
      const std::string message = error.what();
      EXPECT_THAT(message, SizeIs(Lt(500U)));
      for (const char c : message) EXPECT_TRUE(c >= ' ' && c <= '~') << message;
    }
  }
}

TEST(JsonText, TellsCompleteUnfinishedAndBroken) {
  for (const char* text : {"{}", "[1, 2]", " 1 ", "{\"a\": {\"b\": []}}\r", "[NaN, 1e999]"})
    EXPECT_EQ(jsonText(text), JsonText::kComplete) << text;
  for (const char* text : {"{", "[1,", "{\"a\":", "{\"polygons\": [{\"vertices\": [[0, 0, 0]", "[NaN,", "[1e999"}) {
    EXPECT_EQ(jsonText(text), JsonText::kUnfinished) << text;
  }
  for (const char* text : {"}", "{} {}", "{,", "[1, nope]", "v 1 2 3", "[NaN}", "1e999 {}"})
    EXPECT_EQ(jsonText(text), JsonText::kBroken) << text;
}

TEST(JsonNumber, ReadsBackToTheSameBits) {
  std::mt19937_64 random(3);
  std::vector<double> numbers{0.0,
                              -0.0,
                              0.1,
                              1e22,
                              1e23,
                              12345678901234567890.0,
                              -9007199254740993.0,
                              5e-324,
                              2.2250738585072014e-308,
                              std::numeric_limits<double>::max(),
                              std::numeric_limits<double>::lowest()};
  while (numbers.size() < 100000) {
    const double number = std::bit_cast<double>(random());
    if (std::isfinite(number)) numbers.push_back(number);
  }
  for (const double number : numbers) {
    const double read = parseJson(jsonNumber(number, "x")).get<double>();
    ASSERT_EQ(std::bit_cast<std::uint64_t>(read), std::bit_cast<std::uint64_t>(number)) << jsonNumber(number, "x");
  }
}

TEST(JsonNumber, RefusesWhatJsonCannotExpress) {
  const auto writing = [](double value) { return [value] { jsonNumber(value, "gradient[1]"); }; };
  EXPECT_THAT(writing(std::numeric_limits<double>::quiet_NaN()),
              ThrowsMessage<std::domain_error>(HasSubstr("gradient[1] is nan")));
  EXPECT_THAT(writing(-std::numeric_limits<double>::infinity()),
              ThrowsMessage<std::domain_error>(HasSubstr("gradient[1] is -inf")));
}

}  // namespace
}  // namespace irradiff
