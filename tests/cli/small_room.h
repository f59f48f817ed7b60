#pragma once

namespace irradiff {

/// A room of four polygons, for commands on rooms in a second: a lamp over a floor with a wall, and a board that floats
/// before it and hides one from the other. The camera sees floor, wall and board.
inline constexpr const char* kSmallRoom =
    R"({"format": "irradiff-room", "version": 1, "dimension": 3, "description": "A board before a wall.",
    "polygons": [
      {"name": "floor", "radiance": 0, "reflectance": 0.5, "vertices": [[0,0,0], [2,0,0], [2,2,0], [0,2,0]]},
      {"name": "wall", "radiance": 0, "reflectance": 0.8, "vertices": [[0,2,0], [2,2,0], [2,2,2], [0,2,2]]},
      {"name": "board", "radiance": 0, "reflectance": 0.3,
       "vertices": [[0.6,1.1,0.5], [1.3,1.1,0.5], [1.3,1.5,0.7], [0.6,1.5,0.7]]},
      {"name": "lamp", "radiance": 10, "reflectance": 0,
       "vertices": [[0.8,0.6,1.8], [0.8,1.2,1.8], [1.4,1.2,1.8], [1.4,0.6,1.8]]}],
    "camera": {"position": [1.02,-1.9,1.3], "target": [1.0,1.2,0.6], "up": [0,0,1], "field_of_view": 40}})";

}  // namespace irradiff
