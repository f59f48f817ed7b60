// The maps of Figure 5's scene against another way to its irradiance, by clipping in the emitter's plane, and against
// differences of that.

#include "derivatives/scene/number_text.h"
#include "experiments/figures/derivative_map.h"
#include "experiments/io/scene_file.h"
#include "tests/cli/program_run.h"
#include "tests/figures/clipped_view.h"
#include "verification/finite_difference/ridders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace irradiff {
namespace {

constexpr std::size_t kResolution = 96;
constexpr double kUnitRoundoff = 0x1p-53;

/// What clipping may be off. A vertex of the clipped outline is found to a few roundings of coordinates up to 16 m
/// divided by the sine of the angle between edges, 1/3 or more; each moves E by at most the radiance, 10, times the
/// length of the outline, 4 m, over the squared distance, 9 m^2. There are up to 8 vertices: 8 * 16 * 3 * 40 / 9
/// roundings of 2 units each. Observed: 1e-15.
constexpr double kClippingError = 2.0 * 8.0 * 16.0 * 3.0 * 40.0 / 9.0 * kUnitRoundoff;

class Figure5 : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scene_ = new Scene(parseScene(readFile("data/scenes/figure5.json")));
    ReceiverGrid grid = *scene_->grid;
    grid.width = grid.height = kResolution;
    map_ = new DerivativeMap(
        derivativeMap(grid, viewEvaluator(scene_->polygons), std::max(1U, std::thread::hardware_concurrency())));
  }
  static void TearDownTestSuite() {
    delete map_;
    delete scene_;
  }

  static Receiver receiver(std::size_t place) { return map_->grid.receiver(place % kResolution, place / kResolution); }
  static double value(const std::string& name, std::size_t place) { return map_->channel(name).values[place]; }
  /// The share of the emitter's irradiance that the occluders leave.
  static double share(const Receiver& receiver) {
    return clipped(receiver) / irradianceByClipping(std::span(scene_->polygons).first(1), receiver);
  }
  static double clipped(const Receiver& receiver) { return irradianceByClipping(scene_->polygons, receiver); }

  /// No event passes between a receiver and any of the eight around it; false at the rim.
  static bool isCalm(std::size_t place) {
    const std::size_t i = place % kResolution;
    const std::size_t j = place / kResolution;
    if (std::min(i, j) == 0 || std::max(i, j) + 1 == kResolution) {
      return false;
    }
    for (const std::size_t row : {place - kResolution, place, place + kResolution}) {
      if (value("event", row - 1) + value("event", row) + value("event", row + 1) > 0.0) {
        return false;
      }
    }
    return true;
  }

  static Scene* scene_;
  static DerivativeMap* map_;
};

Scene* Figure5::scene_ = nullptr;
DerivativeMap* Figure5::map_ = nullptr;

TEST_F(Figure5, HasTheIrradianceOfClipping) {
  double largest = 0.0;
  for (std::size_t place = 0; place < kResolution * kResolution; ++place) {
    const double difference = std::abs(value("E", place) - clipped(receiver(place)));
    largest = std::max(largest, difference);
    ASSERT_LE(difference, kClippingError + value("bound.E", place)) << receiver(place).position.transpose();
  }
  RecordProperty("largest_difference", numberText(largest));
  // The bad twin: with one occluder forgotten the maps differ.
  const std::vector<Polygon> without(scene_->polygons.begin(), scene_->polygons.end() - 1);
  double forgotten = 0.0;
  for (std::size_t place = 0; place < kResolution * kResolution; place += 17) {
    forgotten = std::max(forgotten, std::abs(value("E", place) - irradianceByClipping(without, receiver(place))));
  }
  EXPECT_GT(forgotten, 0.1);
}

TEST_F(Figure5, HasTheDerivativesOfClippingBetweenEvents) {
  // Two steps, one for each differentiation, stay well within the cell.
  const double step = 0.1 * scene_->grid->u.norm() / kResolution;
  std::size_t judged = 0;
  std::size_t shaded = 0;
  std::size_t comparisons = 0;
  std::size_t caught = 0;
  for (std::size_t place = 0; place < kResolution * kResolution; ++place) {
    const Receiver middle = receiver(place);
    const bool is_shaded = share(middle) > 1e-9 && share(middle) < 1.0 - 1e-9;
    if (place % (is_shaded ? 9 : 101) != 0 || !isCalm(place)) {
      continue;
    }
    const auto first = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
      const auto along = [&](double t) { return clipped({from + t * direction, middle.normal}); };
      return riddersDerivative<double>(along, step, kClippingError);
    };
    const auto second = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      const double error = 4.0 * first(middle.position, b).error;
      const auto along = [&](double t) { return first(middle.position + t * a, b).value; };
      return riddersDerivative<double>(along, step, error);
    };
    const auto expect = [&](const std::string& name, const std::string& bound, const DifferenceResult<double>& truth) {
      const double tolerance = 4.0 * truth.error + value(bound, place);
      EXPECT_NEAR(value(name, place), truth.value, tolerance) << name << " at " << middle.position.transpose();
      caught += std::abs(1.01 * value(name, place) - truth.value) > tolerance ? 1 : 0;
      ++comparisons;
    };
    const Eigen::Vector3d x(1, 0, 0);
    const Eigen::Vector3d y(0, 1, 0);
    expect("gradient.x", "bound.gradient", first(middle.position, x));
    expect("gradient.y", "bound.gradient", first(middle.position, y));
    expect("gradient.z", "bound.gradient", first(middle.position, {0, 0, 1}));
    expect("hessian.xx", "bound.tangential_hessian", second(x, x));
    expect("hessian.xy", "bound.tangential_hessian", second(x, y));
    expect("hessian.yy", "bound.tangential_hessian", second(y, y));
    ++judged;
    shaded += is_shaded ? 1 : 0;
  }
  EXPECT_GT(judged, shaded + 20U);
  EXPECT_GT(shaded, 100U) << "within the penumbrae";
  EXPECT_GT(caught, comparisons * 9 / 10) << "the bad twin: what is one percent off";
}

// What clipping calls lit, half-shaded and dark: an event passes wherever that changes.
TEST_F(Figure5, MarksTheRimsOfThePenumbrae) {
  const auto shade = [&](std::size_t place) {
    const double left = share(receiver(place));
    return left < 1e-9 ? 0 : left > 1.0 - 1e-9 ? 2 : 1;
  };
  std::size_t rims = 0;
  std::size_t lit = 0;
  for (std::size_t place = 0; place + kResolution < kResolution * kResolution; ++place) {
    if (place % kResolution + 1 == kResolution) {
      continue;
    }
    const int here = shade(place);
    const int right = shade(place + 1);
    const int above = shade(place + kResolution);
    rims += here != right || here != above ? 1 : 0;
    if (here != right || here != above) {
      EXPECT_EQ(value("event", place), 1.0) << receiver(place).position.transpose();
    }
    const bool is_far = receiver(place).position.x() > 1.4;
    lit += is_far ? 1 : 0;
    if (is_far) {
      EXPECT_EQ(value("event", place), 0.0)
          << "nothing hides the emitter here: " << receiver(place).position.transpose();
    }
  }
  EXPECT_GT(rims, 200U);
  EXPECT_GT(lit, 100U);
}

}  // namespace
}  // namespace irradiff
