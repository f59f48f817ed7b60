// Every scene of data/scenes can be read, says why it is there, and is what it says.

#include "derivatives/form_factor/polygon_evaluation.h"
#include "experiments/figures/derivative_map.h"
#include "experiments/io/scene_file.h"
#include "tests/cli/program_run.h"
#include "tests/figures/clipped_view.h"
#include "tests/figures/event_planes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace irradiff {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = "data/scenes";
/// Metres: above what rounding moves a plane or a receiver of these scenes by, and far below a grid's cell.
constexpr double kOnAnEvent = 1e-9;

Scene sceneOf(const std::string& name) { return parseScene(readFile(kFolder / (name + ".json"))); }

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(kFolder)) {
    names.push_back(entry.path().stem().string());
  }
  return names;
}

double smallestEventDistance(const Scene& scene) {
  const EventPlanes planes(scene.polygons, scene.receivers[0].normal);
  double smallest = 1e9;
  for (const Receiver& receiver : scene.receivers) {
    smallest = std::min(smallest, planes.distance(receiver.position));
  }
  return smallest;
}

TEST(Scenes, AreThoseAskedFor) {
  EXPECT_THAT(sceneNames(), testing::UnorderedElementsAre("figure5", "one_occluder", "three_tilted_occluders",
                                                          "two_emitters", "slab_through_emitter", "cornell_box",
                                                          "black_square_in_box", "flatland_slot"));
}

TEST(Scenes, CanBeReadAndSayWhyTheyAreThere) {
  for (const std::string& name : sceneNames()) {
    SCOPED_TRACE(name);
    const Scene scene = sceneOf(name);
    EXPECT_GT(scene.description.size(), 80U);
    if (scene.dimension == 3) {
      ASSERT_TRUE(scene.grid);
      EXPECT_NO_THROW(validateFrame(*scene.grid));
      EXPECT_GE(scene.receivers.size(), 128U * 128U);
    } else {
      EXPECT_GE(scene.flatland_receivers.size(), 32U);
    }
  }
}

TEST(Scenes, HaveNoReceiverOnAVisibilityEvent) {
  for (const std::string& name : sceneNames()) {
    const Scene scene = sceneOf(name);
    if (scene.dimension == 3) {
      EXPECT_GT(smallestEventDistance(scene), kOnAnEvent) << name;
    }
  }
}

// The bad twin: as figure5 might have been written without care.
TEST(Scenes, WithEvenNumbersHaveReceiversOnEvents) {
  Scene scene = sceneOf("figure5");
  scene.polygons = {{"emitter", {{-0.5, -0.5, 3}, {0.5, -0.5, 3}, {0.5, 0.5, 3}, {-0.5, 0.5, 3}}, 10},
                    {"occluder", {{-0.5, -0.5, 1.5}, {0.5, -0.5, 1.5}, {0.5, 0.5, 1.5}, {-0.5, 0.5, 1.5}}, 0}};
  const ReceiverGrid grid{{-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 1}, 4, 4};
  scene.receivers.clear();
  for (std::size_t i = 0; i < 16; ++i) {
    scene.receivers.push_back(grid.receiver(i % 4, i / 4));
  }
  EXPECT_LT(smallestEventDistance(scene), kOnAnEvent);
}

/// How much of the emitter the scene's first polygon, the occluders `which` leave at each receiver of every fourth row
/// and column: the irradiance as a share of that without them.
std::vector<double> sharesLeft(const Scene& scene, const std::vector<std::size_t>& which) {
  std::vector<Polygon> polygons{scene.polygons[0]};
  for (const std::size_t index : which) {
    polygons.push_back(scene.polygons[index]);
  }
  std::vector<double> shares;
  for (std::size_t j = 0; j < scene.grid->height; j += 4) {
    for (std::size_t i = 0; i < scene.grid->width; i += 4) {
      const Receiver receiver = scene.grid->receiver(i, j);
      const double whole = evaluatePolygon(polygons[0], 0, receiver).derivatives.irradiance.value;
      shares.push_back(irradianceByClipping(polygons, receiver) / (polygons[0].radiance * whole));
    }
  }
  return shares;
}

/// A share that is neither nothing nor everything, rounding apart.
bool isPenumbra(double share) { return share > 1e-9 && share < 1.0 - 1e-9; }
bool isUmbra(double share) { return share < 1e-9; }

TEST(Scenes, Figure5HasTwoShadowsWhosePenumbraeOverlap) {
  const Scene scene = sceneOf("figure5");
  ASSERT_EQ(scene.polygons.size(), 3U);
  const std::vector<double> upper = sharesLeft(scene, {1});
  const std::vector<double> lower = sharesLeft(scene, {2});
  const std::vector<double> both = sharesLeft(scene, {1, 2});
  const auto count = [&](auto holds) {
    std::size_t result = 0;
    for (std::size_t i = 0; i < both.size(); ++i) {
      result += holds(i) ? 1 : 0;
    }
    return static_cast<double>(result) / static_cast<double>(both.size());
  };
  EXPECT_GT(count([&](std::size_t i) { return isUmbra(upper[i]); }), 0.01);
  EXPECT_GT(count([&](std::size_t i) { return isUmbra(lower[i]); }), 0.01);
  const double penumbra = count([&](std::size_t i) { return isPenumbra(lower[i]); });
  const double overlap = count([&](std::size_t i) { return isPenumbra(lower[i]) && isPenumbra(upper[i]); });
  EXPECT_GT(count([&](std::size_t i) { return isPenumbra(upper[i]); }), penumbra) << "the upper one is the wider";
  EXPECT_GT(overlap, 0.2 * penumbra);
  EXPECT_LT(overlap, 0.8 * penumbra);
  // What each leaves does not multiply: they hide parts of the emitter in common.
  EXPECT_GT(count([&](std::size_t i) { return upper[i] + lower[i] - 1 < both[i] - 1e-3; }), 0.01);
  EXPECT_GT(count([&](std::size_t i) { return both[i] > 1.0 - 1e-9; }), 0.2) << "and lit plane around";
}

TEST(Scenes, OneOccluderHasAPenumbraOnly) {
  const std::vector<double> shares = sharesLeft(sceneOf("one_occluder"), {1});
  EXPECT_EQ(std::ranges::count_if(shares, isUmbra), 0);
  EXPECT_GT(std::ranges::count_if(shares, isPenumbra), static_cast<std::ptrdiff_t>(shares.size() / 20));
}

}  // namespace
}  // namespace irradiff
