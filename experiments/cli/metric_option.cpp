#include "experiments/cli/metric_option.h"

#include "experiments/cache_3d/metric_records.h"

namespace irradiff {

std::string wrongMetric(const std::string& name) {
  std::string names;
  for (const std::string& metric : recordMetrics(true)) {
    if (metric == name) return "";
    names += (names.empty() ? "" : ", ") + metric;
  }
  return "unknown metric \"" + name + "\", must be one of " + names;
}

}  // namespace irradiff
