#include "derivatives/estimators/hemicube.h"

#include "derivatives/estimators/strata_sums.h"
#include "derivatives/estimators/strata_walls.h"
#include "derivatives/estimators/texel_wall.h"

#include <vector>

namespace irradiff {

namespace {

/// Every wall between two texels once: its normal in the tangent plane times its length.
//   d(solid angle of `first`)/dx = -vector / r
std::vector<StrataWall> texelWalls(const Strata& strata) {
  std::vector<StrataWall> walls;
  walls.reserve(2 * strata.shape().size());
  forEachSharedSide(strata,
                    [&](std::size_t first, std::size_t second, std::size_t row, std::size_t column, std::size_t side) {
                      const TexelWall wall = texelWall(strata, stratumSide(row, column, side));
                      walls.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second),
                                       wall.length * wall.outer_normal.head<2>()});
                    });
  return walls;
}

std::vector<double> cosinesAtTexelCentres(const Strata& strata) {
  const GridShape shape = strata.shape();
  std::vector<double> cosines;
  cosines.reserve(shape.size());
  for (std::size_t row = 0; row < shape.rows; ++row) {
    for (std::size_t column = 0; column < shape.columns; ++column) {
      cosines.push_back(strata.direction({row, column}).z());
    }
  }
  return cosines;
}

class Hemicube final : public Estimator {
 public:
  explicit Hemicube(const Strata& strata)
      : sums_(strata.stratification(), strata.shape()),
        walls_(texelWalls(strata)),
        cosines_(cosinesAtTexelCentres(strata)) {}

  IrradianceEstimate estimate(const HemisphereSamples& samples) const override {
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    for (const StrataWall& wall : walls_) {
      const double gained = samples.radiance[wall.second] * cosines_[wall.second];
      const double lost = samples.radiance[wall.first] * cosines_[wall.first];
      gradient += (gained - lost) * nearerInverseDistance(samples, wall) * wall.vector;
    }
    IrradianceEstimate estimate;
    estimate.irradiance = sums_.irradiance(samples);
    estimate.rotational_gradient = sums_.rotationalGradient(samples);
    estimate.gradient = Eigen::Vector3d(gradient.x(), gradient.y(), 0.0);
    return estimate;
  }

 private:
  StrataSums sums_;
  std::vector<StrataWall> walls_;
  std::vector<double> cosines_;
};

}  // namespace

std::unique_ptr<Estimator> makeHemicube(Stratification stratification, GridShape shape) {
  return std::make_unique<Hemicube>(Strata(stratification, shape));
}

}  // namespace irradiff
