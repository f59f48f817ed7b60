#include "derivatives/estimators/jump_lattice.h"

#include "derivatives/estimators/radiance_regions.h"
#include "derivatives/samples/strata.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace irradiff {

namespace {

/// Cells are parted at most so often: then they are 2^-12 of the first ones.
constexpr int kMostLevels = 12;

/// Cells around junctions are parted so often more than others.
constexpr int kLevelsAtJunctions = 4;

/// What is left between the outermost nodes and the horizon, in cells.
constexpr double kMargin = 0.05;

/// New rays that parting a cell takes: the middle and four sides, of which most are shared; cells beside are parted as
/// well where boundaries must be closed.
constexpr double kRaysForParting = 4.0;

/// Rays for each jump that are kept for narrowing it down.
constexpr double kRaysForNarrowing = 3.0;

/// Of the rays beyond the first 256, kept for edges and corners: with few rays, a lattice that sees them comes first.
constexpr double kShareForEdges = 0.1;
constexpr double kRaysForSeeing = 256.0;

/// Of a node, in units of the finest level.
struct Place {
  std::int32_t column, row;
};

/// A square of the lattice; coordinates of its first corner.
struct Cell {
  std::int32_t column, row;
  int level;
};

class Lattice {
 public:
  Lattice(RayBudget& rays, std::size_t nodes_along_side, double rotation)
      : rays_(rays),
        count_(static_cast<std::int32_t>(nodes_along_side)),
        cosine_(std::cos(rotation)),
        sine_(std::sin(rotation)),
        square_(Stratification::kConcentric, {1, 1}) {}

  LatticeView view() {
    LatticeView result;
    castFirstNodes(result);
    if (is_constant_by_parts_) {
      while (canRefine()) refine();
      for (int i = 0; i < kLevelsAtJunctions && level_ + 1 < kMostLevels && refineAtJunctions(); ++i) {
      }
    }
    buildGraph(result.graph);
    return result;
  }

 private:
  static std::int32_t side(int level) { return std::int32_t{1} << (kMostLevels - level); }

  /// Number of the node, which is cast if it was not yet.
  std::size_t node(std::int32_t column, std::int32_t row) {
    const auto [found, is_new] = node_at_.try_emplace(key(column, row), nodes_.size());
    if (is_new) {
      nodes_.push_back(rays_.cast(direction(column, row)));
      places_.push_back({column, row});
      region_radiance_.push_back(nodes_.back().radiance);
    }
    return found->second;
  }

  std::optional<std::size_t> castNode(std::int32_t column, std::int32_t row) const {
    const auto found = node_at_.find(key(column, row));
    if (found == node_at_.end()) return std::nullopt;
    return found->second;
  }

  static std::int64_t key(std::int32_t column, std::int32_t row) {
    return (static_cast<std::int64_t>(row) << 32) | static_cast<std::int64_t>(column);
  }

  double coordinate(std::int32_t place) const {
    return (static_cast<double>(place) / side(0) + kMargin) / (count_ - 1 + 2.0 * kMargin);
  }

  Eigen::Vector3d direction(std::int32_t column, std::int32_t row) const {
    const Eigen::Vector3d w = square_.direction({0, 0, coordinate(column), coordinate(row)});
    return {cosine_ * w(0) - sine_ * w(1), sine_ * w(0) + cosine_ * w(1), w(2)};
  }

  void castFirstNodes(LatticeView& result) {
    const double cell = 1.0 / (count_ - 1 + 2.0 * kMargin);
    const auto width = [&](std::int32_t i) { return i == 0 || i + 1 == count_ ? (0.5 + kMargin) * cell : cell; };
    for (std::int32_t row = 0; row < count_; ++row) {
      for (std::int32_t column = 0; column < count_; ++column) {
        node(column * side(0), row * side(0));
        result.projected_solid_angles.push_back(std::numbers::pi * width(column) * width(row));
      }
    }
    result.nodes_along_side = static_cast<std::size_t>(count_);
    result.nodes = nodes_;
    const std::vector<double> radiance = region_radiance_;
    const auto count = static_cast<std::size_t>(count_);
    region_radiance_ = regionRadiance(radiance, [count](const NeighbourVisitor& visit) {
      for (std::size_t i = 0; i < count * count; ++i) {
        if (i % count > 0) visit(i - 1, i);
        if (i >= count) visit(i - count, i);
      }
    });
    is_constant_by_parts_ = region_radiance_ == radiance;
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      result.smooth_radiance.push_back(radiance[i] - region_radiance_[i]);
    }
    for (std::int32_t row = 0; row + 1 < count_; ++row) {
      for (std::int32_t column = 0; column + 1 < count_; ++column) {
        sortCell({column * side(0), row * side(0), 0}, mixed_);
      }
    }
  }

