#include "experiments/curves/record_scene.h"

#include "experiments/cache_2d/flatland_field.h"
#include "experiments/cache_3d/plane_field.h"
#include "experiments/cache_3d/room_field.h"
#include "experiments/figures/program_fingerprint.h"
#include "experiments/io/json_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace irradiff {

namespace {

constexpr const char* kRoomFormat = "irradiff-room";
constexpr const char* kSceneFormat = "irradiff-scene";

std::string readText(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  return text;
}

/// The format and whether it is flatland, without a judgement of the rest.
struct FileKind {
  std::string format;
  bool is_flatland = false;
};
FileKind kindOf(const std::string& text) {
  const nlohmann::json json = parseJson(text);
  if (!json.is_object()) return {};
  FileKind kind;
  if (const auto format = json.find("format"); format != json.end() && format->is_string()) {
    kind.format = format->get<std::string>();
  }
  if (const auto dimension = json.find("dimension"); dimension != json.end() && dimension->is_number_integer()) {
    kind.is_flatland = dimension->get<long>() == 2;
  }
  return kind;
}

void requireLight(const FigureScene& scene) {
  const auto radiates = [](const Polygon& polygon) { return polygon.radiance > 0.0; };
  if (std::ranges::none_of(scene.scene.polygons, radiates)) {
    throw std::runtime_error("polygons: all have radiance 0, one must radiate");
  }
}

RecordScene readKnown(const std::filesystem::path& path, const std::string& text) {
  const FileKind kind = kindOf(text);
  RecordScene result{path.stem().string(), "", text, {}};
  if (kind.format == kRoomFormat && kind.is_flatland) {
    FlatlandRoom room = readFlatlandRoom(path);
    result.description = room.description;
    result.scene = std::move(room);
  } else if (kind.format == kRoomFormat) {
    Room room = readRoom(path);
    result.description = room.description;
    result.scene = std::move(room);
  } else if (kind.format == kSceneFormat) {
    FigureScene scene = readFigureScene(path);
    requireLight(scene);
    result.description = scene.scene.description;
    result.scene = std::move(scene);
  } else {
    throw std::runtime_error("format: \"" + kind.format + "\" must be " + kRoomFormat + " or " + kSceneFormat);
  }
  return result;
}

}  // namespace

RecordScene readRecordScene(const std::filesystem::path& path) {
  const std::string text = readText(path);
  try {
    return readKnown(path, text);
  } catch (const std::exception& error) {
    const std::string message = error.what();
    if (message.find(path.string()) != std::string::npos) throw std::runtime_error(message);
    throw std::runtime_error(path.string() + ": " + message);
  }
}

std::string fieldFingerprint(const RecordScene& scene, const RecordFieldPlan& plan) {
  const nlohmann::ordered_json all = {{"program", programFingerprint()},
                                      {"scene", scene.text},
                                      {"width", plan.width},
                                      {"rays", plan.rays},
                                      {"seed", plan.seed}};
  return all.dump();
}

RecordField recordField(const RecordScene& scene, const RecordFieldPlan& plan, const TileStore* finished,
                        const std::function<void(std::size_t, std::size_t)>& progress) {
  RecordField field;
  if (const auto* room = std::get_if<FlatlandRoom>(&scene.scene)) {
    field = flatlandField(*room, {plan.width, FlatlandLight::kIndirect, plan.threads}, progress);
  } else if (const auto* box = std::get_if<Room>(&scene.scene)) {
    const std::filesystem::path references = std::filesystem::path(IRRADIFF_ROOM_FOLDER) / "references";
    field = roomField(*box, {plan.width, plan.rays, plan.seed, plan.threads, references}, finished, progress);
  } else {
    field = planeField(std::get<FigureScene>(scene.scene), {plan.width, plan.rays, plan.seed, plan.threads}, finished,
                       progress);
  }
  const bool is_lit = std::ranges::any_of(field.reference, [](double value) { return value > 0.0; });
  if (!is_lit) throw std::runtime_error(scene.name + ": the irradiance is 0 at every receiver, some light must arrive");
  field.name = scene.name;
  return field;
}

}  // namespace irradiff
