#pragma once

#include "experiments/cache/cache_record.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace irradiff {

inline constexpr double kDefaultNormalDeviation = 0.2;  ///< rad; Section 4.3 of [Schwarzhaupt et al. 2012]

// The distance t_x of Eq. (17): 1 on the border of the record's region. The component along the record's normal counts
// in units of the shorter half-axis (the paper: of R^lambda1, which is the shorter one).
double translationalDistance(const CacheRecord& record, const Eigen::Vector3d& position);

// The weight of Eqs. (16) to (18): a tent in translation times one in the cosine of the angle between the normals; 0
// where the record does not serve the receiver, either tent being 0 or less. 1 at the record itself, exactly.
double weight(const CacheRecord& record, const Receiver& receiver, double normal_deviation);

// One term of Eq. (15): E_i + grad E_i.dx + g_i.(n_i x n) (+ dx^T H dx/2 for a record of second order).
double extrapolated(const CacheRecord& record, const Receiver& receiver);

/// Records and where they are valid, in a tree of boxes. docs/derivations/irradiance_cache.md.
class IrradianceCache {
 public:
  /// Throws std::invalid_argument naming the angle unless it is in (0, pi/2].
  explicit IrradianceCache(double normal_deviation = kDefaultNormalDeviation);
  ~IrradianceCache();
  IrradianceCache(IrradianceCache&&) noexcept;
  IrradianceCache& operator=(IrradianceCache&&) noexcept;

  /// Throws std::invalid_argument naming the record by its number, the quantity and the rule: a half-axis that is not
  /// positive, anything else that is not finite. So a record always serves its own receiver.
  void add(const CacheRecord& record);

  /// Eq. (15): nothing if no record serves the receiver. Sums run in the order in which records were added, so that the
  /// result does not depend on the tree. Negative results become 0.
  std::optional<double> interpolate(const Receiver& receiver) const;

  /// Whether `interpolate` has a result, in less time.
  bool serves(const Receiver& receiver) const;

  const std::vector<CacheRecord>& records() const;

  /// Scales the region of a record, keeping its shape, so that its shorter half-axis is at most `radius` > 0. A region
  /// without any border becomes a circle.
  void shrink(std::size_t record, double radius);

  /// Numbers of the records whose region contains the point, whatever its normal, ascending.
  std::vector<std::size_t> recordsAround(const Eigen::Vector3d& position) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace irradiff
