#include "experiments/figures/tile_store.h"

#include "tests/cli/program_run.h"
#include "verification/report/result_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace irradiff {
namespace {

namespace fs = std::filesystem;
using Numbers = std::vector<double>;

TEST(TileStore, GivesBackWhatWasWritten) {
  const ScratchFolder scratch;
  const Numbers numbers{1.0, -0.0, 1e-310, 3.5};
  {
    const TileStore store(scratch.file("work"), "this");
    EXPECT_FALSE(store.read(0, 4));
    store.write(0, numbers);
    store.write(7, Numbers{2.0});
    EXPECT_EQ(store.read(0, 4), numbers);
  }
  const TileStore again(scratch.file("work"), "this");
  EXPECT_EQ(again.read(0, 4), numbers);
  EXPECT_EQ(again.read(7, 1), Numbers{2.0});
  EXPECT_FALSE(again.read(1, 4));
  EXPECT_FALSE(again.read(0, 3)) << "of another size";
}

TEST(TileStore, ForgetsWhatHasAnotherFingerprint) {
  const ScratchFolder scratch;
  {
    const TileStore store(scratch.file("work"), "this");
    store.write(0, Numbers{1.0});
  }
  {
    const TileStore other(scratch.file("work"), "that");
    EXPECT_FALSE(other.read(0, 1));
  }
  const TileStore store(scratch.file("work"), "this");
  EXPECT_FALSE(store.read(0, 1)) << "it was removed, not hidden";
}

TEST(TileStore, TakesUpNothingThatIsDamagedOrCutOff) {
  const ScratchFolder scratch;
  const TileStore store(scratch.file("work"), "this");
  store.write(0, Numbers{1.0, 2.0});
  const fs::path file = scratch.file("work") / "tile-0";
  const std::string whole = readFile(file);
  for (std::size_t place = 0; place < whole.size(); ++place) {
    std::string damaged = whole;
    damaged[place] = static_cast<char>(damaged[place] ^ 1);
    writeFile(file, damaged);
    EXPECT_FALSE(store.read(0, 2)) << "byte " << place;
    writeFile(file, whole.substr(0, place));
    EXPECT_FALSE(store.read(0, 2)) << place << " bytes";
  }
  writeFile(file, whole);
  EXPECT_TRUE(store.read(0, 2));
}

TEST(TileStore, LeavesFoldersOfOthersAlone) {
  const ScratchFolder scratch;
  fs::create_directory(scratch.file("work"));
  writeFile(scratch.file("work") / "thesis.txt", "three years");
  EXPECT_THROW(TileStore(scratch.file("work"), "this"), RefusedFolder);
  EXPECT_EQ(readFile(scratch.file("work") / "thesis.txt"), "three years");
  writeFile(scratch.file("file"), "");
  EXPECT_THROW(TileStore(scratch.file("file"), "this"), RefusedFolder);
}

TEST(TileStore, IsOfOneRunAtATime) {
  const ScratchFolder scratch;
  {
    const TileStore store(scratch.file("work"), "this");
    try {
      const TileStore second(scratch.file("work"), "this");
      FAIL() << "two runs in one folder";
    } catch (const RefusedFolder& refused) {
      EXPECT_THAT(refused.what(), testing::AllOf(testing::HasSubstr("work"), testing::HasSubstr("another run")));
    }
  }
  TileStore store(scratch.file("work"), "this");
  store.remove();
  EXPECT_FALSE(fs::exists(scratch.file("work")));
}

TEST(TileStore, StandsBesideTheOutput) {
  EXPECT_EQ(unfinishedFolder("/somewhere/out"), "/somewhere/out.part");
  EXPECT_EQ(unfinishedFolder("/somewhere/out/"), "/somewhere/out.part");
}

}  // namespace
}  // namespace irradiff
