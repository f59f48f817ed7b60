// Where samples are in their strata: a function of (seed, point, sample) whose values are uniform and independent. Each
// check of uniformity runs on numbers that only look random, too.

#include "derivatives/samples/sample_pattern.h"

#include "derivatives/samples/philox.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iostream>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using testing::ElementsAre;

// The vectors that come with the authors' Random123 library for ten rounds of philox4x32.
TEST(Philox, GivesTheKnownAnswers) {
  EXPECT_THAT(philox4x32({0, 0, 0, 0}, {0, 0}), ElementsAre(0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8));
  EXPECT_THAT(philox4x32({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
              ElementsAre(0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd));
  EXPECT_THAT(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
              ElementsAre(0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1));
}

/// Offsets by number: what a statistic is taken of.
using Offsets = std::function<StratumOffset(std::uint64_t)>;

constexpr std::uint64_t kDraws = std::uint64_t{1} << 20;
constexpr std::size_t kBins = 16;
// Of 16,000 sets of random numbers about one is refused; with fixed seeds a test passes or fails for good.
constexpr double kStandardErrors = 4.0;

/// How many standard deviations chi-square of pairs in kBins x kBins bins is from its mean. Far below 0 the pairs are
/// too even to be random.
double chiSquareDeviation(const std::function<std::array<double, 2>(std::uint64_t)>& pair) {
  std::array<std::array<double, kBins>, kBins> counts{};
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const auto [x, y] = pair(i);
    counts.at(static_cast<std::size_t>(x * kBins)).at(static_cast<std::size_t>(y * kBins)) += 1.0;
  }
  const double expected = static_cast<double>(kDraws) / (kBins * kBins);
  double chi_square = 0.0;
  for (const auto& line : counts) {
    for (const double count : line) chi_square += (count - expected) * (count - expected) / expected;
  }
  const double freedom = kBins * kBins - 1;
  return (chi_square - freedom) / std::sqrt(2.0 * freedom);
}

/// The worst of the pairs that are looked at: both coordinates, and one of each with one of the next draw.
double worstDeviation(const Offsets& offsets) {
  const std::array deviations = {chiSquareDeviation([&](std::uint64_t i) {
                                   const StratumOffset o = offsets(i);
                                   return std::array{o.along_row, o.along_column};
                                 }),
                                 chiSquareDeviation([&](std::uint64_t i) {
                                   return std::array{offsets(i).along_row, offsets(i + 1).along_row};
                                 }),
                                 chiSquareDeviation([&](std::uint64_t i) {
                                   return std::array{offsets(i).along_column, offsets(i + 1).along_column};
                                 }),
                                 chiSquareDeviation([&](std::uint64_t i) {
                                   return std::array{offsets(i).along_row, offsets(i + 1).along_column};
                                 }),
                                 chiSquareDeviation([&](std::uint64_t i) {
                                   return std::array{offsets(i).along_column, offsets(i + 1).along_row};
                                 })};
  double worst = 0.0;
  for (const double deviation : deviations) worst = std::max(worst, std::abs(deviation));
  return worst;
}

TEST(SamplePattern, JitteredOffsetsAreUniformAndIndependentInEveryArgument) {
  using enum SamplePattern;
  const double over_samples = worstDeviation([](std::uint64_t i) { return stratumOffset(kJittered, 1, 2, i); });
  const double over_points = worstDeviation([](std::uint64_t i) { return stratumOffset(kJittered, 1, i, 3); });
  const double over_seeds = worstDeviation([](std::uint64_t i) { return stratumOffset(kJittered, i, 2, 3); });
  const double high_bits = worstDeviation([](std::uint64_t i) { return stratumOffset(kJittered, 1, i << 40, 3); });
  std::cout << "standard deviations of chi-square: samples " << over_samples << ", points " << over_points << ", seeds "
            << over_seeds << ", high bits of points " << high_bits << '\n';
  EXPECT_LE(over_samples, kStandardErrors);
  EXPECT_LE(over_points, kStandardErrors);
  EXPECT_LE(over_seeds, kStandardErrors);
  EXPECT_LE(high_bits, kStandardErrors);
}

TEST(SamplePattern, TheShiftOfALowDiscrepancySequenceIsUniformOverPointsAndSeeds) {
  using enum SamplePattern;
  EXPECT_LE(worstDeviation([](std::uint64_t i) { return stratumOffset(kLowDiscrepancy, 1, i, 5); }), kStandardErrors);
  EXPECT_LE(worstDeviation([](std::uint64_t i) { return stratumOffset(kLowDiscrepancy, i, 1, 5); }), kStandardErrors);
}

TEST(SamplePattern, NumbersThatOnlyLookRandomAreNoticed) {
  // Too even: multiples of an irrational number.
  const auto fraction = [](double x) { return x - std::floor(x); };
  EXPECT_GT(worstDeviation([&](std::uint64_t i) {
              const auto n = static_cast<double>(i);
              return StratumOffset{fraction(0.7548776662466927 * n), fraction(0.5698402909980532 * n)};
            }),
            kStandardErrors);
  // Uniform, but a draw tells the next: overlapping parts of one sequence.
  EXPECT_GT(worstDeviation([](std::uint64_t i) {
              const auto number = [](std::uint64_t k) {
                return stratumOffset(SamplePattern::kJittered, 1, 2, k).along_row;
              };
              return StratumOffset{number(i), number(i + 1)};
            }),
            kStandardErrors);
  // A hundredth of the draws is twice in the lower half.
  EXPECT_GT(worstDeviation([](std::uint64_t i) {
              StratumOffset o = stratumOffset(SamplePattern::kJittered, 1, 2, i);
              if (i % 100 == 0) o.along_row /= 2.0;
              return o;
            }),
            kStandardErrors);
}

/// The offsets of a record, drawn in the order given.
template <class Draw>
std::vector<StratumOffset> drawn(const std::vector<std::uint64_t>& order, Draw draw) {
  std::vector<StratumOffset> offsets(order.size());
  for (const std::uint64_t sample : order) offsets[sample] = draw(sample);
  return offsets;
}

bool areSame(const std::vector<StratumOffset>& a, const std::vector<StratumOffset>& b) {
  return std::ranges::equal(a, b, [](const StratumOffset& p, const StratumOffset& q) {
    return p.along_row == q.along_row && p.along_column == q.along_column;
  });
}

TEST(SamplePattern, DependsOnNoOrderOfDrawing) {
  std::vector<std::uint64_t> forward(1000), shuffled(1000);
  for (std::uint64_t i = 0; i < 1000; ++i) forward[i] = shuffled[i] = i;
  std::ranges::shuffle(shuffled, std::mt19937_64(3));
  for (const SamplePattern pattern :
       {SamplePattern::kCentred, SamplePattern::kJittered, SamplePattern::kLowDiscrepancy}) {
    const auto draw = [pattern](std::uint64_t sample) { return stratumOffset(pattern, 7, 8, sample); };
    EXPECT_TRUE(areSame(drawn(forward, draw), drawn(shuffled, draw)));
  }
  // A generator with a state is told apart.
  const auto withState = [](std::mt19937_64& random) {
    return [&random](std::uint64_t) {
      const double along_row = std::uniform_real_distribution<double>()(random);
      return StratumOffset{along_row, 0.5};
    };
  };
  std::mt19937_64 first(7), second(7);
  EXPECT_FALSE(areSame(drawn(forward, withState(first)), drawn(shuffled, withState(second))));
}

TEST(SamplePattern, TellsSeedsPointsAndSamplesApart) {
  for (const SamplePattern pattern : {SamplePattern::kJittered, SamplePattern::kLowDiscrepancy}) {
    std::set<double> seen;
    for (std::uint64_t i = 0; i < 100; ++i) {
      seen.insert(stratumOffset(pattern, i, 1000, 2000).along_row);
      seen.insert(stratumOffset(pattern, 1000, i, 2000).along_row);
      seen.insert(stratumOffset(pattern, 1000, 2000, i).along_row);
      seen.insert(stratumOffset(pattern, 1000, i << 32, 2001).along_row);
    }
    EXPECT_EQ(seen.size(), 400);
  }
}

TEST(SamplePattern, CentredOffsetsAreInTheMiddle) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    const StratumOffset o = stratumOffset(SamplePattern::kCentred, i, 3 * i, 7 * i);
    EXPECT_EQ(o.along_row, 0.5);
    EXPECT_EQ(o.along_column, 0.5);
  }
}

