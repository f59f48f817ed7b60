#include "verification/checks/configuration.h"

#include "verification/checks/json_point.h"

namespace irradiff {

std::string sceneLine(const Configuration& configuration) {
  std::string text =
      R"({"format":"irradiff-scene","version":1,"dimension":3,"polygons":[{"name":"polygon","vertices":[)";
  bool first = true;
  for (const Eigen::Vector3d& vertex : configuration.polygon.vertices) {
    text += first ? "" : ",";
    first = false;
    appendPoint(text, vertex);
  }
  text += R"(],"radiance":1}],"points":[{"position":)";
  appendPoint(text, configuration.receiver.position);
  text += R"(,"normal":)";
  appendPoint(text, configuration.receiver.normal);
  text += "}]}";
  return text;
}

}  // namespace irradiff
