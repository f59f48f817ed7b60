#include "experiments/io/json_fields.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace irradiff {

namespace {

std::string shortened(std::string text) {
  constexpr std::size_t kLongest = 60;
  if (text.size() > kLongest) text.replace(kLongest, std::string::npos, "...");
  return text;
}

// JSON text as it stands in a message: short and ASCII, whatever it is.
std::string shortText(const nlohmann::json& value) { return shortened(value.dump(-1, ' ', true)); }

}  // namespace

void JsonField::refuse(const std::string& reason) const {
  throw SceneFileError((path_.empty() ? whole_ : path_) + ": " + reason);
}

void JsonField::refuseKind(const std::string& expected) const {
  std::string found;
  if (const std::optional<std::string> number = nonFiniteNumber(value_)) {
    refuse("is " + shortened(*number) + ", must be a finite number that fits in a double");
  }
  if (value_.is_array()) {
    found = "an array of " + std::to_string(value_.size());
  } else if (value_.is_object()) {
    found = "an object";
  } else {
    found = (value_.is_string() ? "the string " : "") + shortText(value_);
  }
  refuse("expected " + expected + ", got " + found);
}

void JsonField::requireObject() const {
  if (!value_.is_object()) refuseKind("an object");
}

void JsonField::requireFields(std::initializer_list<std::string_view> known) const {
  requireObject();
  for (const auto& field : value_.items()) {
    if (std::ranges::find(known, field.key()) != known.end()) continue;
    std::string rule = "unknown field " + shortText(field.key()) + ", must be one of ";
    for (const std::string_view& name : known) rule += (&name == known.begin() ? "" : ", ") + std::string(name);
    refuse(rule);
  }
}

JsonField JsonField::at(std::string_view name) const {
  const auto found = value_.find(name);
  if (found == value_.end()) refuse("field \"" + std::string(name) + "\" is missing, must be given");
  return {*found, (path_.empty() ? "" : path_ + ": ") + std::string(name)};
}

std::size_t JsonField::size() const {
  if (!value_.is_array()) refuseKind("an array");
  return value_.size();
}

JsonField JsonField::at(std::size_t index) const {
  return {value_.at(index), path_ + "[" + std::to_string(index) + "]"};
}

double JsonField::number() const {
  if (!value_.is_number()) refuseKind("a number");
  return value_.get<double>();
}

std::size_t JsonField::positiveInteger() const {
  // A number with a fraction or an exponent is a float to the parser even where its value is whole.
  const double value = value_.is_number() ? value_.get<double>() : 0;
  if (!(value >= 1) || value > std::numeric_limits<std::uint32_t>::max() || value != std::floor(value)) {
    refuseKind("a whole number from 1 to 2^32 - 1");
  }
  return static_cast<std::size_t>(value);
}

const std::string& JsonField::text() const {
  if (!value_.is_string()) refuseKind("a string");
  return value_.get_ref<const std::string&>();
}

}  // namespace irradiff
