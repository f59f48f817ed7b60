#pragma once

#include "experiments/io/json_text.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace irradiff {

/// A value of a JSON file with the path that leads to it, such as `polygons[3] "emitter": vertices[2]`. Each accessor
/// throws SceneFileError naming the path, what was expected and what was found. Refers to the JSON value, which must
/// outlive it.
class JsonField {
 public:
  JsonField(const nlohmann::json& value, std::string path) : value_(value), path_(std::move(path)) {}

  /// The whole of a file, called `what` in messages: "scene".
  static JsonField whole(const nlohmann::json& value, std::string what) {
    JsonField field(value, "");
    field.whole_ = std::move(what);
    return field;
  }

  [[noreturn]] void refuse(const std::string& reason) const;

  void requireObject() const;
  /// Throws unless this is an object with no fields but `known`.
  void requireFields(std::initializer_list<std::string_view> known) const;
  bool has(std::string_view name) const { return value_.contains(name); }
  JsonField at(std::string_view name) const;

  /// Length of an array.
  std::size_t size() const;
  JsonField at(std::size_t index) const;

  double number() const;
  std::size_t positiveInteger() const;
  const std::string& text() const;

  /// The same value, called otherwise in messages.
  JsonField called(std::string path) const { return {value_, std::move(path)}; }
  const std::string& path() const { return path_; }

 private:
  [[noreturn]] void refuseKind(const std::string& expected) const;

  const nlohmann::json& value_;
  std::string path_;
  std::string whole_;  // what stands in for the path of the whole file
};

}  // namespace irradiff
