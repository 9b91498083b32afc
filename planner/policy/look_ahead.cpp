#include "planner/policy/look_ahead.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hlc {

LookAhead::LookAhead(LookAheadSettings settings) : settings_(std::move(settings)) {}

std::optional<SubgraphRequest> LookAhead::wish(const PolicyView& /*view*/) {
  if (!chosen_) return std::nullopt;
  return settings_.candidates[*chosen_];
}

void LookAhead::rehearse(const Controller& controller, const HeardInStep& heard,
                         const Prepared& prepared) {
  std::vector<double> costs_m2;
  for (const SubgraphRequest& candidate : settings_.candidates) {
    const auto on_candidate = [&](Controller& rehearsing) {
      const PreparedSubgraph& now = prepared(candidate, rehearsing);
      if (rehearsing.prepared_subgraph().subgraph != now.subgraph) rehearsing.switch_to(now);
    };
    costs_m2.push_back(rehearsed_cost_m2(controller, heard,
                                         {.steps = settings_.steps,
                                          .criterion_weights = settings_.criterion_weights,
                                          .max_expansions = settings_.max_expansions},
                                         on_candidate));
  }
  const auto best = std::ranges::min_element(costs_m2);
  if (chosen_) {
    const double kept_m2 = costs_m2[*chosen_];
    if (*best >= kept_m2 - settings_.least_gain * std::abs(kept_m2)) return;
  }
  chosen_ = static_cast<std::size_t>(best - costs_m2.begin());
}

}  // namespace hlc
