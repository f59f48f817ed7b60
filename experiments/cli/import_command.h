#pragma once

namespace CLI {
class App;
}

namespace irradiff {

/// Adds `import MODEL.obj [--output FILE] [--receiver X,Y,Z,NX,NY,NZ]...`: a scene file of the faces of a Wavefront OBJ
/// file (obj_file.h, face_polygons.h, scene_text.h). What was split or left out is counted on standard error. A file
/// that cannot be imported ends it with CLI::RuntimeError of status 1 and writes nothing; CLI::ValidationError for one
/// that cannot be opened, and for a receiver that is none.
void addImportCommand(CLI::App& app);

}  // namespace irradiff
