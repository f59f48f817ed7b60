#include "derivatives/samples/sample_hemisphere.h"

namespace irradiff {

HemisphereSamples sampleHemisphere(const Strata& strata, SamplePattern pattern, std::uint64_t seed, std::uint64_t point,
                                   const SampleFrame& frame, const RayQuery& cast_ray) {
  const GridShape shape = strata.shape();
  HemisphereSamples samples;
  samples.frame = frame;
  samples.stratification = strata.stratification();
  samples.shape = shape;
  for (std::vector<double>* numbers : {&samples.direction_t, &samples.direction_b, &samples.direction_n,
                                       &samples.inverse_distance, &samples.radiance}) {
    numbers->reserve(shape.size());
  }
  for (std::size_t row = 0; row < shape.rows; ++row) {
    for (std::size_t column = 0; column < shape.columns; ++column) {
      const StratumOffset offset = stratumOffset(pattern, seed, point, row * shape.columns + column);
      const Eigen::Vector3d direction = strata.direction({row, column, offset.along_row, offset.along_column});
      const RayHit hit = cast_ray(direction);
      samples.direction_t.push_back(direction.x());
      samples.direction_b.push_back(direction.y());
      samples.direction_n.push_back(direction.z());
      samples.inverse_distance.push_back(hit.inverse_distance);
      samples.radiance.push_back(hit.radiance);
    }
  }
  return samples;
}

}  // namespace irradiff
