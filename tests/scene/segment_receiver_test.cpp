#include "derivatives/scene/invalid_scene.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace irradiff {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

auto refusesSegment(const Segment& segment) {
  return [segment] { validate(segment, 2); };
}

TEST(Segment, IsRefusedByNameValueAndRule) {
  EXPECT_THAT(refusesSegment({"wall", {{{1, 2}, {1, 2}}}, 1}),
              ThrowsMessage<InvalidScene>(
                  AllOf(StartsWith("segments[2] \"wall\": "), HasSubstr("vertex 1 (1, 2)"), HasSubstr("distinct"))));
  EXPECT_THAT(refusesSegment({"wall", {{{1, kNaN}, {1, 2}}}, 1}),
              ThrowsMessage<InvalidScene>(AllOf(HasSubstr("vertex 0 (1, nan)"), HasSubstr("must be finite"))));
  EXPECT_THAT(refusesSegment({"wall", {{{0, 0}, {1, 2}}}, -1}),
              ThrowsMessage<InvalidScene>(AllOf(HasSubstr("radiance is -1"), HasSubstr(">= 0"))));
  EXPECT_THAT(refusesSegment({"segment 2", {{{0, 0}, {1, 2}}}, kInfinity}),
              ThrowsMessage<InvalidScene>(StartsWith("segments[2]: radiance is inf")));
}

TEST(Segment, IsAcceptedAtAnyScale) {
  for (const double scale : {1e-320, 1e-150, 1.0, 1e150, 1e308}) {
    EXPECT_NO_THROW(validate(Segment{"wall", {{{0, 0}, {scale, scale}}}, 0}, 0)) << scale;
  }
}

TEST(Receiver, IsRefusedByIndexValueAndRule) {
  const auto refuses = [](const Receiver& receiver) { return [receiver] { validate(receiver, 4); }; };
  EXPECT_THAT(refuses({{kNaN, 0, 0}, {0, 0, 1}}),
              ThrowsMessage<InvalidScene>(AllOf(StartsWith("receiver 4: position (nan, 0, 0)"), HasSubstr("finite"))));
  EXPECT_THAT(refuses({{0, 0, 0}, {0, 0, kInfinity}}),
              ThrowsMessage<InvalidScene>(AllOf(HasSubstr("normal (0, 0, inf)"), HasSubstr("finite"))));
  EXPECT_THAT(
      refuses({{0, 0, 0}, {0, 0, 2}}),
      ThrowsMessage<InvalidScene>(AllOf(HasSubstr("normal (0, 0, 2) has length 2"), HasSubstr("1 within 1e-12"))));
  EXPECT_THAT(refuses({{0, 0, 0}, {0, 0, 0}}), ThrowsMessage<InvalidScene>(HasSubstr("has length 0")));
  EXPECT_THAT(refuses({{0, 0, 0}, {1e200, 0, 0}}), ThrowsMessage<InvalidScene>(HasSubstr("has length 1e+200")));
  EXPECT_THAT(refuses({{0, 0, 0}, {0, 0, 1 + 2e-12}}), ThrowsMessage<InvalidScene>(HasSubstr("1 within 1e-12")));
}

TEST(Receiver, IsAcceptedWithARoundedNormal) {
  EXPECT_NO_THROW(validate(Receiver{{1e150, 0, 0}, {0, 0, -1}}, 0));
  EXPECT_NO_THROW(validate(Receiver{{0, 0, 0}, {0, 0, 1 + 0.5e-12}}, 0));
  EXPECT_NO_THROW(validate(Receiver{{0, 0, 0}, Eigen::Vector3d(1, 2, 3).normalized()}, 0));
}

TEST(FlatlandReceiver, FollowsTheSameRules) {
  EXPECT_NO_THROW(validate(FlatlandReceiver{{0, 0}, {0.6, 0.8}}, 0));
  EXPECT_THAT(
      [] {
        validate(FlatlandReceiver{{0, 0}, {0.6, 0.9}}, 1);
      },
      ThrowsMessage<InvalidScene>(StartsWith("receiver 1: normal (0.6, 0.9) has length 1.08")));
}

}  // namespace
}  // namespace irradiff
