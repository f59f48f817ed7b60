#include "verification/certified/ladder.h"

#include "verification/enclosure/undecided.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace irradiff {

namespace {

constexpr slong kFewestBits = 128;

template <int Dimension>
void evaluate(LadderSource<Dimension>& source) {
  try {
    source.value = source.evaluate(source.step);
  } catch (const Undecided&) {
    source.value = unknownLight<Dimension>();
  }
}

/// What a quantity that may vanish beside another is measured by.
long double referenceOf(std::size_t quantity, const std::array<QuantityState, kQuantityCount>& states) {
  constexpr std::size_t kRotational = 4;
  return quantity == kRotational ? std::max(0.0L, states[0].norm - states[0].error) : 0.0L;
}

bool isWanted(std::size_t quantity, const WantedQuantities& wanted) {
  return quantity == 1   ? wanted.gradient
         : quantity == 2 ? wanted.hessian
         : quantity == 3 ? wanted.tangential_hessian
                         : true;
}

bool isLast(const LadderStep& step) { return step.bits == kMostBits; }

template <int Dimension>
void step(LadderSource<Dimension>& source, double tolerance) {
  source.step = above(source.step, tolerance);
  evaluate(source);
}

/// What a source may be off in each quantity before it takes a step; infinity where the quantity is good enough.
template <int Dimension>
std::array<long double, kQuantityCount> sharesOf(const std::vector<LadderSource<Dimension>>& sources,
                                                 const std::array<QuantityState, kQuantityCount>& sum, double tolerance,
                                                 const WantedQuantities& wanted) {
  std::array<long double, kQuantityCount> shares;
  shares.fill(std::numeric_limits<long double>::infinity());
  std::array<long double, kQuantityCount> largest{};
  for (const LadderSource<Dimension>& source : sources) {
    const auto own = statesOf(source.value);
    for (std::size_t q = 0; q < kQuantityCount; ++q) largest[q] = std::max(largest[q], source.radiance * own[q].error);
  }
  for (std::size_t q = 0; q < kQuantityCount; ++q) {
    const long double reference = referenceOf(q, sum);
    if (!isWanted(q, wanted) || sum[q].meets(tolerance, reference)) continue;
    // Half of what is allowed is left to the roundings of the sum. Where errors hide how large the sum is, the largest
    // of them come first: they may hide it alone.
    constexpr long double kBesideLargest = 0x1p-10L;
    const long double beside_largest = std::isfinite(largest[q]) ? kBesideLargest * largest[q] : 0x1p1000L;
    shares[q] = std::max(sum[q].allowed(tolerance, reference) / (2.0L * static_cast<long double>(sources.size())),
                         beside_largest);
  }
  return shares;
}

/// False if there is none that is too wide and has a step above it.
template <int Dimension>
bool climbWhereTooWide(std::vector<LadderSource<Dimension>>& sources,
                       const std::array<QuantityState, kQuantityCount>& sum, double tolerance,
                       const WantedQuantities& wanted) {
  const auto shares = sharesOf(sources, sum, tolerance, wanted);
  bool any = false;
  for (LadderSource<Dimension>& source : sources) {
    const auto own = statesOf(source.value);
    bool is_too_wide = false;
    for (std::size_t q = 0; q < kQuantityCount; ++q) {
      is_too_wide = is_too_wide || source.radiance * own[q].error > shares[q];
    }
    if (!is_too_wide || isLast(source.step)) continue;
    step(source, tolerance);
    any = true;
  }
  return any;
}

/// Where the roundings of the sum are what is too wide: balls have none to speak of.
template <int Dimension>
bool climbAll(std::vector<LadderSource<Dimension>>& sources, double tolerance) {
  bool any = false;
  for (LadderSource<Dimension>& source : sources) {
    if (isLast(source.step)) continue;
    step(source, tolerance);
    any = true;
  }
  return any;
}

}  // namespace

slong firstBits(double tolerance) {
  const auto digits = static_cast<slong>(std::ceil(-std::log2(tolerance)));
  return std::max(kFewestBits, digits + kFewestBits / 2);
}

LadderStep above(const LadderStep& step, double tolerance) {
  switch (step.rung) {
    case Rung::kDouble:
      // Double words hold 106 bits at best.
      if (tolerance >= 0x1p-96) return {Rung::kExtended, 0};
      return {Rung::kBall, firstBits(tolerance)};
    case Rung::kExtended:
      return {Rung::kBall, firstBits(tolerance)};
    case Rung::kBall:
      return {Rung::kBall, std::min(kMostBits, 2 * step.bits)};
  }
  return step;
}

template <int Dimension>
bool meets(const CertifiedValue<Dimension>& value, double tolerance, const WantedQuantities& wanted) {
  const auto states = statesOf(value);
  for (std::size_t quantity = 0; quantity < kQuantityCount; ++quantity) {
    if (isWanted(quantity, wanted) && !states[quantity].meets(tolerance, referenceOf(quantity, states))) return false;
  }
  return true;
}

template <int Dimension>
CertifiedValue<Dimension> climb(std::vector<LadderSource<Dimension>>& sources, double tolerance,
                                const WantedQuantities& wanted) {
  for (LadderSource<Dimension>& source : sources) evaluate(source);
  for (;;) {
    slong bits = kFewestBits;
    for (const LadderSource<Dimension>& source : sources) bits = std::max(bits, source.step.bits);
    CertifiedValue<Dimension> sum = noLight<Dimension>();
    for (const LadderSource<Dimension>& source : sources) add(sum, source.value, source.radiance, bits);
    const auto states = statesOf(sum);
    if (meets(sum, tolerance, wanted)) return sum;
    if (!climbWhereTooWide(sources, states, tolerance, wanted) && !climbAll(sources, tolerance)) return sum;
  }
}

void requireTolerance(double tolerance) {
  if (tolerance >= kSmallestTolerance && tolerance <= 1.0) return;
  std::ostringstream text;
  text << "tolerance: " << tolerance << ", must be from " << kSmallestTolerance << " to 1";
  throw std::invalid_argument(text.str());
}

template bool meets(const CertifiedValue<2>&, double, const WantedQuantities&);
template CertifiedValue<2> climb(std::vector<LadderSource<2>>&, double, const WantedQuantities&);
template bool meets(const CertifiedValue<3>&, double, const WantedQuantities&);
template CertifiedValue<3> climb(std::vector<LadderSource<3>>&, double, const WantedQuantities&);

}  // namespace irradiff
