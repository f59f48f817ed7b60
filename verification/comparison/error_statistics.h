#pragma once

#include <cmath>
#include <cstddef>

namespace irradiff {

/// Peak and root mean square of errors, and which input was the worst. A NaN is the worst there is.
class ErrorStatistics {
 public:
  void add(double error, std::size_t input) {
    const bool worse = count_ == 0 || std::isnan(error) || (!std::isnan(peak_) && error > peak_);
    if (worse) {
      peak_ = error;
      worst_input_ = input;
    }
    sum_of_squares_ += error * error;
    ++count_;
  }

  std::size_t count() const { return count_; }
  double peak() const { return peak_; }
  double rootMeanSquare() const { return count_ == 0 ? 0.0 : std::sqrt(sum_of_squares_ / static_cast<double>(count_)); }
  /// Index passed with the peak error. Requires count() > 0.
  std::size_t worstInput() const { return worst_input_; }

 private:
  std::size_t count_ = 0;
  double peak_ = 0.0;
  double sum_of_squares_ = 0.0;
  std::size_t worst_input_ = 0;
};

}  // namespace irradiff
