#include "experiments/figures/figure_columns.h"

#include "tests/figures/small_maps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace irradiff {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// Knows the gradient in the plane, half of it; the second also the Hessian in the plane.
std::vector<EstimateMap> halfGradients(std::size_t count) {
  EstimateValues values{};
  values.fill(kMissing);
  values[kEstimateE] = 1.0;
  values[kEstimateGradientX] = 0.5;
  values[kEstimateGradientY] = -1.0;
  EstimateValues more = values;
  more[kEstimateHessianXX] = 6.0;
  more[kEstimateHessianXY] = 0.0;
  more[kEstimateHessianYY] = 1.0;
  return {{"one", std::vector<EstimateValues>(count, values)}, {"two", std::vector<EstimateValues>(count, more)}};
}

TEST(FigureColumns, AreTheTruthAndThoseWhoKnowIt) {
  const DerivativeMap truth = plainMap(3, 2);
  const std::vector<FigureColumn> columns = figureColumns(truth, halfGradients(6));
  std::vector<std::string> names;
  for (const FigureColumn& column : columns) {
    names.push_back(column.picture.name);
    EXPECT_EQ(column.difference.has_value(), column.source != "analytic");
    EXPECT_EQ(column.errors.has_value(), column.source != "analytic");
  }
  EXPECT_THAT(names, testing::ElementsAre("gradient.analytic", "gradient.one", "gradient.two", "hessian.analytic",
                                          "hessian.two"));
  EXPECT_EQ(columns[1].difference->name, "gradient.one.difference");
  EXPECT_EQ(columns[1].errors->median, 0.5);
  EXPECT_EQ(columns[4].errors->median, 1.0);
  EXPECT_THAT(columns[1].channels, testing::ElementsAre("one.gradient.x", "one.gradient.y", "one.error.gradient"));
}

TEST(FigureColumns, LeaveOutWhatExistsNowhere) {
  DerivativeMap truth = plainMap(3, 2);
  for (MapChannel& channel : truth.channels) {
    if (channel.name.starts_with("hessian.")) channel.values.assign(6, kMissing);
  }
  for (const FigureColumn& column : figureColumns(truth, halfGradients(6))) {
    EXPECT_EQ(column.compared, Compared::kGradient) << column.picture.name;
  }
}

TEST(FigureColumns, HaveOneExposure) {
  const DerivativeMap truth = plainMap(3, 2);
  const std::vector<FigureColumn> columns = figureColumns(truth, halfGradients(6));
  // The limit is 2: dE/dx = 1 is at 3/4, dE/dy = -2 at 0.
  EXPECT_EQ(columns[0].picture.image.at(0, 0), (Rgb{191, 0, 128}));
  EXPECT_EQ(columns[1].picture.image.at(0, 0), (Rgb{159, 64, 128}));
  EXPECT_EQ(columns[1].difference->image.at(0, 0), (Rgb{96, 191, 128}));
  for (std::size_t i = 0; i < 3; ++i) {
    for (const ColourBar& bar : columns[i].picture.bars) EXPECT_EQ(bar.high, 2.0);
  }
  // That of the Hessian is 3, and 6 is beyond.
  EXPECT_EQ(columns[4].picture.bars[0].high, 3.0);
  EXPECT_EQ(columns[4].picture.image.at(0, 0).red, 255);
  EXPECT_THAT(columns[4].picture.scaling, testing::HasSubstr("33.33 % of the values are beyond"));
}

TEST(FigureColumns, GiveChannelsOfWhatIsKnown) {
  const DerivativeMap truth = plainMap(3, 2);
  std::vector<std::string> names;
  for (const MapChannel& channel : comparedChannels(truth, halfGradients(6))) {
    names.push_back(channel.name);
    EXPECT_EQ(channel.values.size(), 6U);
    if (channel.name == "two.error.hessian") {
      EXPECT_EQ(channel.values[5], 1.0);
    }
    if (channel.name == "one.gradient.y") {
      EXPECT_EQ(channel.values[5], -1.0);
    }
  }
  EXPECT_THAT(names, testing::ElementsAre("one.E", "one.gradient.x", "one.gradient.y", "one.error.gradient", "two.E",
                                          "two.gradient.x", "two.gradient.y", "two.hessian.xx", "two.hessian.xy",
                                          "two.hessian.yy", "two.error.gradient", "two.error.hessian"));
}

}  // namespace
}  // namespace irradiff
