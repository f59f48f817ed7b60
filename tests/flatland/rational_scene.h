#pragma once

#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"

#include <boost/multiprecision/gmp.hpp>
#include <boost/multiprecision/mpfr.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace irradiff {

using Rational = boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;
/// 150 digits: second differences at steps of 2^-130 leave 70 of them.
using ManyDigits =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<150>, boost::multiprecision::et_off>;

struct RationalPoint {
  Rational x, y;
};

RationalPoint exactly(const Eigen::Vector2d& p);

/// What is seen between two directions, counterclockwise.
struct RationalInterval {
  std::size_t segment;  ///< kNothing: the background
  RationalPoint from, to;
};

inline constexpr std::size_t kNothing = static_cast<std::size_t>(-1);

/// The brute-force oracle of visibility in flatland, without a rounding and without any of the library's code: every
/// end, every crossing of two segments and the horizon cut the half circle into intervals, and in the middle of each
/// the ray is intersected with every segment. Of segments that are equally far the first counts. O(n^3).
class RationalScene {
 public:
  /// Segments on which the receiver lies (`own`, by index) are left out.
  RationalScene(std::span<const Segment> segments, const FlatlandReceiver& receiver, std::span<const std::size_t> own);

  struct Sight {
    std::vector<RationalInterval> intervals;  ///< neighbours of one segment joined
    bool has_tie;                             ///< segments of different radiance lie on one line and overlap in view
    ManyDigits irradiance() const;            ///< E = sum L n.(-J (w_to - w_from)) over the intervals

    const RationalScene* scene;
  };

  /// From the receiver moved by `step`.
  Sight visible(const RationalPoint& step = {0, 0}) const;

  /// The derivative of E when the normal turns counterclockwise, by a central difference over visibility anew.
  ManyDigits rotationalGradient() const;

  /// The smallest distance of the receiver from a line through two of the points that may become ends of what is seen
  /// (ends and crossings), and from the horizon of any of them. No visibility event is nearer.
  double distanceFromEvents() const;

 private:
  struct Line {
    std::size_t index;
    RationalPoint a, b;
    double radiance;
  };

  void addScenePoints();
  std::size_t nearestAlong(const RationalPoint& position, const RationalPoint& direction, bool& has_tie) const;
  std::vector<RationalInterval> pieces(const RationalPoint& position, bool& has_tie) const;

  std::vector<Line> lines_;
  std::vector<RationalPoint> points_;  ///< ends and crossings
  std::vector<double> radiances_;
  RationalPoint position_, normal_;
};

}  // namespace irradiff
