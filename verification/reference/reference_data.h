#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"

#include <Eigen/Core>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {

/// A reference number: its decimal digits, and high + low, the nearest double and the nearest double to the rest. The
/// pair holds about 32 digits, fewer where the rest underflows (values below 1e-276); `decimal` holds at least 40.
struct ReferenceNumber {
  std::string decimal;
  double high = 0.0;
  double low = 0.0;

  /// value - this, to the precision of the pair: exact for a value within a factor 2 of it but for the last addition.
  double errorOf(double value) const { return (value - high) - low; }
};

using ReferenceVector = Eigen::Matrix<ReferenceNumber, Eigen::Dynamic, 1>;
using ReferenceMatrix = Eigen::Matrix<ReferenceNumber, Eigen::Dynamic, Eigen::Dynamic>;

/// Largest absolute error of any component, as decimals: what the digits promise.
struct ReferenceError {
  std::string value;
  std::string gradient;
  std::string hessian;
  std::string rotational_gradient;
};

/// What every reference case has: where it comes from and what was computed.
struct ReferenceValues {
  std::string family;
  std::string name;
  std::string reason;        ///< why the case is here
  std::string route;         ///< "polar" or "area": area_integral.h, polar_integral.h; "line": flatland_integral.h
  ReferenceNumber value;     ///< F (1), or in flatland E (W/m)
  ReferenceVector gradient;  ///< 1/m, or W/m^2
  ReferenceMatrix hessian;   ///< 1/m^2, or W/m^3
  ReferenceVector rotational_gradient;  ///< 1/rad, 3 components; in flatland W/(m rad), one
  ReferenceError error;
};

/// F of a polygon with respect to the receiver's position; F > 0 when the vertices run clockwise seen from it. The
/// polygon has radiance 1 and the name of the case.
struct ReferenceCase : ReferenceValues {
  Polygon polygon;
  Receiver receiver;
};

/// E of a segment of radiance 1.
struct FlatlandReferenceCase : ReferenceValues {
  Segment segment;
  FlatlandReceiver receiver;
};

/// A reference file that cannot be read; the message names the file, the case, the field and the rule.
class InvalidReference : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads one file of the format "irradiff-reference", version 1. Throws InvalidReference.
std::vector<ReferenceCase> readReferenceFile(const std::filesystem::path& file);
std::vector<FlatlandReferenceCase> readFlatlandReferenceFile(const std::filesystem::path& file);

/// All cases of dimension 3 (2) in the folder, files in the order of their names. Throws InvalidReference also when
/// there is none.
std::vector<ReferenceCase> readReferenceData(const std::filesystem::path& folder);
std::vector<FlatlandReferenceCase> readFlatlandReferenceData(const std::filesystem::path& folder);

}  // namespace irradiff
