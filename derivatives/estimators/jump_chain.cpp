#include "derivatives/estimators/jump_chain.h"

#include <algorithm>
#include <utility>

namespace irradiff {

namespace {

using Jumps = std::span<const RadianceJump>;

std::optional<StraightRun> runOf(std::vector<std::size_t> numbers, Jumps jumps) {
  const std::optional<SeenLine> line = fitLine(jumps, numbers);
  if (!line || !partsJumps(*line, jumps, numbers)) return std::nullopt;
  return StraightRun{std::move(numbers), line};
}

/// The jumps of a chain from one of them on, around the chain's end if that is necessary.
class ChainView {
 public:
  ChainView(const JumpChain& chain, Jumps jumps) : chain_(chain), jumps_(jumps) {}

  std::size_t size() const { return chain_.jumps.size(); }

  std::optional<StraightRun> run(std::size_t from, std::size_t count) const {
    std::vector<std::size_t> numbers(count);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = chain_.jumps[(from + i) % size()];
    return runOf(std::move(numbers), jumps_);
  }

  /// The longest straight run of at most `limit` jumps from `from` on: its length doubles while it is straight, then
  /// the last step is halved.
  StraightRun longestRun(std::size_t from, std::size_t limit) const {
    StraightRun longest{{chain_.jumps[from % size()]}, std::nullopt};
    std::size_t too_long = limit + 1;
    std::size_t step = 1;
    while (longest.jumps.size() + 1 < too_long) {
      const std::size_t count = std::min(longest.jumps.size() + step, too_long - 1);
      if (std::optional<StraightRun> longer = run(from, count)) {
        longest = std::move(*longer);
        step *= 2;
      } else {
        too_long = count;
        step = std::max<std::size_t>(1, (too_long - longest.jumps.size()) / 2);
      }
    }
    return longest;
  }

 private:
  const JumpChain& chain_;
  Jumps jumps_;
};

/// Runs were made as long as possible from their starts on: a short one may have taken the start of the next.
void giveBackToNext(StraightRun& run, StraightRun& next, Jumps jumps) {
  constexpr std::size_t kShort = 3;
  if (next.jumps.size() < kShort) return;
  bool has_given = false;
  while (run.jumps.size() >= 2 && run.jumps.size() <= kShort) {
    std::vector<std::size_t> longer = next.jumps;
    longer.insert(longer.begin(), run.jumps.back());
    std::optional<StraightRun> taken = runOf(std::move(longer), jumps);
    if (!taken) break;
    next = std::move(*taken);
    run.jumps.pop_back();
    has_given = true;
  }
  if (has_given) run.line = run.jumps.size() > 1 ? fitLine(jumps, run.jumps) : std::nullopt;
}

bool isStray(const std::vector<StraightRun>& runs, std::size_t i, bool is_closed) {
  if (is_closed || runs.size() < 2 || runs[i].jumps.size() > 1) return false;
  return (i == 0 && runs[1].line) || (i + 1 == runs.size() && runs[i - 1].line);
}

bool cutsCorner(const std::vector<StraightRun>& runs, std::size_t i, bool is_closed, Jumps jumps) {
  const std::size_t count = runs.size();
  if (count < 3 || runs[i].jumps.size() > 1) return false;
  if (!is_closed && (i == 0 || i + 1 == count)) return false;
  const StraightRun& before = runs[(i + count - 1) % count];
  const StraightRun& after = runs[(i + 1) % count];
  return before.line && after.line && cornerBetween(lastEnd(before, jumps), firstEnd(after, jumps));
}

}  // namespace

std::vector<JumpChain> jumpChains(const JumpGraph& graph) {
  const std::size_t count = graph.jumps.size();
  std::vector<std::vector<std::size_t>> neighbours(count);
  for (const auto& [a, b] : graph.links) {
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  }
  std::vector<bool> is_used(count, false);
  const auto follow = [&](std::size_t start) {
    JumpChain chain;
    std::size_t at = start;
    while (true) {
      is_used[at] = true;
      chain.jumps.push_back(at);
      const auto& next = neighbours[at];
      const auto unused = std::find_if(next.begin(), next.end(), [&](std::size_t i) { return !is_used[i]; });
      if (unused == next.end()) {
        chain.is_closed = chain.jumps.size() > 2 && std::find(next.begin(), next.end(), start) != next.end();
        return chain;
      }
      at = *unused;
    }
  };
  std::vector<JumpChain> chains;
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_used[i] && neighbours[i].size() < 2) chains.push_back(follow(i));
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_used[i]) chains.push_back(follow(i));
  }
  return chains;
}

LineEnd firstEnd(const StraightRun& run, std::span<const RadianceJump> jumps) {
  return {*run.line, jumps[run.jumps[0]], jumps[run.jumps[1]]};
}

LineEnd lastEnd(const StraightRun& run, std::span<const RadianceJump> jumps) {
  return {*run.line, jumps[run.jumps.back()], jumps[run.jumps[run.jumps.size() - 2]]};
}

std::vector<StraightRun> straightRuns(const JumpChain& chain, std::span<const RadianceJump> jumps) {
  const ChainView view(chain, jumps);
  const std::size_t count = view.size();
  std::size_t start = 0;
  if (chain.is_closed) {
    const std::size_t first = view.longestRun(0, count).jumps.size();
    start = first < count ? first : 0;
  }
  std::vector<StraightRun> runs;
  for (std::size_t i = 0; i < count; i += runs.back().jumps.size()) {
    runs.push_back(view.longestRun(start + i, count - i));
  }
  for (std::size_t i = runs.size(); i-- > 1;) giveBackToNext(runs[i - 1], runs[i], jumps);
  for (std::size_t i = 0; i < runs.size();) {
    if (isStray(runs, i, chain.is_closed) || cutsCorner(runs, i, chain.is_closed, jumps)) {
      runs.erase(runs.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
  return runs;
}

}  // namespace irradiff
