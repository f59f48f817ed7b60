#include "experiments/io/samples_record.h"

#include "experiments/io/non_finite_numbers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <string_view>
#include <utility>

namespace irradiff {

namespace {

using Json = nlohmann::json;

/// Fields of a record, and values of a field other than the samples: it needs a dozen.
constexpr std::size_t kMostOtherValues = 100;
constexpr double kNull = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kLongestShown = 60;

std::string shownValue(const Json& value) {
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > kLongestShown) text.replace(kLongestShown, std::string::npos, "...");
  return (value.is_string() ? "the string " : "") + text;
}

/// Takes a record from the parser. What is wrong with its form is remembered and the rest ignored, so that the parser
/// goes on to the record's end.
// NOLINTNEXTLINE(bugprone-exception-escape): as SamplesRecord.
class RecordBuilder : public nlohmann::json_sax<Json> {
 public:
  /// Throws what is wrong with the record.
  SamplesRecord take() {
    if (!refusal_.empty()) throw SceneFileError(refusal_);
    return std::move(record_);
  }

  bool isRefused() const { return !refusal_.empty(); }
  /// Where the parser was: "radiance[17]", "hits[3][0]".
  std::string place() const {
    std::string path = field_;
    if (depth_ >= 2) path += "[" + std::to_string(element_) + "]";
    if (depth_ >= 3) path += "[" + std::to_string(component_) + "]";
    return path;
  }
  /// Of text that is not JSON: what the parser said, and the last it read.
  const std::string& parserError() const { return parser_error_; }
  const std::string& lastToken() const { return last_token_; }
  bool isOutOfRange() const { return is_out_of_range_; }

  bool null() override { return value(nullptr); }
  bool boolean(bool given) override { return value(given); }
  bool number_integer(number_integer_t given) override { return value(given); }
  bool number_unsigned(number_unsigned_t given) override { return value(given); }
  bool number_float(number_float_t given, const string_t&) override { return value(given); }
  bool string(string_t& given) override { return value(given); }
  bool binary(binary_t&) override { return true; }  // there is none in text

  bool start_object(std::size_t) override {
    if (isRefused()) return true;
    if (depth_ > 0) return refuseKind("an object");
    record_.fields = Json::object();
    ++depth_;
    return true;
  }

  bool key(string_t& name) override {
    if (isRefused()) return true;
    field_ = name.substr(0, kLongestShown);
    element_ = 0;
    const bool is_new = record_.fields.emplace(name, nullptr).second;
    if (!is_new) return refuse("field \"" + field_ + "\" given twice in one object, must be given once");
    if (record_.fields.size() > kMostOtherValues)
      return refuse("more than " + std::to_string(kMostOtherValues) + " fields, at most that many are read");
    return true;
  }

  bool end_object() override { return leave(); }

  bool start_array(std::size_t) override {
    if (isRefused()) return true;
    if (depth_ == 1) {
      record_.fields[field_] = Json::array();
    } else if (depth_ == 2 && isHits()) {
      component_ = 0;
    } else {
      return refuseKind("an array");
    }
    ++depth_;
    return true;
  }

  bool end_array() override {
    if (isRefused()) return true;
    if (depth_ == 3) {
      if (component_ != hit_.size()) {
        depth_ = 2;
        return refuse(place() + ": expected 3 numbers, got " + std::to_string(component_));
      }
      addHit(hit_);
      ++element_;
    }
    return leave();
  }

  bool parse_error(std::size_t, const std::string& last_token, const Json::exception& error) override {
    constexpr int kOutOfRange = 406;  // the number that the parser's library gives to a numeral that overflows
    parser_error_ = parserMessage(error.what());
    last_token_ = last_token;
    is_out_of_range_ = error.id == kOutOfRange;
    return false;
  }

 private:
  bool isHits() const { return field_ == "hits"; }
  bool isRadiance() const { return field_ == "radiance"; }

  bool refuse(std::string reason) {
    refusal_ = std::move(reason);
    return true;
  }

  bool refuseKind(const std::string& found) {
    const std::string expected = depth_ == 0               ? "an object"
                                 : depth_ == 2 && isHits() ? "3 numbers or null"
                                 : depth_ == 1             ? "a number, a string or an array"
                                                           : "a number";
    return refuse((depth_ == 0 ? "samples" : place()) + ": expected " + expected + ", got " + found);
  }

