#include "verification/checks/configuration.h"

#include <array>
#include <charconv>

namespace irradiff {
namespace {

void append(std::string& text, double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  text.append(buffer.data(), result.ptr);
}

void append(std::string& text, const Eigen::Vector3d& v) {
  text += '[';
  for (int i = 0; i < 3; ++i) {
    text += i > 0 ? "," : "";
    append(text, v(i));
  }
  text += ']';
}

}  // namespace

std::string sceneLine(const Configuration& configuration) {
  std::string text =
      R"({"format":"irradiff-scene","version":1,"dimension":3,"polygons":[{"name":"polygon","vertices":[)";
  bool first = true;
  for (const Eigen::Vector3d& vertex : configuration.polygon.vertices) {
    text += first ? "" : ",";
    first = false;
    append(text, vertex);
  }
  text += R"(],"radiance":1}],"points":[{"position":)";
  append(text, configuration.receiver.position);
  text += R"(,"normal":)";
  append(text, configuration.receiver.normal);
  text += "}]}";
  return text;
}

}  // namespace irradiff
