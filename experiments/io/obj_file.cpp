#include "experiments/io/obj_file.h"

#include "experiments/io/decimal_number.h"
#include "experiments/io/mtl_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>
#include <streambuf>
#include <string_view>
#include <system_error>
#include <tiny_obj_loader.h>
#include <type_traits>
#include <utility>

namespace irradiff {

namespace {

namespace fs = std::filesystem;

// The package has a library for each, told apart by a definition alone.
static_assert(std::is_same_v<tinyobj::real_t, double>, "linked with tinyobjloader_double");

// Hands out one line at a time, so that it is known which one tinyobjloader reads while it calls back: it tells no line
// numbers.
class LineByLine : public std::streambuf {
 public:
  explicit LineByLine(const std::vector<ObjLine>& lines) : lines_(lines) {}

  /// The line being read. Requires that reading has begun.
  const ObjLine& current() const { return lines_[next_ - 1]; }

 protected:
  int_type underflow() override {
    if (next_ == lines_.size()) return traits_type::eof();
    const ObjLine& line = lines_[next_++];
    buffer_ = line.text;
    // A keyword alone counts as one only with a blank behind it.
    buffer_ += line.arguments().empty() ? " \n" : "\n";
    setg(buffer_.data(), buffer_.data(), buffer_.data() + buffer_.size());
    return traits_type::to_int_type(buffer_.front());
  }

 private:
  const std::vector<ObjLine>& lines_;
  std::size_t next_ = 0;
  std::string buffer_;
};

// Follows the file's structure by tinyobjloader, and reads numbers and indices from the lines again: tinyobjloader's
// numbers are off by some ulps, "nan" and what is missing are 0 to it, "1,5" is 1, and the index 4294967297 is 1. Its
// Ke is no better, and therefore mtl_file.h reads that.
class ModelReader : public tinyobj::MaterialReader {
 public:
  ModelReader(const std::vector<ObjLine>& lines, const fs::path& file) : lines_(lines), source_(lines) {
    model_.file = file;
  }

  ObjModel read() {
    constexpr std::array<std::string_view, 5> kOthers{"p", "l", "curv", "curv2", "surf"};
    for (const ObjLine& line : lines_) {
      // A face without indices would not be called back.
      if (line.text == "f") requireVertexCount(line, 0);
      if (std::ranges::find(kOthers, line.keyword()) != kOthers.end()) ++model_.other_elements;
    }
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = [](void* self, double, double, double, double) { reader(self).addVertex(); };
    callbacks.index_cb = [](void* self, tinyobj::index_t*, int) { reader(self).addFace(); };
    callbacks.usemtl_cb = [](void* self, const char*, int) { reader(self).useMaterial(); };
    callbacks.group_cb = [](void* self, const char**, int) { reader(self).nameGroup(); };
    callbacks.object_cb = [](void* self, const char*) { reader(self).nameGroup(); };
    std::istream stream(&source_);
    tinyobj::LoadObjWithCallback(stream, callbacks, this, this);
    requireFaces();
    return std::move(model_);
  }

  // Called for each name of an mtllib line until it returns true.
  bool operator()(const std::string&, std::vector<tinyobj::material_t>*, std::map<std::string, int>*, std::string*,
                  std::string*) override {
    const ObjLine& line = source_.current();
    const std::vector<std::string_view> names = line.words();
    if (names.empty()) refuse(line, "mtllib has no name, must name a file");
    std::error_code ignored;
    if (fs::exists(pathOf(line.arguments()), ignored)) {
      // One name: exporters write its blanks as they are.
      readMaterials(line, line.arguments());
    } else {
      for (const std::string_view name : names) readMaterials(line, name);
    }
    return true;
  }

 private:
  static ModelReader& reader(void* self) { return *static_cast<ModelReader*>(self); }

  [[noreturn]] void refuse(const ObjLine& line, const std::string& reason) const {
    refuseLine(model_.file, line.number, reason);
  }

  void requireVertexCount(const ObjLine& line, std::size_t count) const {
    if (count < 3) refuse(line, "face has " + std::to_string(count) + " vertices, must have at least 3");
  }

  fs::path pathOf(std::string_view name) const { return model_.file.parent_path() / name; }

