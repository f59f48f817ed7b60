#pragma once

#include "experiments/io/json_fields.h"

#include <Eigen/Core>

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

namespace irradiff {

// What files of scenes and of rooms have in common.

/// Longest name of a polygon or segment, in bytes.
inline constexpr std::size_t kMaxNameBytes = 256;

/// "format" is this one; throws SceneFileError otherwise.
void requireFormat(const JsonField& file, std::string_view format);

/// A field that is one of these whole numbers; throws SceneFileError with the rule otherwise.
int wholeNumberOf(const JsonField& file, std::string_view name, std::initializer_list<int> allowed,
                  const std::string& rule);

/// A list that is not empty; throws SceneFileError otherwise.
void requireNotEmpty(const JsonField& list);

template <int Dimension>
Eigen::Matrix<double, Dimension, 1> vectorOf(const JsonField& field) {
  if (field.size() != Dimension) {
    field.refuse("expected " + std::to_string(Dimension) + " numbers, got " + std::to_string(field.size()));
  }
  Eigen::Matrix<double, Dimension, 1> vector;
  for (int i = 0; i < Dimension; ++i) vector[i] = field.at(static_cast<std::size_t>(i)).number();
  return vector;
}

/// An element of a list of polygons or segments, called by its name as soon as that is known.
struct NamedElement {
  JsonField field;
  std::string name;
};

/// The `kind` is "polygon" or "segment": one without a name is called by it and its index. Throws SceneFileError for
/// fields other than `fields` and for names that are too long or not printable.
NamedElement namedElement(const JsonField& list, std::size_t index, const std::string& kind,
                          std::initializer_list<std::string_view> fields);

/// "reflectance", in [0, 1]; throws SceneFileError otherwise.
double reflectanceOf(const JsonField& element);

}  // namespace irradiff
