#pragma once

#include "experiments/io/scene_file.h"

#include <string>
#include <string_view>

namespace irradiff {

/// A text as UTF-8, which scene files are written in: U+FFFD where it is none.
std::string utf8Text(std::string_view text);

/// A scene of polygons as the text of a scene file (scene_file.h), a polygon and a point a line, whose numbers read
/// back to the same doubles. Without receivers "points" is there and empty, so that whoever adds some finds the place;
/// such a file is refused until then.
///
/// Throws SceneFileError where the text would exceed what is read: kMaxSceneBytes or kMaxJsonValues. Requires dimension
/// 3, valid polygons and receivers, and names in UTF-8 of at most kMaxNameBytes.
std::string sceneText(const Scene& scene);

}  // namespace irradiff
