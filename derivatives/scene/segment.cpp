#include "derivatives/scene/segment.h"

#include "derivatives/scene/invalid_scene.h"
#include "derivatives/scene/number_text.h"

#include <cmath>

namespace irradiff {

void validate(const Segment& segment, std::size_t index) {
  std::string subject = "segments[" + std::to_string(index) + ']';
  if (!segment.name.empty() && segment.name != "segment " + std::to_string(index))
    subject += " \"" + segment.name + "\"";

  if (!std::isfinite(segment.radiance) || segment.radiance < 0) {
    throw InvalidScene(subject + ": radiance is " + numberText(segment.radiance) + ", must be finite and >= 0");
  }
  for (std::size_t i = 0; i < segment.vertices.size(); ++i) {
    if (!segment.vertices[i].allFinite()) {
      throw InvalidScene(subject + ": vertex " + std::to_string(i) + " " + pointText(segment.vertices[i]) +
                         " is not finite, must be finite");
    }
  }
  if (segment.vertices[0] == segment.vertices[1]) {
    throw InvalidScene(subject + ": vertex 1 " + pointText(segment.vertices[1]) +
                       " repeats vertex 0, vertices must be distinct");
  }
}

}  // namespace irradiff
