#include "experiments/io/json_text.h"

#include "derivatives/scene/number_text.h"
#include "experiments/io/non_finite_numbers.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace irradiff {

namespace {

using Json = nlohmann::json;

// "line 2, column 5" of the byte at `position`, which counts from 1 as the parser counts.
std::string place(std::string_view text, std::size_t position) {
  const std::string_view before = text.substr(0, position == 0 ? 0 : std::min(position - 1, text.size()));
  const auto lines = std::ranges::count(before, '\n');
  const std::size_t line_start = before.find_last_of('\n') + 1;  // 0 where there is none: npos + 1
  return "line " + std::to_string(lines + 1) + ", column " + std::to_string(before.size() - line_start + 1) +
         ", byte " + std::to_string(before.size() + 1);
}

// What the parser's tree would silently accept, and marks at the numbers that were replaced.
class TextRules {
 public:
  explicit TextRules(std::span<const NonFiniteNumber> replaced = {}) : replaced_(replaced) {}

  bool operator()(int depth, Json::parse_event_t event, Json& parsed) {
    using Event = Json::parse_event_t;
    if (event == Event::object_start || event == Event::array_start) {
      if (static_cast<std::size_t>(depth) >= kMaxJsonDepth) {
        throw SceneFileError("nested too deep: " + std::to_string(depth + 1) + " levels, at most " +
                             std::to_string(kMaxJsonDepth));
      }
      fields_.emplace_back();
    } else if (event == Event::object_end || event == Event::array_end) {
      fields_.pop_back();
    } else if (event == Event::key) {
      const auto& name = parsed.get_ref<const std::string&>();
      if (!fields_.back().insert(name).second) {
        throw SceneFileError("field " + parsed.dump() + " given twice in one object, must be given once");
      }
    }
    if (event == Event::value && parsed.is_number()) {
      if (!replaced_.empty() && replaced_.front().ordinal == numbers_) {
        const std::string& written = replaced_.front().written;
        // Nothing in a text is binary.
        parsed = Json::binary({written.begin(), written.end()});
        replaced_ = replaced_.subspan(1);
      }
      ++numbers_;
    }
    if (event == Event::value || event == Event::object_start || event == Event::array_start) {
      if (++values_ > kMaxJsonValues) {
        throw SceneFileError("more than " + std::to_string(kMaxJsonValues) + " values, at most that many are read");
      }
    }
    return true;
  }

 private:
  std::vector<std::set<std::string>> fields_;  // of the objects that are open; none for arrays
  std::size_t values_ = 0;
  std::span<const NonFiniteNumber> replaced_;  // those that are still to come
  std::size_t numbers_ = 0;
};

// Looks for the end of the text or the first error, and keeps nothing.
class EndSearch : public nlohmann::json_sax<Json> {
 public:
  explicit EndSearch(std::size_t size) : size_(size) {}
  JsonText verdict() const { return verdict_; }
  std::size_t errorPosition() const { return error_position_; }

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t position, const std::string&, const Json::exception&) override {
    error_position_ = position;
    verdict_ = position > size_ ? JsonText::kUnfinished : JsonText::kBroken;
    return false;
  }

 private:
  std::size_t size_;
  std::size_t error_position_ = 0;
  JsonText verdict_ = JsonText::kComplete;
};

// The text, marks in the place of numbers that no double holds, if it has such and is JSON without them.
std::optional<Json> parseMarked(std::string_view text) {
  const FiniteText finite = withoutNonFiniteNumbers(text);
  if (finite.replaced.empty()) return std::nullopt;
  try {
    return Json::parse(finite.text, TextRules(finite.replaced));
  } catch (const Json::exception&) {
    // Not JSON elsewhere, or a numeral that overflows and runs into a word: "1e999V".
    return std::nullopt;
  }
}

}  // namespace

std::string parserMessage(std::string message) {
  constexpr std::size_t kLongest = 300;
  if (const std::size_t tag_end = message.find("] "); message.starts_with('[') && tag_end != std::string::npos) {
    message.erase(0, tag_end + 2);
  }
  std::ranges::replace_if(
      message, [](char c) { return c < ' ' || c > '~'; }, '?');
  if (message.size() > kLongest)
    message = message.substr(0, kLongest / 2) + " ... " + message.substr(message.size() - kLongest / 2);
  return message;
}

Json parseJson(std::string_view text) {
  if (std::ranges::all_of(text, [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); })) {
    throw SceneFileError("empty text, expected a JSON object");
  }
  try {
    return Json::parse(text, TextRules());
  } catch (const Json::parse_error& error) {
    if (std::optional<Json> marked = parseMarked(text)) return *std::move(marked);
    throw SceneFileError("not JSON: " + place(text, error.byte) + ": " + parserMessage(error.what()));
  } catch (const Json::out_of_range& error) {
    if (std::optional<Json> marked = parseMarked(text)) return *std::move(marked);
    EndSearch search(text.size());
    Json::sax_parse(text, &search);
    throw SceneFileError("number out of range: " + place(text, search.errorPosition()) + ": " +
                         parserMessage(error.what()) + ", must fit in a double");
  }
}

std::optional<std::string> nonFiniteNumber(const Json& value) {
  if (!value.is_binary()) return std::nullopt;
  const Json::binary_t& written = value.get_binary();
  return std::string(written.begin(), written.end());
}

JsonText jsonText(std::string_view text) {
  EndSearch search(text.size());
  if (Json::sax_parse(text, &search) || search.verdict() != JsonText::kBroken) return search.verdict();
  const FiniteText finite = withoutNonFiniteNumbers(text);
  if (finite.replaced.empty()) return JsonText::kBroken;
  EndSearch again(text.size());
  Json::sax_parse(finite.text, &again);
  return again.verdict();
}

std::string jsonNumber(double value, std::string_view field) {
  if (!std::isfinite(value)) {
    throw std::domain_error(std::string(field) + " is " + numberText(value) + ", which JSON cannot express");
  }
  // "-0" reads back as the integer 0, without its sign.
  return value == 0 && std::signbit(value) ? "-0.0" : numberText(value);
}

}  // namespace irradiff
