// What a receiver gathers, against RoomIntegral: rays in long double, differences of sixth order.

#include "experiments/cache_2d/gather.h"

#include "experiments/cache_2d/wall_receivers.h"
#include "tests/cache_2d/room_integral.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace irradiff {
namespace {

using Real = RoomIntegral::Real;
using Point = RoomIntegral::Point;

constexpr double kPromised = 1e-10;  // of the quadrature, as a share of the brightest emitter
constexpr double kSharp =
    1e-8;  // differences: what derivatives are asked to agree to, and what their steps disagree by

/// A derivative and what it may be wrong by: from steps h and h/2.
struct Difference {
  double value, error;
};

template <class Rule>
Difference difference(const Rule& rule, Real h) {
  const Real fine = rule(h / 2.0L);
  return {static_cast<double>(fine), static_cast<double>(std::abs(fine - rule(h)))};
}

/// Of sixth order, from f at -3h to 3h.
template <class Function>
Difference firstDerivative(const Function& f, Real h) {
  return difference(
      [&f](Real s) {
        return ((f(3 * s) - f(-3 * s)) / 60 - 3 * (f(2 * s) - f(-2 * s)) / 20 + 3 * (f(s) - f(-s)) / 4) / s;
      },
      h);
}

template <class Function>
Difference secondDerivative(const Function& f, Real h) {
  return difference(
      [&f](Real s) {
        return ((f(3 * s) + f(-3 * s)) / 90 - 3 * (f(2 * s) + f(-2 * s)) / 20 + 3 * (f(s) + f(-s)) / 2 -
                49 * f(0) / 18) /
               (s * s);
      },
      h);
}

/// Of sixth order, from f at 0 to 6h: where the horizon makes the second derivative one-sided.
template <class Function>
Difference oneSidedDerivative(const Function& f, Real h) {
  return difference(
      [&f](Real s) {
        return (-49 * f(0) / 20 + 6 * f(s) - 15 * f(2 * s) / 2 + 20 * f(3 * s) / 3 - 15 * f(4 * s) / 4 +
                6 * f(5 * s) / 5 - f(6 * s) / 6) /
               s;
      },
      h);
}

/// The term of the Hessian for what slides behind an edge.
double slideTerm(const LitRoom& room, const WallReceiver& receiver) {
  double sum = 0.0;
  for (const SeenPiece& piece : seenFrom(room, receiver.side, receiver.position)) {
    for (const bool is_last : {false, true}) {
      const SeenEnd& end = is_last ? piece.last : piece.first;
      const double slope = room.radianceBeside(room.sideOf(piece.segment, piece.is_right), end.along, is_last).slope;
      sum += (is_last ? 1.0 : -1.0) * slope * end.slide * (end.terms()[kSightAlong] - end.wallTerms()[kSightAlong]);
    }
  }
  return sum;
}

/// An L with walls askew, a lamp that begins in a corner and reflects, another that stands on the floor, boards that
/// cross, and much in line.
FlatlandRoom crossingRoom() {
  const auto p = [](double x, double y) { return Eigen::Vector2d(x, y); };
  FlatlandRoom room{"crossing", "", {}, {}};
  const auto add = [&room](const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radiance, double reflectance) {
    room.segments.push_back({"segment", {a, b}, radiance});
    room.reflectances.push_back(reflectance);
  };
  add(p(0.0, 0.0), p(3.0, 0.1), 0.0, 0.5);
  add(p(3.0, 0.1), p(3.0, 1.0), 0.0, 0.9);
  add(p(3.0, 1.0), p(1.0, 1.0), 0.0, 0.3);
  add(p(1.0, 1.0), p(1.0, 2.5), 0.0, 0.8);
  add(p(1.0, 2.5), p(0.5, 2.5), 4.0, 0.5);
  add(p(0.5, 2.5), p(0.0, 2.4), 0.0, 0.6);
  add(p(0.0, 2.4), p(0.0, 0.0), 0.0, 0.7);
  add(p(0.25, 1.0), p(0.75, 1.5), 0.0, 0.4);
  add(p(0.25, 1.5), p(0.75, 1.0), 0.0, 1.0);
  add(p(1.5, 0.05), p(1.5, 0.3), 2.0, 0.2);
  return room;
}

FlatlandRoom roomNamed(const std::string& name) {
  return name == "crossing" ? crossingRoom() : readFlatlandRoom("data/rooms/" + name + ".json");
}

class GatherIn : public testing::TestWithParam<const char*> {
 protected:
  GatherIn() : room_(roomNamed(GetParam())), integral_(room_), lit_(room_, false), walls_(lit_, 97) {
    for (const Segment& segment : room_.segments) brightest_ = std::max(brightest_, segment.radiance);
  }

  Point normalOf(const WallReceiver& r) const { return walls_.sides[r.side].normal.cast<Real>(); }

