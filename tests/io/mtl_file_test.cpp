#include "experiments/io/mtl_file.h"

#include "experiments/io/obj_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;
using testing::ThrowsMessage;

MaterialRadiances radiancesOf(const std::string& text) {
  std::istringstream stream(text);
  MaterialRadiances radiances;
  readMtlFile(stream, "room.mtl", radiances);
  return radiances;
}

TEST(Luminance, IsThatOfRec709AndExactWhereAllAreEqual) {
  EXPECT_EQ(luminance(1, 0, 0), 0.2126);
  EXPECT_EQ(luminance(0, 1, 0), 0.7152);
  EXPECT_EQ(luminance(0, 0, 1), 0.0722);
  for (const double value : {0.0, 0.1, 1e308}) EXPECT_EQ(luminance(value, value, value), value);
  // The sum of the three products alone would miss some.
  std::size_t missed = 0;
  for (int i = 1; i <= 100; ++i) {
    const double value = i / 7.0;
    EXPECT_EQ(luminance(value, value, value), value);
    missed += 0.2126 * value + 0.7152 * value + 0.0722 * value != value ? 1 : 0;
  }
  EXPECT_GT(missed, 0U);
}

TEST(MtlFile, TakesRadianceFromKe) {
  EXPECT_THAT(radiancesOf("newmtl lamp\nKd 1 1 1\nKe 12.345 12.345 12.345 # warm\n\n"
                          "newmtl red wall\nKd 0.6 0 0\nNs 10\nnewmtl sky\nKe 1 2 3\n"),
              ElementsAre(Pair("lamp", 12.345), Pair("red wall", 0.0), Pair("sky", luminance(1, 2, 3))));
  EXPECT_THAT(radiancesOf("newmtl lamp\nKe 0.1"), ElementsAre(Pair("lamp", 0.1)));
  EXPECT_THAT(radiancesOf(""), IsEmpty());
}

TEST(MtlFile, MayRepeatAMaterialThatIsTheSame) {
  EXPECT_THAT(radiancesOf("newmtl a\nKe 1 1 1\nnewmtl a\nKe 1"), ElementsAre(Pair("a", 1.0)));
  EXPECT_THAT([] { radiancesOf("newmtl a\nKe 1 1 1\nnewmtl a\nKe 2 2 2"); },
              ThrowsMessage<ObjFileError>("room.mtl: line 3: material \"a\" has radiance 2, and one of that name has 1 "
                                          "already, must have one radiance"));
}

struct Refused {
  std::string line;
  std::string message;
};

TEST(MtlFile, RefusesWhatIsNoConstantRadiance) {
  const std::vector<Refused> lines{
      {"Ke", "Ke: has 0 numbers, must have 1 or 3"},
      {"Ke 1 2", "Ke: has 2 numbers"},
      {"Ke 1 2 3 4", "Ke: has 4 numbers"},
      {"Ke 1 nan 1", "Ke: expected a finite number, got \"nan\""},
      {"Ke 1 1 1e999", "Ke: number out of range: \"1e999\""},
      {"Ke 1 -0.5 1", "Ke: is \"-0.5\", must be >= 0"},
      {"Ke spectral lamp.rfl 2", "Ke: expected a finite number, got \"spectral\""},
      {"Ke xyz 1 1 1", "Ke: expected a finite number, got \"xyz\""},
      {"map_Ke screen.png", "map_Ke is the texture \"screen.png\", radiance must be constant"},
  };
  for (const Refused& refused : lines) {
    EXPECT_THAT([&] { radiancesOf("newmtl lamp\nKd 1 1 1\n" + refused.line); },
                ThrowsMessage<ObjFileError>(HasSubstr("room.mtl: line 3: material \"lamp\": " + refused.message)));
  }
  EXPECT_THAT([] { radiancesOf("Ke 1 1 1"); },
              ThrowsMessage<ObjFileError>("room.mtl: line 1: Ke before the first newmtl"));
}

}  // namespace
}  // namespace irradiff
