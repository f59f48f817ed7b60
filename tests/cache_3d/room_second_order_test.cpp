// Records of second order from samples against those of the occlusion Hessian, from the room to the error of the image.

#include "experiments/cache/image_error.h"
#include "experiments/cache/threshold_search.h"
#include "experiments/cache_3d/room_field.h"
#include "tests/cache_3d/test_rooms.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <string>
#include <utility>

namespace irradiff {
namespace {

double rmsAt(const RecordField& field, const std::string& metric, bool knows_geometry, std::size_t records) {
  MetricChoice choice;
  choice.metric = metric;
  choice.threshold = 1e-3;
  choice.ellipse.scale = ErrorScale::kAbsolute;
  choice.knows_geometry = knows_geometry;
  const TunedPlacement tuned = tuneThreshold(field, choice, {}, records);
  EXPECT_TRUE(tuned.is_within) << metric << ": " << tuned.placement.records.size() << " records";
  const double rms = imageError(tuned.placement.irradiance, field.reference).rms;
  std::printf("Cornell box, 96 x 96, 1024 rays, %zu records of %s%s: RMSE %.4f of the mean\n",
              tuned.placement.records.size(), metric.c_str(), knows_geometry ? " with known geometry" : "", rms);
  return rms;
}

TEST(RoomSecondOrder, HasLessErrorThanTheOcclusionHessianWithAsManyRecords) {
  RoomFieldPlan plan;
  plan.width = 96;
  plan.rays = 1024;
  plan.seed = 1;
  plan.threads = 2;
  plan.references = std::string(IRRADIFF_ROOM_FOLDER) + "/references";
  const RecordField field = roomField(dataRoom("cornell_box"), plan, nullptr);
  const double hessian = rmsAt(field, "occlusion-hessian", false, 300);
  const double samples = rmsAt(field, "second-order", false, 300);
  const double known = rmsAt(field, "second-order", true, 300);
  const double oracle = rmsAt(field, "oracle", false, 300);
  // One seed, and records where they happen to be: bounds a quarter above what was seen.
  EXPECT_LT(samples, 0.76 * hessian);  // observed 0.61
  EXPECT_LT(known, 0.54 * hessian);    // observed 0.42
  EXPECT_GT(oracle, 0.76 * hessian) << "bad twin: the first order, even with the best regions; observed 1.01";
}

}  // namespace
}  // namespace irradiff
