#include "verification/enclosure/validated_integral.h"

#include <arb_hypgeom.h>

#include <map>
#include <utility>

namespace irradiff::enclosure {

const GaussLegendreRule& gaussLegendreRule(std::size_t size) {
  thread_local std::map<std::pair<std::size_t, slong>, GaussLegendreRule> rules;
  const slong bits = WorkingPrecision::bits();
  const auto [position, added] = rules.try_emplace({size, bits});
  GaussLegendreRule& rule = position->second;
  if (added) {
    rule.nodes.resize(size);
    rule.weights.resize(size);
    for (std::size_t i = 0; i < size; ++i) {
      arb_hypgeom_legendre_p_ui_root(rule.nodes[i].get(), rule.weights[i].get(), size, i, bits);
    }
  }
  return rule;
}

}  // namespace irradiff::enclosure
