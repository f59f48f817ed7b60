#pragma once

#include "experiments/cache/record_field.h"
#include "experiments/cache_2d/gather.h"
#include "experiments/cache_2d/interval_search.h"
#include "experiments/cache_2d/wall_receivers.h"

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace irradiff {

/// Records at receivers along walls, for any metric: every receiver's gather and what its view predicts around it.
class FlatlandRecords {
 public:
  explicit FlatlandRecords(std::shared_ptr<const WallReceivers> walls);

  /// Gathers at a receiver, which any thread may do once.
  void gatherAt(const LitRoom& room, std::size_t receiver);

  const FlatlandGather& gatherOf(std::size_t receiver) const { return gathers_[receiver]; }
  Receiver receiver(std::size_t receiver) const;

  static std::vector<std::string> metrics();
  /// Throws as RecordField::records. Keeps `records`.
  static RecordMaker maker(std::shared_ptr<const FlatlandRecords> records, const MetricChoice& choice);

  /// Half the length of the interval in which a record is used; m.
  double halfLength(std::size_t receiver, const MetricChoice& choice) const;

  /// The true error of a record, integrated over its interval; W.
  double trueError(std::size_t receiver, double half_length) const;

 private:
  double hessianLength(std::size_t receiver, const MetricChoice& choice) const;
  double searchedLength(std::size_t receiver, const MetricChoice& choice) const;
  /// At all receivers before or after one on its line.
  SideError trueErrors(std::size_t receiver, bool is_after) const;
  SideError predictedErrors(const LitRoom& room, std::size_t receiver, bool is_after) const;

  std::shared_ptr<const WallReceivers> walls_;
  std::vector<FlatlandGather> gathers_;
  std::vector<std::array<SideError, 2>> predictions_;  ///< before and after
};

}  // namespace irradiff
