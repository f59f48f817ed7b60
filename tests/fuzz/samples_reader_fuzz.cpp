// libFuzzer target: whatever the bytes, SamplesReader comes to their end, and each record either meets the conditions
// of HemisphereSamples or gets an error with a message. The sanitizers watch for everything else.

#include "derivatives/samples/strata.h"
#include "experiments/io/samples_file.h"

#include <Eigen/LU>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>

namespace irradiff {
namespace {

void require(bool holds, const char* rule) {
  if (holds) return;
  std::cerr << "samples reader: broken rule: " << rule << '\n';
  std::abort();
}

void requireValid(const HemisphereSamples& samples) {
  const Eigen::Matrix3d axes = samples.frame.axes();
  require(samples.frame.position.allFinite() &&
              (axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm() < 1e-11 && axes.determinant() > 0.0,
          "the frame is right-handed and orthonormal");
  const Strata strata(samples.stratification, samples.shape);
  const std::size_t count = samples.shape.size();
  require(samples.direction_t.size() == count && samples.direction_b.size() == count &&
              samples.direction_n.size() == count && samples.inverse_distance.size() == count &&
              samples.radiance.size() == count,
          "there is one sample in each stratum");
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector3d direction = samples.direction(k);
    require(std::abs(direction.norm() - 1.0) < 1e-15, "directions are unit vectors");
    require(direction.z() >= 0.0, "directions are not below the horizon");
    const Eigen::Vector3d inside =
        strata.direction(strata.nearestPosition(k / samples.shape.columns, k % samples.shape.columns, direction));
    require((inside - direction).norm() <= 1.0 / 64.0, "directions are in their strata");
    require(std::isfinite(samples.inverse_distance[k]) && samples.inverse_distance[k] >= 0.0, "distances are not 0");
    require(std::isfinite(samples.radiance[k]) && samples.radiance[k] >= 0.0, "radiances are finite and >= 0");
  }
}

void readAll(const std::string& text) {
  std::istringstream stream(text);
  SamplesReader reader(stream);
  for (std::size_t records = 0; true; ++records) {
    require(records <= text.size(), "each record takes a byte of the text");
    try {
      const std::optional<HemisphereSamples> samples = reader.next();
      if (!samples) return;
      requireValid(*samples);
    } catch (const SceneFileError& error) {
      require(!std::string_view(error.what()).empty(), "SceneFileError has a message");
    }
  }
}

}  // namespace
}  // namespace irradiff

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  irradiff::readAll({reinterpret_cast<const char*>(data), size});
  return 0;
}