  std::array<std::size_t, 4> corners(const Cell& cell) {
    const std::int32_t s = side(cell.level);
    return {node(cell.column, cell.row), node(cell.column + s, cell.row), node(cell.column + s, cell.row + s),
            node(cell.column, cell.row + s)};
  }

  /// Among those with a jump between two corners, or those without.
  void sortCell(const Cell& cell, std::vector<Cell>& mixed) {
    const std::array<std::size_t, 4> nodes = corners(cell);
    const bool is_mixed = std::any_of(nodes.begin(), nodes.end(),
                                      [&](std::size_t i) { return region_radiance_[i] != region_radiance_[nodes[0]]; });
    (is_mixed ? mixed : uniform_).push_back(cell);
  }

  double raysForEdges() const {
    return kShareForEdges * std::max(0.0, static_cast<double>(rays_.all()) - kRaysForSeeing);
  }

  bool canRefine() const {
    const auto count = static_cast<double>(mixed_.size());
    // A boundary through n cells passes through about 2 n of half the size.
    const double rays = kRaysForParting * count + kRaysForNarrowing * 2.0 * count + raysForEdges();
    return level_ + 1 < kMostLevels && count > 0.0 && rays <= static_cast<double>(rays_.left());
  }

  void refine() {
    ++level_;
    std::vector<Cell> cells;
    cells.swap(mixed_);
    for (const Cell& cell : cells) part(cell, level_);
    closeBoundaries();
  }

  /// Parts cells around which radiance jumps more than twice: those where regions meet, and where more than one
  /// boundary passes. Whether there were any.
  bool refineAtJunctions() {
    std::vector<Cell> at_junctions, others;
    for (const Cell& cell : mixed_) (jumpsAround(cell) > 2 ? at_junctions : others).push_back(cell);
    if (at_junctions.empty()) return false;
    ++level_;
    mixed_ = std::move(others);
    for (const Cell& cell : at_junctions) {
      if (canPart()) {
        part(cell, cell.level + 1);
      } else {
        mixed_.push_back(cell);
      }
    }
    closeBoundaries();
    return true;
  }

  bool canPart() const {
    return static_cast<double>(rays_.left()) >
           kRaysForNarrowing * static_cast<double>(mixed_.size()) + kMostNewNodes + raysForEdges();
  }

  /// What was parted may show jumps on the sides of cells that were not: those are parted as well.
  void closeBoundaries() {
    bool has_found = true;
    while (has_found) {
      has_found = false;
      std::vector<Cell> cells;
      cells.swap(uniform_);
      for (const Cell& cell : cells) {
        if (cell.level < level_ && jumpsAround(cell) > 0 && rays_.left() >= kMostNewNodes) {
          part(cell, cell.level + 1);
          has_found = true;
        } else {
          uniform_.push_back(cell);
        }
      }
    }
  }

  /// Into cells of a level, where they have jumps.
  void part(const Cell& cell, int level) {
    if (cell.level == level) {
      mixed_.push_back(cell);
      return;
    }
    const std::int32_t s = side(cell.level + 1);
    std::vector<Cell> mixed_parts;
    for (const auto& [column, row] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
      sortCell({cell.column + column * s, cell.row + row * s, cell.level + 1}, mixed_parts);
    }
    for (const Cell& mixed_part : mixed_parts) part(mixed_part, level);
  }

  /// Numbers of all nodes on a cell's sides, in order from its first corner. A side beside finer cells has more than
  /// its ends.
  std::vector<std::size_t> nodesAround(const Cell& cell) const {
    const std::int32_t s = side(cell.level);
    const Place first{cell.column, cell.row};
    const Place second{cell.column + s, cell.row};
    const Place third{cell.column + s, cell.row + s};
    const Place fourth{cell.column, cell.row + s};
    std::vector<std::size_t> around;
    addSide(first, second, around);
    addSide(second, third, around);
    addSide(third, fourth, around);
    addSide(fourth, first, around);
    return around;
  }

  /// The nodes from `start` on to the one before `end`. A finer cell beside has the middle of the side for a node.
  void addSide(const Place& start, const Place& end, std::vector<std::size_t>& around) const {
    if (std::abs(end.column - start.column) + std::abs(end.row - start.row) > 1) {
      const Place middle{(start.column + end.column) / 2, (start.row + end.row) / 2};
      if (castNode(middle.column, middle.row)) {
        addSide(start, middle, around);
        addSide(middle, end, around);
        return;
      }
    }
    if (const auto found = castNode(start.column, start.row)) around.push_back(*found);
  }

