// libFuzzer target: whatever the bytes, parseScene returns a scene that passes validation or throws one of its two
// errors with a message. The sanitizers watch for everything else.

#include "derivatives/scene/invalid_scene.h"
#include "experiments/io/scene_file.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string_view>
#include <vector>

namespace irradiff {
namespace {

void require(bool holds, const char* rule) {
  if (holds) return;
  std::cerr << "scene reader: broken rule: " << rule << '\n';
  std::abort();
}

template <class Thing>
void validateAll(const std::vector<Thing>& things) {
  for (std::size_t i = 0; i < things.size(); ++i) validate(things[i], i);
}

void requireValid(const Scene& scene) {
  try {
    validateAll(scene.polygons);
    validateAll(scene.segments);
    validateAll(scene.receivers);
    validateAll(scene.flatland_receivers);
  } catch (const InvalidScene& error) {
    std::cerr << error.what() << '\n';
    require(false, "a scene that was read passes validation");
  }
  const bool is_3d = scene.dimension == 3 && !scene.polygons.empty() && !scene.receivers.empty() &&
                     scene.segments.empty() && scene.flatland_receivers.empty();
  const bool is_2d = scene.dimension == 2 && !scene.segments.empty() && !scene.flatland_receivers.empty() &&
                     scene.polygons.empty() && scene.receivers.empty();
  require(is_3d || is_2d, "a scene has emitters and receivers of its own dimension and no others");
}

void readOnce(std::string_view text) {
  try {
    requireValid(parseScene(text));
  } catch (const InvalidScene& error) {
    require(!std::string_view(error.what()).empty(), "InvalidScene has a message");
  } catch (const SceneFileError& error) {
    require(!std::string_view(error.what()).empty(), "SceneFileError has a message");
  }
}

}  // namespace
}  // namespace irradiff

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  irradiff::readOnce({reinterpret_cast<const char*>(data), size});
  return 0;
}
