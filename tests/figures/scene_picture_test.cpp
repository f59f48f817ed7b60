#include "experiments/figures/scene_picture.h"

#include "experiments/figures/colour_maps.h"
#include "experiments/figures/derivative_map.h"
#include "tests/cli/program_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>

namespace irradiff {
namespace {

constexpr std::size_t kSize = 96;

/// The picture of a scene of data/scenes.
RgbImage pictureOf(const std::string& name) {
  Scene scene = parseScene(readFile("data/scenes/" + name));
  ReceiverGrid grid = *scene.grid;
  grid.width = grid.height = 24;
  const DerivativeMap map = derivativeMap(grid, viewEvaluator(scene.polygons), 2);
  return scenePicture(scene, map, kSize);
}

std::ptrdiff_t pixelsOf(const RgbImage& image, const Rgb& colour) { return std::ranges::count(image.pixels, colour); }

/// The mean row of the pixels of a colour, from the top.
double meanRow(const RgbImage& image, const Rgb& colour) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t row = 0; row < image.height; ++row) {
    for (std::size_t column = 0; column < image.width; ++column) {
      if (!(image.at(column, row) == colour)) continue;
      sum += static_cast<double>(row);
      ++count;
    }
  }
  return sum / count;
}

TEST(ScenePicture, ShowsTheEmitterAboveTheOccludersAboveTheShadows) {
  const RgbImage image = pictureOf("figure5.json");
  const Rgb emitter = sequentialColour(0.95);
  const Rgb occluder{52, 62, 80};
  const Rgb umbra = sequentialColour(0.0);
  ASSERT_GT(pixelsOf(image, emitter), 20);
  ASSERT_GT(pixelsOf(image, occluder), 20);
  ASSERT_GT(pixelsOf(image, umbra), 20);
  EXPECT_LT(meanRow(image, emitter), meanRow(image, occluder));
  EXPECT_LT(meanRow(image, occluder), meanRow(image, umbra));
  // Nothing reaches the border of the picture, all around.
  const Rgb background = image.at(0, 0);
  for (std::size_t i = 0; i < kSize; ++i) {
    for (const Rgb& pixel : {image.at(i, 0), image.at(i, kSize - 1), image.at(0, i), image.at(kSize - 1, i)}) {
      EXPECT_EQ(pixel, background);
    }
  }
}

TEST(ScenePicture, LooksIntoAClosedBox) {
  const RgbImage image = pictureOf("black_square_in_box.json");
  // The black square, and the floor below it, which is darker in the middle than at its rim.
  EXPECT_GT(pixelsOf(image, {52, 62, 80}), 50);
  EXPECT_GT(pixelsOf(image, sequentialColour(0.95)), 500) << "the far walls";
}

}  // namespace
}  // namespace irradiff