  void readMaterials(const ObjLine& line, std::string_view name) {
    const fs::path path = pathOf(name);
    if (!material_files_.insert(path).second) return;
    errno = 0;
    std::ifstream stream(path, std::ios::binary);
    const std::string reason = stream ? "it is a folder" : std::generic_category().message(errno);
    std::error_code ignored;
    if (!stream || fs::is_directory(path, ignored)) {
      refuse(line, "material file " + path.string() + " cannot be opened: " + reason +
                       ", must be there: it tells what " + "radiates");
    }
    readMtlFile(stream, path, radiances_);
  }

  void addVertex() {
    const ObjLine& line = source_.current();
    const std::vector<std::string_view> words = line.words();
    if (words.size() < 3) refuse(line, "vertex has " + std::to_string(words.size()) + " numbers, must have at least 3");
    Eigen::Vector3d vertex;
    for (std::size_t i = 0; i < 3; ++i) {
      try {
        vertex[static_cast<Eigen::Index>(i)] = decimalNumber(words[i]);
      } catch (const std::invalid_argument& error) {
        refuse(line, "vertex " + std::to_string(model_.vertices.size() + 1) + ": " + error.what());
      }
    }
    model_.vertices.push_back(vertex);
  }

  void addFace() {
    const ObjLine& line = source_.current();
    const std::vector<std::string_view> words = line.words();
    requireVertexCount(line, words.size());
    ObjFace& face = model_.faces.emplace_back();
    face.name = (group_.empty() ? "" : group_ + " ") + "face " + std::to_string(model_.faces.size());
    face.radiance = radiance_;
    face.line = line.number;
    for (const std::string_view word : words) face.vertices.push_back(vertexIndex(line, word));
  }

  // Of "7", "7/1", "7/1/2" or "7//2", counted from 0. It may be that of a vertex still to come.
  std::size_t vertexIndex(const ObjLine& line, std::string_view word) const {
    long long index = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    const std::string_view rest = word.substr(static_cast<std::size_t>(end - word.data()));
    const bool is_index = error != std::errc::invalid_argument && (rest.empty() || rest.front() == '/') &&
                          rest.find_first_not_of("/-0123456789") == std::string_view::npos;
    if (!is_index) {
      refuse(line, "face: expected an index such as 7, 7/1, 7//2 or 7/1/2, got " + quotedText(word));
    }
    const auto count = static_cast<long long>(model_.vertices.size());
    if (error != std::errc() || index == 0 || index < -count) {
      refuse(line, "face: index " + quotedText(word) + ", must be from 1 or from -" + std::to_string(count) +
                       " to -1, with " + std::to_string(count) + " vertices before the face");
    }
    return static_cast<std::size_t>(index > 0 ? index - 1 : count + index);
  }

  void useMaterial() {
    const ObjLine& line = source_.current();
    const auto found = radiances_.find(line.arguments());
    if (found == radiances_.end()) {
      refuse(line, "material " + quotedText(line.arguments()) + " is in none of the " +
                       std::to_string(material_files_.size()) +
                       " material files named before, must be in one of them: it tells what radiates");
    }
    radiance_ = found->second;
  }

  void nameGroup() { group_ = source_.current().arguments(); }

  void requireFaces() const {
    if (model_.faces.empty()) {
      throw ObjFileError(model_.file.string() + ": has no faces (lines \"f 1 2 3\"), must have at least one");
    }
    for (const ObjFace& face : model_.faces) {
      const std::size_t largest = *std::ranges::max_element(face.vertices);
      if (largest < model_.vertices.size()) continue;
      refuseLine(model_.file, face.line,
                 "face: index " + std::to_string(largest + 1) + ", must be at most " +
                     std::to_string(model_.vertices.size()) + ", the number of vertices in the file");
    }
  }

  const std::vector<ObjLine>& lines_;
  LineByLine source_;
  ObjModel model_;
  MaterialRadiances radiances_;
  std::set<fs::path> material_files_;
  double radiance_ = 0;
  std::string group_;
};

}  // namespace

ObjModel readObjFile(std::istream& stream, const fs::path& file) {
  const std::vector<ObjLine> lines = readObjLines(stream, file);
  return ModelReader(lines, file).read();
}

}  // namespace irradiff
