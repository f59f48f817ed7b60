#include "experiments/cli/import_command.h"

#include "derivatives/scene/receiver.h"
#include "experiments/cli/command_files.h"
#include "experiments/io/decimal_number.h"
#include "experiments/io/face_polygons.h"
#include "experiments/io/obj_file.h"
#include "experiments/io/scene_text.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace irradiff {

namespace {

constexpr const char* kCommand = "import";

struct ImportOptions {
  std::string input;
  std::string output;  ///< standard output if empty
  std::vector<std::string> receivers;
};

Receiver receiverOf(std::string_view text) {
  std::vector<double> numbers;
  for (std::string_view rest = text; numbers.empty() || !rest.empty();) {
    const std::size_t end = std::min(rest.find(','), rest.size());
    numbers.push_back(decimalNumber(rest.substr(0, end)));
    if (end + 1 == rest.size()) throw std::invalid_argument("ends in a comma");
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (numbers.size() != 6) throw std::invalid_argument("has " + std::to_string(numbers.size()) + " numbers");
  return {{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
}

std::vector<Receiver> receiversOf(const std::vector<std::string>& texts) {
  std::vector<Receiver> receivers;
  receivers.reserve(texts.size());
  for (const std::string& text : texts) {
    try {
      receivers.push_back(receiverOf(text));
      validate(receivers.back(), receivers.size() - 1);
    } catch (const std::invalid_argument& error) {
      throw CLI::ValidationError(
          "--receiver", quotedText(text) + ": " + error.what() + "; must be X,Y,Z,NX,NY,NZ with a normal of length 1");
    }
  }
  return receivers;
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

// What whoever knows the model would not expect of the scene.
std::vector<std::string> notes(const ObjModel& model, const FacePolygons& made, bool has_receivers) {
  std::vector<std::string> notes;
  if (made.split_faces > 0) {
    notes.push_back(std::to_string(made.split_faces) + " of " + counted(model.faces.size(), "face", "faces") +
                    " not planar, split into " + counted(made.triangles, "triangle", "triangles"));
  }
  if (made.dropped_faces > 0) {
    notes.push_back(counted(made.dropped_faces, "face", "faces") + " without an area left out");
  }
  if (made.dropped_vertices > 0) {
    notes.push_back(counted(made.dropped_vertices, "vertex", "vertices") + " equal to the one before left out");
  }
  if (model.other_elements > 0) {
    notes.push_back(
        counted(model.other_elements, "point, line, curve or surface", "points, lines, curves or surfaces") +
        " left out: only faces are read");
  }
  if (std::ranges::all_of(made.polygons, [](const Polygon& polygon) { return polygon.radiance == 0; })) {
    notes.emplace_back("nothing radiates: no face has a material with Ke above 0");
  }
  if (!has_receivers) {
    notes.emplace_back("the scene has no receivers: give --receiver, or add \"points\" or a \"grid\" to the file");
  }
  return notes;
}

void write(const std::string& text, const std::string& path) {
  const std::unique_ptr<WholeFile> file = openOutput(path);
  errno = 0;
  (file ? file->stream() : std::cout) << text << std::flush;
  if (file) {
    file->commit();
  } else if (!std::cout) {
    failToWrite(kCommand, errno);
  }
}

void importScene(const ImportOptions& options) {
  std::ifstream input = openInput(options.input);
  Scene scene;
  scene.receivers = receiversOf(options.receivers);
  std::vector<std::string> messages;
  std::string text;
  try {
    const ObjModel model = readObjFile(input, options.input);
    FacePolygons made = facePolygons(model);
    messages = notes(model, made, !scene.receivers.empty());
    scene.description = utf8Text("Imported from " + model.file.filename().string());
    scene.polygons = std::move(made.polygons);
    text = sceneText(scene);
  } catch (const std::bad_alloc&) {
    fail(kCommand, options.input + ": not enough memory for this model");
  } catch (const ObjFileError& error) {
    fail(kCommand, error.what());
  } catch (const SceneFileError& error) {
    fail(kCommand, options.input + ": " + error.what());
  }
  write(text, options.output);
  for (const std::string& message : messages) {
    std::cerr << "irradiff import: " << options.input << ": " << message << '\n';
  }
}

}  // namespace

void addImportCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(kCommand, "Makes a scene of a Wavefront OBJ file and its MTL");
  const auto options = std::make_shared<ImportOptions>();
  command->add_option("FILE", options->input, "an OBJ file; the MTL files that it names are looked for beside it")
      ->required()
      ->type_name("");
  addOutputOption(*command, options->output, "where the scene goes");
  command
      ->add_option("--receiver", options->receivers,
                   "position and unit normal of a receiver of the scene; may be given many times")
      ->type_name("X,Y,Z,NX,NY,NZ")
      ->allow_extra_args(false);
  command->footer(
      "Faces become polygons; one that is not planar is split into triangles, and counted in a message.\n"
      "Radiance is the Rec. 709 luminance of the material's Ke, 0.2126 r + 0.7152 g + 0.0722 b (exactly r where all\n"
      "are equal), and 0 for a face without a material.\n"
      "Exit status: 0 if the scene was written, 1 if the model cannot be imported, 2 for a wrong call.");
  command->callback([options] { importScene(*options); });
}

}  // namespace irradiff