/// Whether the offsets, moved so that the first is 0, are a (0, 2)-sequence in base 2: of each aligned run of 2^m
/// samples exactly one is in each interval of 2^-a x 2^-b, a + b = m.
bool isNetSequence(const Offsets& offsets) {
  const StratumOffset origin = offsets(0);
  const auto moved = [](double x, double zero) { return x >= zero ? x - zero : x - zero + 1.0; };
  for (int m = 0; m <= 10; ++m) {
    const std::uint64_t length = std::uint64_t{1} << m;
    for (std::uint64_t start = 0; start < 4 * length; start += length) {
      for (int a = 0; a <= m; ++a) {
        std::set<std::uint64_t> intervals;
        for (std::uint64_t i = start; i < start + length; ++i) {
          const StratumOffset o = offsets(i);
          const auto x = static_cast<std::uint64_t>(std::ldexp(moved(o.along_row, origin.along_row), a));
          const auto y = static_cast<std::uint64_t>(std::ldexp(moved(o.along_column, origin.along_column), m - a));
          intervals.insert((x << (m - a)) + y);
        }
        if (intervals.size() != length) return false;
      }
    }
  }
  return true;
}

TEST(SamplePattern, LowDiscrepancyOffsetsAreAShiftedNetSequence) {
  for (std::uint64_t point = 0; point < 5; ++point) {
    EXPECT_TRUE(
        isNetSequence([point](std::uint64_t i) { return stratumOffset(SamplePattern::kLowDiscrepancy, 9, point, i); }));
  }
  EXPECT_FALSE(isNetSequence([](std::uint64_t i) { return stratumOffset(SamplePattern::kJittered, 9, 0, i); }));
  EXPECT_FALSE(isNetSequence([](std::uint64_t i) {
    StratumOffset o = stratumOffset(SamplePattern::kLowDiscrepancy, 9, 0, i);
    o.along_column = o.along_row;
    return o;
  }));
}

}  // namespace
}  // namespace irradiff
