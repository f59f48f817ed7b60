#pragma once

#include "experiments/cache_2d/gather.h"

#include <vector>

namespace irradiff {

/// What a record's view says of the irradiance at other places of its line: the pieces of walls it sees, with their
/// radiance, and what may be behind what hides them, seen again from there. The gap between the end of what hides a
/// wall and the wall is closed along the sight line and has the radiance with which the wall ends, as gaps of the mesh
/// of Schwarzhaupt et al. 2012, Figure 2 (D), have that of their farther end. All of it is black from behind.
/// docs/derivations/flatland_bounce.md, section 6.
class FlatlandReprojection {
 public:
  FlatlandReprojection(const LitRoom& room, std::size_t side, const Eigen::Vector2d& position);

  /// Predicted irradiance at a step along the tangent of the side; W/m. 0 on a surface that the record sees.
  double irradiance(double step) const;

 private:
  struct Seen {
    std::size_t side;    ///< of the room; kGap for a gap
    double radiance;     ///< of a gap
    double along = 0.0;  ///< coordinate of the segment's first vertex on the side
  };
  static constexpr std::size_t kGap = static_cast<std::size_t>(-1);

  bool isOnSegment(const Eigen::Vector2d& position) const;
  void addSegment(const Eigen::Vector2d& first, const Eigen::Vector2d& last, const Seen& seen);

  const LitRoom& room_;
  FlatlandFrame frame_;
  std::vector<Segment> segments_;  ///< counterclockwise as the record sees them: it is on their left
  std::vector<Seen> seen_;
  std::vector<std::size_t> all_;
};

}  // namespace irradiff