  int jumpsAround(const Cell& cell) const {
    const std::vector<std::size_t> around = nodesAround(cell);
    int jumps = 0;
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (region_radiance_[around[i]] != region_radiance_[around[(i + 1) % around.size()]]) ++jumps;
    }
    return jumps;
  }

  void buildGraph(JumpGraph& graph) {
    graph.horizon_radiance = region_radiance_.front();
    std::unordered_map<std::int64_t, std::size_t> jump_between;
    for (const Cell& cell : mixed_) {
      const std::vector<std::size_t> around = nodesAround(cell);
      std::vector<std::size_t> crossed;
      for (std::size_t i = 0; i < around.size(); ++i) {
        const auto [first, second] = std::minmax(around[i], around[(i + 1) % around.size()]);
        if (region_radiance_[first] == region_radiance_[second]) continue;
        const std::int64_t pair = (static_cast<std::int64_t>(first) << 32) | static_cast<std::int64_t>(second);
        const auto [found, is_new] = jump_between.try_emplace(pair, graph.jumps.size());
        if (is_new) {
          graph.jumps.push_back({nodes_[first], nodes_[second], region_radiance_[first], region_radiance_[second]});
          if (isOnRim(first, second)) graph.rim.push_back(found->second);
        }
        crossed.push_back(found->second);
      }
      link(around, crossed, graph);
    }
  }

  bool isOnRim(std::size_t a, std::size_t b) const {
    const std::int32_t last = (count_ - 1) * side(0);
    const auto are = [](std::int32_t x, std::int32_t y, std::int32_t value) { return x == value && y == value; };
    const Place& p = places_[a];
    const Place& q = places_[b];
    return are(p.column, q.column, 0) || are(p.column, q.column, last) || are(p.row, q.row, 0) ||
           are(p.row, q.row, last);
  }

  void link(const std::vector<std::size_t>& around, const std::vector<std::size_t>& crossed, JumpGraph& graph) {
    if (crossed.size() == 2) {
      graph.links.push_back({crossed[0], crossed[1]});
      return;
    }
    const auto [least, most] = std::minmax_element(around.begin(), around.end(), [this](std::size_t a, std::size_t b) {
      return region_radiance_[a] < region_radiance_[b];
    });
    const double low = region_radiance_[*least];
    const double high = region_radiance_[*most];
    const bool are_two = std::all_of(around.begin(), around.end(), [&](std::size_t i) {
      return region_radiance_[i] == low || region_radiance_[i] == high;
    });
    if (crossed.size() != 4 || !are_two || rays_.left() == 0) {
      graph.junctions.push_back(crossed);
      return;
    }
    // Two boundaries, which cut off the corners of the one region or those of the other. Between the first two jumps
    // the nodes are of another region than the first node.
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::size_t i : around) sum += nodes_[i].direction;
    const double middle = rays_.cast(sum.normalized()).radiance;
    const double first = region_radiance_[around.front()];
    const double other = first == low ? high : low;
    const std::size_t shift = std::abs(middle - first) <= std::abs(middle - other) ? 0 : 1;
    graph.links.push_back({crossed[shift], crossed[shift + 1]});
    graph.links.push_back({crossed[shift + 2], crossed[(shift + 3) % 4]});
  }

  /// At least what parting a cell takes.
  static constexpr std::size_t kMostNewNodes = 5;

  RayBudget& rays_;
  std::int32_t count_;
  double cosine_, sine_;
  Strata square_;
  std::unordered_map<std::int64_t, std::size_t> node_at_;
  std::vector<SeenPoint> nodes_;
  std::vector<Place> places_;  ///< of the nodes
  std::vector<double> region_radiance_;
  bool is_constant_by_parts_ = false;
  int level_ = 0;
  std::vector<Cell> mixed_, uniform_;
};

void requireAtLeastZero(const char* what, double value, const Eigen::Vector3d& direction) {
  if (std::isfinite(value) && value >= 0.0) return;
  std::ostringstream message;
  message << "discontinuity estimator: the ray in the direction [" << direction(0) << ", " << direction(1) << ", "
          << direction(2) << "] has the " << what << ' ' << value << ", must be finite and at least 0";
  throw std::invalid_argument(message.str());
}

}  // namespace

SeenPoint RayBudget::cast(const Eigen::Vector3d& direction) {
  ++used_;
  const RayHit hit = query_(direction);
  requireAtLeastZero("inverse distance", hit.inverse_distance, direction);
  requireAtLeastZero("radiance", hit.radiance, direction);
  return {direction, hit.inverse_distance, hit.radiance};
}

LatticeView viewThroughLattice(RayBudget& rays, std::size_t nodes_along_side, double rotation) {
  return Lattice(rays, nodes_along_side, rotation).view();
}

}  // namespace irradiff
