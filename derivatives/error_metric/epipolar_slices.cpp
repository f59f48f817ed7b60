#include "derivatives/error_metric/epipolar_slices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

// Compiled for several generations of processors, of which the program takes the best that it finds; all of them do the
// same operations in the same order (experiments/ray_casting/ray_batch.cpp).
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define IRRADIFF_FOR_EACH_PROCESSOR __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define IRRADIFF_FOR_EACH_PROCESSOR
#endif

namespace irradiff {
namespace {

constexpr std::size_t kSlices = EpipolarGrid::kSlices;
constexpr std::size_t kCells = EpipolarGrid::kCells;
using Lanes = std::array<float, kSlices>;

/// In place of the cotangent of 0: what lies beyond has less than 10^-18 of the hemisphere.
constexpr float kEndCotangent = 1e6f;
/// Of a slice of projected solid angle, from the middle to an end.
constexpr float kHalfMeasure = 0.785398163f;
/// A parallax of more covers the whole slice after the shortest of steps; products stay finite.
constexpr float kMostParallax = 1e30f;

/// All slices together are as wide as the disk of projected directions.
constexpr double kSliceWidth = 2.0 / static_cast<double>(kSlices);
/// Neighbouring samples with distances in a greater ratio are on different surfaces.
constexpr float kEdgeRatio = 1.5f;

/// The projected solid angle between the middle of a slice and the cosine of the angle to the line of motion, for
/// slices of width 1: the integral of sqrt(1 - c^2) dc.
double measureOfCosine(double cosine) {
  return 0.5 * (cosine * std::sqrt((1.0 - cosine) * (1.0 + cosine)) + std::asin(cosine));
}

/// Its inverse, by bisection.
double cosineOfMeasure(double measure) {
  double low = -1.0;
  double high = 1.0;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (measureOfCosine(middle) < measure ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The cosine at a place in a slice, in cells from its end behind the receiver.
double cosineAt(double cells) {
  return cosineOfMeasure(0.25 * std::numbers::pi * (2.0 * cells / static_cast<double>(kCells) - 1.0));
}

/// Between the cells i - 1 and i; the first is not used.
struct Walls {
  Lanes cotangent{}, inverse_sine{}, sine_to_fourth{};

  Walls() {
    for (std::size_t i = 1; i < kCells; ++i) {
      const double cosine = cosineAt(static_cast<double>(i));
      const double square = (1.0 - cosine) * (1.0 + cosine);
      cotangent[i] = static_cast<float>(cosine / std::sqrt(square));
      inverse_sine[i] = static_cast<float>(1.0 / std::sqrt(square));
      sine_to_fourth[i] = static_cast<float>(square * square);
    }
  }
};
static_assert(kCells == kSlices, "Walls has as many entries as there are cells");

const Walls& walls() {
  static const Walls result;
  return result;
}

/// measureOfCosine for a cotangent, |.| <= kEndCotangent: pi/4 minus (1 - |c|)^(3/2) times a polynomial, which has the
/// least error of its degree, 2.7e-7.
[[gnu::always_inline]] inline float measureOfCotangent(float cotangent) {
  const float cosine = std::fabs(cotangent) / std::sqrt(1.0f + cotangent * cotangent);
  const float rest = 1.0f - cosine;
  const float factor =
      0.785398426f +
      cosine * (0.178074657f + cosine * (-0.0270827517f + cosine * (0.00837980193f - cosine * 0.00199284521f)));
  return std::copysign(kHalfMeasure - rest * std::sqrt(rest) * factor, cotangent);
}

/// What is seen, of each slice over its width, after a step ahead: of two walls that are seen in one direction then,
/// the one farther ahead now is the nearer. So walls are passed from ahead on, and what is ahead of the rearmost so far
/// is hidden.
IRRADIFF_FOR_EACH_PROCESSOR
void sumAhead(const float* cotangents, const float* parallax, const float* radiance, float distance, float* sums) {
  alignas(64) Lanes rearmost;
  alignas(64) Lanes measure;
  rearmost.fill(kEndCotangent);
  measure.fill(kHalfMeasure);
  for (std::size_t j = 0; j < kSlices; ++j) sums[j] = 0.0f;
  for (std::size_t i = kCells - 1; i > 0; --i) {
    const float* const wall_parallax = parallax + i * kSlices;
    const float* const cell_radiance = radiance + i * kSlices;
    for (std::size_t j = 0; j < kSlices; ++j) {
      const float place = std::max(cotangents[i] - distance * wall_parallax[j], -kEndCotangent);
      rearmost[j] = std::min(rearmost[j], place);
      const float next = measureOfCotangent(rearmost[j]);
      sums[j] += cell_radiance[j] * (measure[j] - next);
      measure[j] = next;
    }
  }
  for (std::size_t j = 0; j < kSlices; ++j) sums[j] += radiance[j] * (measure[j] + kHalfMeasure);
}

/// The same after a step back, `distance` being negative.
IRRADIFF_FOR_EACH_PROCESSOR
void sumBehind(const float* cotangents, const float* parallax, const float* radiance, float distance, float* sums) {
  alignas(64) Lanes foremost;
  alignas(64) Lanes measure;
  foremost.fill(-kEndCotangent);
  measure.fill(-kHalfMeasure);
  for (std::size_t j = 0; j < kSlices; ++j) sums[j] = 0.0f;
  for (std::size_t i = 1; i < kCells; ++i) {
    const float* const wall_parallax = parallax + i * kSlices;
    const float* const cell_radiance = radiance + (i - 1) * kSlices;
    for (std::size_t j = 0; j < kSlices; ++j) {
      const float place = std::min(cotangents[i] - distance * wall_parallax[j], kEndCotangent);
      foremost[j] = std::max(foremost[j], place);
      const float next = measureOfCotangent(foremost[j]);
      sums[j] += cell_radiance[j] * (next - measure[j]);
      measure[j] = next;
    }
  }
  const float* const last_radiance = radiance + (kCells - 1) * kSlices;
  for (std::size_t j = 0; j < kSlices; ++j) sums[j] += last_radiance[j] * (kHalfMeasure - measure[j]);
}

}  // namespace

EpipolarGrid::EpipolarGrid(const Strata& strata, double azimuth) : strata_(kCells * kSlices) {
  const double cosine = std::cos(azimuth);
  const double sine = std::sin(azimuth);
  for (std::size_t i = 0; i < kCells; ++i) {
    const double along = cosineAt(static_cast<double>(i) + 0.5);
    const double radius = std::sqrt((1.0 - along) * (1.0 + along));
    for (std::size_t j = 0; j < kSlices; ++j) {
      const double share = (2.0 * static_cast<double>(j) + 1.0) / static_cast<double>(kSlices) - 1.0;
      const double across = radius * share;
      const Eigen::Vector3d direction(along * cosine - across * sine, along * sine + across * cosine,
                                      radius * std::sqrt((1.0 - share) * (1.0 + share)));
      const StratumPosition position = strata.position(direction);
      strata_[i * kSlices + j] = static_cast<std::uint32_t>(position.row * strata.shape().columns + position.column);
    }
  }
}

void EpipolarSlices::fill(const EpipolarGrid& grid, const HemisphereSamples& samples, double length) {
  parallax_.resize(kCells * kSlices);
  radiance_.resize(kCells * kSlices);
  brightest_ = *std::max_element(samples.radiance.begin(), samples.radiance.end());
  const double unit = brightest_ > 0.0 ? brightest_ : 1.0;
  hidden_ahead_ = hidden_behind_ = 0.0;
  Lanes before{};
  for (std::size_t i = 0; i < kCells; ++i) {
    const float inverse_sine = walls().inverse_sine[i];
    float opening_ahead = 0.0f;
    float opening_behind = 0.0f;
    for (std::size_t j = 0; j < kSlices; ++j) {
      const std::size_t at = i * kSlices + j;
      const std::size_t sample = grid.strata()[at];
      const float inverse_distance =
          static_cast<float>(std::min(samples.inverse_distance[sample] * length, static_cast<double>(kMostParallax)));
      radiance_[at] = static_cast<float>(samples.radiance[sample] / unit);
      parallax_[at] = std::max(inverse_distance, before[j]) * inverse_sine;
      if (i > 0) {
        const float jump = inverse_distance - before[j];
        const bool is_edge = std::max(inverse_distance, before[j]) > kEdgeRatio * std::min(inverse_distance, before[j]);
        opening_ahead += is_edge ? std::max(-jump, 0.0f) : 0.0f;
        opening_behind += is_edge ? std::max(jump, 0.0f) : 0.0f;
      }
      before[j] = inverse_distance;
    }
    const double weight = i > 0 ? static_cast<double>(inverse_sine * walls().sine_to_fourth[i]) : 0.0;
    hidden_ahead_ += weight * static_cast<double>(opening_ahead);
    hidden_behind_ += weight * static_cast<double>(opening_behind);
  }
  hidden_ahead_ *= kSliceWidth;
  hidden_behind_ *= kSliceWidth;
}

double EpipolarSlices::irradiance(double distance) const {
  alignas(64) Lanes sums;
  (distance < 0.0 ? sumBehind : sumAhead)(walls().cotangent.data(), parallax_.data(), radiance_.data(),
                                          static_cast<float>(distance), sums.data());
  double total = 0.0;
  for (const float sum : sums) total += sum;
  return brightest_ * (total * kSliceWidth);
}

double EpipolarSlices::slope() const {
  double total = 0.0;
  for (std::size_t i = 1; i < kCells; ++i) {
    double jumps = 0.0;
    for (std::size_t j = 0; j < kSlices; ++j) {
      const std::size_t at = i * kSlices + j;
      jumps += static_cast<double>(radiance_[at] - radiance_[at - kSlices]) * static_cast<double>(parallax_[at]);
    }
    total += jumps * static_cast<double>(walls().sine_to_fourth[i]);
  }
  return brightest_ * (total * kSliceWidth);
}

}  // namespace irradiff
