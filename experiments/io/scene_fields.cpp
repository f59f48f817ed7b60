#include "experiments/io/scene_fields.h"

#include <algorithm>
#include <cctype>

namespace irradiff {

void requireFormat(const JsonField& file, std::string_view format) {
  const JsonField field = file.at("format");
  if (field.text() != format) {
    field.refuse("expected \"" + std::string(format) + "\", got \"" + field.text().substr(0, kMaxNameBytes) + "\"");
  }
}

int wholeNumberOf(const JsonField& file, std::string_view name, std::initializer_list<int> allowed,
                  const std::string& rule) {
  const JsonField field = file.at(name);
  const double value = field.number();
  const auto found = std::ranges::find(allowed, value);
  if (found == allowed.end()) field.refuse("expected " + rule + ", got " + jsonNumber(value, field.path()));
  return *found;
}

void requireNotEmpty(const JsonField& list) {
  if (list.size() == 0) list.refuse("empty, expected at least 1");
}

NamedElement namedElement(const JsonField& list, std::size_t index, const std::string& kind,
                          std::initializer_list<std::string_view> fields) {
  const JsonField field = list.at(index);
  field.requireFields(fields);
  if (!field.has("name")) return {field, kind + " " + std::to_string(index)};
  const JsonField name = field.at("name");
  if (name.text().size() > kMaxNameBytes) {
    name.refuse("has " + std::to_string(name.text().size()) + " bytes, at most " + std::to_string(kMaxNameBytes));
  }
  // A message that quotes it must stay one line, and whole.
  const auto control =
      std::ranges::find_if(name.text(), [](char c) { return std::iscntrl(static_cast<unsigned char>(c)); });
  if (control != name.text().end()) {
    name.refuse("byte " + std::to_string(control - name.text().begin()) + " is the control character " +
                std::to_string(static_cast<int>(*control)) + ", names must be printable");
  }
  return {field.called(field.path() + " \"" + name.text() + "\""), name.text()};
}

double reflectanceOf(const JsonField& element) {
  const JsonField field = element.at("reflectance");
  const double value = field.number();
  if (!(value >= 0.0 && value <= 1.0)) {
    field.refuse("is " + jsonNumber(value, field.path()) + ", must be between 0 and 1");
  }
  return value;
}

}  // namespace irradiff
