#pragma once

#include <filesystem>
#include <functional>
#include <istream>
#include <map>
#include <string>

namespace irradiff {

/// The radiance that a material emits, by the material's name.
using MaterialRadiances = std::map<std::string, double, std::less<>>;

/// Rec. 709 luminance of linear red, green and blue, 0.2126 r + 0.7152 g + 0.0722 b; exactly r where all three are
/// equal.
double luminance(double red, double green, double blue);

/// Adds the materials of a Wavefront MTL file, called `file` in messages: the luminance of Ke, or 0 without Ke. As in
/// the format's specification, one number given for Ke is all three. Everything but newmtl, Ke and map_Ke is skipped.
///
/// Throws ObjFileError with file, line, value and rule for
///   - Ke that is not one or three finite numbers >= 0: spectral curves and CIE XYZ too;
///   - map_Ke: the radiance of a polygon is constant;
///   - a name that has another radiance already.
/// And as readObjLines does.
void readMtlFile(std::istream& stream, const std::filesystem::path& file, MaterialRadiances& radiances);

}  // namespace irradiff