  bool leave() {
    --depth_;
    return true;
  }

  bool value(const Json& given) {
    if (isRefused()) return true;
    if (depth_ == 0) return refuseKind(shownValue(given));
    if (depth_ == 1) {
      record_.fields[field_] = given;
    } else if (depth_ == 3) {
      if (!given.is_number()) return refuseKind(shownValue(given));
      if (component_ < hit_.size()) hit_.at(component_) = given.get<double>();
      ++component_;
    } else {
      addElement(given);
    }
    return true;
  }

  void addElement(const Json& given) {
    if (isHits() && given.is_null()) {
      addHit({kNull, kNull, kNull});
    } else if (isRadiance() && (given.is_number() || given.is_null())) {
      add(record_.radiance, given.is_null() ? kNull : given.get<double>());
    } else if (isHits() || isRadiance()) {
      refuseKind(shownValue(given));
    } else if (element_ == kMostOtherValues) {
      refuse(field_ + ": more than " + std::to_string(kMostOtherValues) + " values, at most that many are read");
    } else {
      record_.fields[field_].push_back(given);
    }
    ++element_;
  }

  void addHit(const std::array<double, 3>& hit) {
    add(record_.hit_x, hit[0]);
    add(record_.hit_y, hit[1]);
    add(record_.hit_z, hit[2]);
  }

  void add(std::vector<double>& numbers, double number) {
    if (numbers.size() == kMostSamples) {
      refuse(field_ + ": more than " + std::to_string(kMostSamples) + " samples, at most that many are read");
      return;
    }
    numbers.push_back(number);
  }

  SamplesRecord record_;
  std::string refusal_;
  std::string parser_error_;
  std::string last_token_;
  bool is_out_of_range_ = false;
  std::string field_;
  int depth_ = 0;  // 1 in the record, 2 in a field's array, 3 in a hit
  std::size_t element_ = 0;
  std::size_t component_ = 0;
  std::array<double, 3> hit_{};
};

// Of what the parser has read, which may begin with the token before.
std::string lastWord(const std::string& text) {
  const auto isInWord = [](unsigned char c) { return std::isalnum(c) != 0 || c == '+' || c == '-' || c == '.'; };
  return {std::find_if_not(text.rbegin(), text.rend(), isInWord).base(), text.end()};
}

bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

bool SamplesRecords::skipBlanks() {
  char c = 0;
  while (stream_.get(c)) {
    if (isBlank(c)) continue;
    stream_.unget();
    return true;
  }
  if (!stream_.eof()) throw SceneFileError("cannot be read: the stream failed");
  return false;
}

void SamplesRecords::skipToNextRecord() {
  // The line break may be what was wrong.
  if (!stream_.unget()) stream_.clear(stream_.rdstate() & std::ios::eofbit);
  // No line of a record that is written over several lines begins with "{" but its first: fields hold no objects.
  do {
    stream_.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  } while (stream_ && stream_.peek() != '{');
}

std::string SamplesRecords::restOfWord(std::string word) {
  constexpr std::size_t kLongestWord = 20;
  while (word.size() < kLongestWord && std::isalnum(stream_.peek()) != 0) word += static_cast<char>(stream_.get());
  return word;
}

std::optional<SamplesRecord> SamplesRecords::next() {
  if (!skipBlanks()) return std::nullopt;
  RecordBuilder builder;
  if (Json::sax_parse(stream_, &builder, Json::input_format_t::json, false)) return builder.take();
  // The parser leaves the stream behind the first character that is wrong.
  const std::string read = lastWord(builder.lastToken());
  const std::string word = builder.isOutOfRange() ? read : restOfWord(read);
  skipToNextRecord();
  if (builder.isRefused()) builder.take();
  if (builder.isOutOfRange() || isNonFiniteWord(word)) {
    throw SceneFileError(builder.place() + ": is " + word.substr(0, kLongestShown) +
                         ", must be a finite number that fits in a double");
  }
  throw SceneFileError("not JSON: " + builder.parserError());
}

}  // namespace irradiff
