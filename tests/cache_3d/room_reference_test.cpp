// Reference images: written and read, refused where they belong to another room, and right.

#include "experiments/cache_3d/room_reference.h"

#include "experiments/cache_3d/direct_light.h"
#include "experiments/cache_3d/room_gather.h"
#include "tests/cache_3d/test_rooms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace irradiff {
namespace {

namespace fs = std::filesystem;

const fs::path kReferences = fs::path(IRRADIFF_ROOM_FOLDER) / "references";

fs::path emptyFolder() {
  fs::path folder = fs::temp_directory_path() / ("room_reference_test_" + std::to_string(getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

TEST(RoomReference, IsReadAsItWasWritten) {
  const Room room = cornerRoom();
  const std::vector<SeenPoint> seen = seenPoints(room, 10);
  RoomReference reference;
  reference.rms_error = 1.25e-5;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const auto number = static_cast<double>(i);
    reference.values.push_back({0.5 * number, {number, -number, 0.25}});
  }
  const fs::path folder = emptyFolder();
  const fs::path path = referencePath(folder, room, 10);
  EXPECT_EQ(path.filename(), "corner_10.exr");
  EXPECT_FALSE(readReference(path, room, 10, seen)) << "not there";
  std::ofstream(path, std::ios::binary) << exrFile(referenceImage(room, 10, seen, reference));
  const std::optional<RoomReference> read = readReference(path, room, 10, seen);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->rms_error, 1.25e-5);
  ASSERT_EQ(read->values.size(), seen.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(read->values[i].irradiance, reference.values[i].irradiance);
    EXPECT_EQ(read->values[i].gradient, reference.values[i].gradient);
  }
  // Of another room, seen by another camera, of another size: made from something else.
  Room darker = room;
  darker.reflectances[0] = 0.49;
  EXPECT_FALSE(readReference(path, darker, 10, seen));
  Room moved = room;
  moved.camera.position.x() += 1e-9;
  EXPECT_FALSE(readReference(path, moved, 10, seen));
  EXPECT_FALSE(readReference(path, room, 11, seen));
  std::ofstream(path, std::ios::binary) << "no image";
  EXPECT_ANY_THROW(readReference(path, room, 10, seen));
  fs::remove_all(folder);
}

TEST(RoomReference, OfDataAreRightAtSomePixels) {
  for (const auto& [name, widths] : std::vector<std::pair<std::string, std::vector<std::size_t>>>{
           {"cornell_box", {96, 256}}, {"indirect_penumbra", {96, 256}}}) {
    const Room room = dataRoom(name);
    const bool is_box = room.name == "cornell_box";
    const SurfaceRadiance radiance = is_box ? lightOfCornellBox() : DirectLight(room).tabulated(2);
    const SliceQuadrature quadrature(room.polygons, radiance);
    for (const std::size_t width : widths) {
      const std::vector<SeenPoint> seen = seenPoints(room, width);
      const std::optional<RoomReference> reference =
          readReference(referencePath(kReferences, room, width), room, width, seen);
      ASSERT_TRUE(reference) << name << ' ' << width << ": make it by generate_room_references";
      double mean = 0.0;
      for (const SliceIrradiance& value : reference->values) {
        mean += value.irradiance / static_cast<double>(seen.size());
      }
      EXPECT_GT(reference->rms_error, 0.0);
      EXPECT_LT(reference->rms_error, 5e-5 * mean);
      for (std::size_t k = 0; k < 12; ++k) {
        const std::size_t i = (k * seen.size() + seen.size() / 3) / 12;
        const SliceIrradiance found = quadrature.at(seen[i].receiver);
        // Stored as floats. Not to the bit: another machine may round sines otherwise, and an adaptive rule halve
        // another panel.
        EXPECT_NEAR(reference->values[i].irradiance, found.irradiance, 2e-5 * mean) << name << ' ' << width << ' ' << i;
        EXPECT_LT((reference->values[i].gradient - found.gradient).norm(), 1e-2 * mean);
      }
    }
  }
}

}  // namespace
}  // namespace irradiff
