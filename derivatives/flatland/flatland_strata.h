#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace irradiff {

/// How the half circle of directions above a flatland receiver is divided into strata, numbered counterclockwise. A
/// right-handed frame (tangent t, normal n) names the directions: from t over n to -t.
/// - cosine: all strata have the same projected angle, the integral of n.w; they are equally wide in w.t. The
///   counterpart of polar and concentric strata;
/// - square: texels of equal length on the sides +t, top and -t of the half square |x| <= 1, 0 <= y <= 1. The
///   counterpart of the hemicube; resolution n, the number of texels on the top, makes 2 n strata.
enum class FlatlandStratification { kCosine, kSquare };

/// Most strata there may be.
inline constexpr std::size_t kMostFlatlandStrata = std::size_t{1} << 24;

/// The map from strata to directions, in the frame (t, n).
class FlatlandStrata {
 public:
  /// Throws std::invalid_argument naming the count and the rule unless it is positive, at most kMostFlatlandStrata, and
  /// for a square a multiple of 4.
  FlatlandStrata(FlatlandStratification stratification, std::size_t count);

  FlatlandStratification stratification() const { return stratification_; }
  std::size_t count() const { return count_; }

  /// Unit direction at `along`, from 0 to 1 counterclockwise through the stratum; n component >= 0.
  Eigen::Vector2d direction(std::size_t stratum, double along = 0.5) const;

  /// The count + 1 directions between which the strata are: stratum i is from border i counterclockwise to i + 1. The
  /// first is t, the last -t.
  std::vector<Eigen::Vector2d> borders() const;

 private:
  FlatlandStratification stratification_;
  std::size_t count_;
};

}  // namespace irradiff
