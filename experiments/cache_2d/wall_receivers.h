#pragma once

#include "experiments/cache_2d/gather.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace irradiff {

/// The middle of a cell of a side.
struct WallReceiver {
  std::size_t side = 0;
  std::size_t cell = 0;  ///< number among all cells, along one side after the other
  double cell_length = 0.0;
  Eigen::Vector2d position;
  std::size_t line = 0;  ///< sides on one line with one normal share it
  std::size_t rank = 0;  ///< among the receivers of its line
  double along_line = 0.0;
};

/// Receivers along all sides on which light arrives, about `count`, in the order of the sides.
struct WallReceivers {
  WallReceivers(const LitRoom& room, std::size_t count);

  std::vector<WallSide> sides;  ///< of the room
  std::vector<WallReceiver> receivers;
  std::vector<std::vector<std::size_t>> lines;  ///< receivers of each line, ascending along it
  std::size_t cells = 0;
};

}  // namespace irradiff