  FlatlandRoom room_;
  RoomIntegral integral_;
  LitRoom lit_;
  WallReceivers walls_;
  double brightest_ = 0.0;
};

TEST_P(GatherIn, IrradianceIsTheIntegralOverDirections) {
  double largest = 0.0;
  double largest_distance_error = 0.0;
  for (const WallReceiver& r : walls_.receivers) {
    const FlatlandGather gathered = gather(lit_, r.side, r.position);
    const double expected = static_cast<double>(integral_.indirect(r.position.cast<Real>(), normalOf(r)));
    const double error = std::abs(gathered.irradiance - expected);
    largest = std::max(largest, error);
    EXPECT_LE(error, kPromised * brightest_) << r.position.transpose();
    const double inverse = static_cast<double>(integral_.inverseDistance(r.position.cast<Real>(), normalOf(r)));
    largest_distance_error =
        std::max(largest_distance_error, std::abs(1.0 / gathered.harmonic_mean_distance / inverse - 1.0));
  }
  EXPECT_LE(largest_distance_error, 1e-11);
  std::cout << GetParam() << ": error of E at most " << largest << " at " << walls_.receivers.size()
            << " receivers, of the harmonic mean " << largest_distance_error << " of itself\n";
}

TEST_P(GatherIn, DirectLightIsTheIntegralOverDirections) {
  double largest = 0.0;
  std::size_t off_by_one_piece = 0;
  for (const WallReceiver& r : walls_.receivers) {
    const DirectLight& light = lit_.light(r.side);
    const WallSide& side = walls_.sides[r.side];
    // Also beside the borders, where the formula must be that of the right piece.
    std::vector<double> places{side.local(r.position).x()};
    for (const double border : light.borders()) {
      for (const double beside : {border - 1e-9, border + 1e-9}) {
        if (beside > 0.0 && beside < side.length) places.push_back(beside);
      }
    }
    for (const double place : places) {
      const double expected = static_cast<double>(
          integral_.direct(side.origin.cast<Real>() + Real(place) * side.tangent.cast<Real>(), normalOf(r)));
      const std::size_t piece = light.pieceAt(place);
      largest = std::max(largest, std::abs(light.at(piece, place).irradiance - expected));
      if (piece > 0 && std::abs(light.at(piece - 1, place).irradiance - expected) > 1e-6) ++off_by_one_piece;
    }
  }
  EXPECT_LE(largest, 1e-12 * brightest_);
  EXPECT_GT(off_by_one_piece, 10u) << "the formula of the piece before passes for right";
  std::cout << GetParam() << ": error of direct light at most " << largest << "\n";
}

TEST_P(GatherIn, DerivativesAreThoseOfTheIntegral) {
  double largest_first = 0.0;
  double largest_second = 0.0;
  double largest_across = 0.0;
  double largest_turn = 0.0;
  std::size_t sharp = 0;
  std::size_t sharp_around = 0;
  std::size_t tried = 0;
  std::size_t without_slide = 0;
  std::size_t unaware = 0;
  std::size_t flipped = 0;
  for (std::size_t i = 0; i < walls_.receivers.size(); i += 8) {
    const WallReceiver& r = walls_.receivers[i];
    const WallSide& side = walls_.sides[r.side];
    const double along = side.local(r.position).x();
    const double from_ends = std::min(along, side.length - along);
    const Point x = r.position.cast<Real>();
    const Point n = normalOf(r);
    const Point t(n.y(), -n.x());
    const FlatlandGather g = gather(lit_, r.side, r.position);
    const Real h = 0.006L * from_ends;
    const std::vector<std::size_t> behind = integral_.onLine(x, n);
    const auto moved = [&](Real step) { return integral_.indirect(x + step * t, n, behind); };
    const Difference first = firstDerivative(moved, h);
    const Difference second = secondDerivative(moved, h);
    ++tried;
    // Otherwise an event is between the places.
    if (second.error > kSharp || first.error > kSharp) continue;
    ++sharp;
    const auto isWrong = [&](double hessian) { return std::abs(hessian - second.value) > 1e-6; };
    largest_first = std::max(largest_first, std::abs(g.gradient.x() - first.value));
    largest_second = std::max(largest_second, std::abs(g.hessian - second.value));
    without_slide += isWrong(g.hessian - slideTerm(lit_, r)) ? 1 : 0;
    unaware += isWrong(g.unaware_hessian) ? 1 : 0;
    flipped += isWrong(g.hessian - 2.0 * slideTerm(lit_, r)) ? 1 : 0;
    const Difference turned = oneSidedDerivative(
        [&](Real angle) { return integral_.indirect(x, std::cos(angle) * n - std::sin(angle) * t, behind); }, 0.002L);
    const Difference lifted =
        oneSidedDerivative([&](Real step) { return integral_.indirect(x + step * n, n, behind); }, h);
    if (turned.error > kSharp || lifted.error > kSharp) continue;
    ++sharp_around;
    largest_turn = std::max(largest_turn, std::abs(g.turn - turned.value));
    largest_across = std::max(largest_across, std::abs(g.gradient.y() - lifted.value));
  }
  // As good as the differences are.
  EXPECT_LE(largest_first, kSharp);
  EXPECT_LE(largest_second, kSharp);
  EXPECT_LE(largest_across, kSharp);
  EXPECT_LE(largest_turn, kSharp);
  EXPECT_GE(sharp, tried * 6 / 10);
  EXPECT_GE(sharp_around, tried * 6 / 10);
  EXPECT_GT(without_slide, sharp / 4);
  EXPECT_GT(unaware, sharp / 4);
  EXPECT_GT(flipped, sharp / 4);
  std::cout << GetParam() << ": " << sharp << " and " << sharp_around << " of " << tried << " receivers; off by "
            << largest_first << " (along), " << largest_across << " (across), " << largest_turn << " (turn), "
            << largest_second << " (second); wrong without what slides " << without_slide << ", unaware of occlusion "
            << unaware << "\n";
}

INSTANTIATE_TEST_SUITE_P(Rooms, GatherIn, testing::Values("flatland_lamp", "flatland_slot", "crossing"),
                         [](const auto& parameter) { return std::string(parameter.param); });

}  // namespace
}  // namespace irradiff
