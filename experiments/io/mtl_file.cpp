#include "experiments/io/mtl_file.h"

#include "derivatives/scene/number_text.h"
#include "experiments/io/decimal_number.h"
#include "experiments/io/obj_lines.h"

#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace irradiff {

namespace {

// Reads the text of Ke; throws std::invalid_argument.
double emittedRadiance(const ObjLine& line) {
  std::vector<double> components;
  for (const std::string_view word : line.words()) {
    components.push_back(decimalNumber(word));
    if (components.back() < 0) throw std::invalid_argument("is " + quotedText(word) + ", must be >= 0");
  }
  if (components.size() == 1) return components[0];
  if (components.size() != 3) {
    throw std::invalid_argument("has " + std::to_string(components.size()) + " numbers, must have 1 or 3");
  }
  return luminance(components[0], components[1], components[2]);
}

// One material while its lines are read.
struct Material {
  std::string name;
  std::size_t line = 0;
  double radiance = 0;
};

void add(const Material& material, const std::filesystem::path& file, MaterialRadiances& radiances) {
  const auto [known, is_new] = radiances.emplace(material.name, material.radiance);
  if (is_new || known->second == material.radiance) return;
  refuseLine(file, material.line,
             "material " + quotedText(material.name) + " has radiance " + numberText(material.radiance) +
                 ", and one of that name has " + numberText(known->second) + " already, must have one radiance");
}

}  // namespace

double luminance(double red, double green, double blue) {
  if (red == green && green == blue) return red;
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

void readMtlFile(std::istream& stream, const std::filesystem::path& file, MaterialRadiances& radiances) {
  std::vector<Material> materials;
  for (const ObjLine& line : readObjLines(stream, file)) {
    const std::string_view keyword = line.keyword();
    if (keyword == "newmtl") {
      materials.push_back({std::string(line.arguments()), line.number});
      continue;
    }
    if (keyword != "Ke" && keyword != "map_Ke") continue;
    if (materials.empty()) refuseLine(file, line.number, std::string(keyword) + " before the first newmtl");
    const std::string subject = "material " + quotedText(materials.back().name) + ": " + std::string(keyword);
    if (keyword == "map_Ke") {
      refuseLine(file, line.number,
                 subject + " is the texture " + quotedText(line.arguments()) +
                     ", radiance must be constant over a face: give it by Ke");
    }
    try {
      materials.back().radiance = emittedRadiance(line);
    } catch (const std::invalid_argument& error) {
      refuseLine(file, line.number, subject + ": " + error.what());
    }
  }
  for (const Material& material : materials) add(material, file, radiances);
}

}  // namespace irradiff
