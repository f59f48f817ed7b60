#include "experiments/cache_3d/true_irradiance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace irradiff {
namespace {

const ReceiverGrid kGrid{{1.0, -2.0, 0.5}, {3.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, {0.0, 0.0, 1.0}, 12, 9};

using Function = std::function<double(const Eigen::Vector3d&)>;
using Gradient = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

TrueIrradiance tabulated(const Function& function, const Gradient& gradient) {
  std::vector<double> values;
  std::vector<Eigen::Vector3d> gradients;
  for (std::size_t j = 0; j < kGrid.height; ++j) {
    for (std::size_t i = 0; i < kGrid.width; ++i) {
      const Eigen::Vector3d position = kGrid.receiver(i, j).position;
      values.push_back(function(position));
      gradients.push_back(gradient(position));
    }
  }
  return {kGrid, values, gradients};
}

const Function kQuadratic = [](const Eigen::Vector3d& p) {
  return 2.0 + p.x() - 0.5 * p.y() + 0.7 * p.x() * p.x() - 1.1 * p.x() * p.y() + 0.3 * p.y() * p.y();
};
const Gradient kQuadraticGradient = [](const Eigen::Vector3d& p) {
  return Eigen::Vector3d(1.0 + 1.4 * p.x() - 1.1 * p.y(), -0.5 - 1.1 * p.x() + 0.6 * p.y(), 17.0);
};

TEST(TrueIrradiance, IsExactForQuadraticsUpToTheBorder) {
  const TrueIrradiance truth = tabulated(kQuadratic, kQuadraticGradient);
  // Bad twin: bilinear without gradients.
  const TrueIrradiance flat = tabulated(kQuadratic, [](const Eigen::Vector3d&) { return Eigen::Vector3d(0, 0, 0); });
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  double worst_of_twin = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d position = kGrid.origin + share(random) * kGrid.u + share(random) * kGrid.v;
    // Terms of size 30; 1e-14 here.
    EXPECT_NEAR(*truth.at(position), kQuadratic(position), 1e-12);
    worst_of_twin = std::max(worst_of_twin, std::abs(*flat.at(position) - kQuadratic(position)));
  }
  EXPECT_GT(worst_of_twin, 1e-3);
}

TEST(TrueIrradiance, HasTheValuesOfItsReceiversAndNoneOutside) {
  const TrueIrradiance truth = tabulated(kQuadratic, kQuadraticGradient);
  EXPECT_NEAR(*truth.at(kGrid.receiver(3, 4).position), kQuadratic(kGrid.receiver(3, 4).position), 1e-13);
  EXPECT_TRUE(truth.at(kGrid.origin + 0.999 * kGrid.u + 0.001 * kGrid.v));
  EXPECT_FALSE(truth.at(kGrid.origin - 0.001 * kGrid.u));
  EXPECT_FALSE(truth.at(kGrid.origin + 1.001 * kGrid.v));
}

TEST(TrueIrradiance, IsContinuousAndOfThirdOrder) {
  const Function wave = [](const Eigen::Vector3d& p) { return std::sin(2.0 * p.x()) * std::cos(p.y()); };
  const Gradient slope = [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(2.0 * std::cos(2.0 * p.x()) * std::cos(p.y()), -std::sin(2.0 * p.x()) * std::sin(p.y()),
                           0.0);
  };
  const TrueIrradiance truth = tabulated(wave, slope);
  const Eigen::Vector3d border = kGrid.receiver(5, 0).position + Eigen::Vector3d(0.0, 0.31, 0.0);
  const Eigen::Vector3d little(1e-9, 0.0, 0.0);
  EXPECT_NEAR(*truth.at(border - little), *truth.at(border + little), 1e-8);
  double worst = 0.0;
  for (double x = 1.3; x < 3.7; x += 0.013) {
    const Eigen::Vector3d position(x, -1.234, 0.5);
    worst = std::max(worst, std::abs(*truth.at(position) - wave(position)));
  }
  // The third derivative is 8, cells are 0.25 wide: 8 h^3/(12 * 9 sqrt 3)... at most h^3 = 0.016; 1.1e-3 here, where
  // bilinear interpolation has 4 h^2/8 = 0.03.
  EXPECT_LT(worst, 0.016);
}

}  // namespace
}  // namespace irradiff
