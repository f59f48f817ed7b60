#include "verification/report/reference_summary.h"

#include "verification/reference/reference_data.h"

namespace irradiff {
namespace {

template <class Cases>
void countInto(std::vector<ReferenceSummary>& summaries, const Cases& cases, int dimension) {
  std::map<std::string, ReferenceSummary> by_family;
  for (const ReferenceValues& c : cases) {
    ReferenceSummary& summary = by_family[c.family];
    summary.family = c.family;
    summary.dimension = dimension;
    ++summary.cases_by_route[c.route];
  }
  for (const auto& [family, summary] : by_family) {
    summaries.push_back(summary);
  }
}

}  // namespace

std::size_t ReferenceSummary::cases() const {
  std::size_t sum = 0;
  for (const auto& [route, count] : cases_by_route) {
    sum += count;
  }
  return sum;
}

std::vector<ReferenceSummary> summariseReferences(const std::filesystem::path& folder) {
  std::vector<ReferenceSummary> summaries;
  countInto(summaries, readReferenceData(folder), 3);
  countInto(summaries, readFlatlandReferenceData(folder), 2);
  return summaries;
}

}  // namespace irradiff
