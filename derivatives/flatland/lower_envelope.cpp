#include "derivatives/flatland/lower_envelope.h"

#include "derivatives/scene/invalid_scene.h"

#include <algorithm>
#include <span>
#include <utility>

namespace irradiff {
namespace {

class LowerEnvelope {
 public:
  explicit LowerEnvelope(const HalfCircle& half_circle) : half_circle_(half_circle) {}

  std::vector<FrontPiece> frontMost(std::span<const std::size_t> sources);

  /// Segments that overlap behind others may differ in radiance: only what is seen matters.
  void rejectVisibleTies(const std::vector<FrontPiece>& pieces) const;

 private:
  std::vector<FrontPiece> merge(const std::vector<FrontPiece>& a, const std::vector<FrontPiece>& b);
  template <class Append>
  void appendNearer(std::size_t a, std::size_t b, const FlatlandDirection& from, const FlatlandDirection& to,
                    const Append& append);

  const HalfCircle& half_circle_;
  std::vector<std::pair<std::size_t, std::size_t>> ties_;  ///< of different radiance
};

std::vector<FrontPiece> LowerEnvelope::frontMost(std::span<const std::size_t> sources) {
  if (sources.size() > 1) {
    const std::size_t half = sources.size() / 2;
    return merge(frontMost(sources.first(half)), frontMost(sources.subspan(half)));
  }
  if (sources.empty()) return {{kHorizonStart, kNobody}};
  const FlatlandSource& s = half_circle_.source(sources[0]);
  std::vector<FrontPiece> pieces;
  if (s.start.kind != FlatlandDirection::Kind::kStart) pieces.push_back({kHorizonStart, kNobody});
  pieces.push_back({s.start, sources[0]});
  if (s.stop.kind != FlatlandDirection::Kind::kStop) pieces.push_back({s.stop, kNobody});
  return pieces;
}

std::vector<FrontPiece> LowerEnvelope::merge(const std::vector<FrontPiece>& a, const std::vector<FrontPiece>& b) {
  std::vector<FrontPiece> merged;
  const auto append = [&merged](const FlatlandDirection& start, std::size_t source) {
    if (merged.empty() || merged.back().source != source) merged.push_back({start, source});
  };
  std::size_t i = 0;
  std::size_t j = 0;
  FlatlandDirection from = kHorizonStart;
  for (;;) {
    const FlatlandDirection a_end = i + 1 < a.size() ? a[i + 1].start : kHorizonStop;
    const FlatlandDirection b_end = j + 1 < b.size() ? b[j + 1].start : kHorizonStop;
    const int order = half_circle_.compare(a_end, b_end);
    // Of equal directions the one towards an end is the cheaper to compute with.
    const FlatlandDirection to =
        order < 0 || (order == 0 && a_end.kind != FlatlandDirection::Kind::kCrossing) ? a_end : b_end;
    appendNearer(a[i].source, b[j].source, from, to, append);
    if (to.kind == FlatlandDirection::Kind::kStop) return merged;
    i += order <= 0 ? 1 : 0;
    j += order >= 0 ? 1 : 0;
    from = to;
  }
}

template <class Append>
void LowerEnvelope::appendNearer(std::size_t a, std::size_t b, const FlatlandDirection& from,
                                 const FlatlandDirection& to, const Append& append) {
  if (a == kNobody || b == kNobody) {
    append(from, a == kNobody ? b : a);
    return;
  }
  const int at_start = half_circle_.nearer(a, b, from);
  const int at_end = half_circle_.nearer(a, b, to);
  if (at_start * at_end < 0) {
    append(from, at_start > 0 ? a : b);
    append(FlatlandDirection{FlatlandDirection::Kind::kCrossing, a, false, b, half_circle_.turn(a, b)},
           at_end > 0 ? a : b);
  } else if (at_start == 0 && at_end == 0) {
    append(from, std::min(a, b));
    if (half_circle_.radiance(a) != half_circle_.radiance(b)) ties_.emplace_back(std::min(a, b), std::max(a, b));
  } else {
    append(from, at_start + at_end > 0 ? a : b);
  }
}

void LowerEnvelope::rejectVisibleTies(const std::vector<FrontPiece>& pieces) const {
  for (const auto& [a, b] : ties_) {
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const std::size_t front = pieces[k].source;
      if (front == kNobody || !half_circle_.onOneLine(front, a)) continue;
      FlatlandDirection from = pieces[k].start;
      FlatlandDirection to = k + 1 < pieces.size() ? pieces[k + 1].start : kHorizonStop;
      for (const std::size_t source : {a, b}) {
        if (half_circle_.compare(from, half_circle_.source(source).start) < 0) from = half_circle_.source(source).start;
        if (half_circle_.compare(half_circle_.source(source).stop, to) < 0) to = half_circle_.source(source).stop;
      }
      if (half_circle_.compare(from, to) < 0) {
        throw InvalidScene(half_circle_.nameOf(a) + " and " + half_circle_.nameOf(b) +
                           " lie on one line and overlap in view, but their radiances differ: which of them is seen "
                           "is not defined");
      }
    }
  }
}

}  // namespace

std::vector<FrontPiece> lowerEnvelope(const HalfCircle& half_circle) {
  std::vector<std::size_t> broad;
  for (std::size_t i = 0; i < half_circle.sources().size(); ++i) {
    if (half_circle.source(i).isBroad()) broad.push_back(i);
  }
  LowerEnvelope envelope(half_circle);
  std::vector<FrontPiece> pieces = envelope.frontMost(broad);
  envelope.rejectVisibleTies(pieces);
  return pieces;
}

}  // namespace irradiff
