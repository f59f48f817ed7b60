#pragma once

#include "derivatives/samples/hemisphere_samples.h"
#include "experiments/io/samples_record.h"

#include <istream>
#include <optional>
#include <ostream>
#include <string_view>

namespace irradiff {

/// Reads hemisphere samples, one record after the other (samples_record.h):
///
///     {"format": "irradiff-samples", "version": 1, "description": "where they come from",
///      "position": [x,y,z], "normal": [x,y,z], "tangent": [x,y,z], "bitangent": [x,y,z],
///      "stratification": "concentric", "shape": [rows, columns],
///      "hits": [[x,y,z], null, ...], "radiance": [L, null, ...]}
///
/// Strata are those of stratification.h, row by row; "description" may be missing. Rules for what is in them:
/// - (tangent, bitangent, normal) is orthonormal to kFrameTolerance and right-handed. It is used as given.
/// - A hit of null is a ray that hit nothing: it is infinitely far, in the direction of its stratum's middle. Its
///   radiance is as given, or 0 for null.
/// - Any other hit gives the direction from the position to it, must be at least 2^-1023 m away from the position and
///   has a radiance >= 0.
/// - A direction may leave its stratum, and fall below the horizon, by as much as single precision explains: see
///   `directionTolerance`. A direction below the horizon is then taken to it; beyond, it is an error. Samples of
///   neighbouring strata may coincide on the border between them.
///
/// Nothing that is not a finite number enters the samples.
class SamplesReader {
 public:
  /// The stream must outlive this.
  explicit SamplesReader(std::istream& stream) : records_(stream) {}

  /// The samples of the next record; nothing at the end of the stream. Throws SceneFileError that names the field, its
  /// index, the value and the rule; the next call goes on with the next record.
  std::optional<HemisphereSamples> next();

 private:
  SamplesRecords records_;
};

inline constexpr double kFrameTolerance = 1e-12;

/// How far the direction of a hit may be from its stratum, as the length of the difference of unit vectors.
///
/// Renderers trace in single precision, u = 2^-24. A ray's direction is off by up to 2 u from its own components and
/// those of the frame, and by u more where it is scaled by the distance r. A hit and a position written in world
/// coordinates are each off by up to u of their largest coordinate in each of three components, which turns the
/// direction by sqrt(3) u / r of that. Twice all this, because `Strata::nearestPosition` may be twice as far as the
/// nearest place. At most 1/64: so close to the position that single precision tells the direction no better, a hit
/// must be written with more digits.
double directionTolerance(const Eigen::Vector3d& position, const Eigen::Vector3d& hit);

/// Writes a record that reads back to the same samples but for the rounding of hits; a ray that hit nothing is written
/// as null. Throws std::domain_error naming the field for a number that JSON cannot express.
void writeSamples(std::ostream& stream, const HemisphereSamples& samples, std::string_view description = "");

}  // namespace irradiff
