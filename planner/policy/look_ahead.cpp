#include "planner/policy/look_ahead.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/policy/look_ahead_rollout.hpp"

namespace hlc::policy {

LookAhead::LookAhead(LookAheadSettings settings) : settings_(std::move(settings)) {}

std::optional<SubgraphRequest> LookAhead::propose(const PolicyView& /*view*/) {
  if (!chosen_) return std::nullopt;
  return settings_.candidates[*chosen_];
}

void LookAhead::look_ahead(const controller::Controller& controller, const SwitchTo& switch_to) {
  constexpr double kUnknown_m2 = std::numeric_limits<double>::infinity();
  const LookAheadRolloutSettings rollout{
      .steps = settings_.steps,
      .criterion_weights = settings_.criterion_weights,
      .max_expansions = settings_.max_expansions,
      .most_expansions = settings_.steps * settings_.max_expansions};
  std::vector<double> costs_m2;
  for (const SubgraphRequest& candidate : settings_.candidates) {
    const auto on_candidate = [&](controller::Controller& ahead) { switch_to(candidate, ahead); };
    costs_m2.push_back(rollout_cost_m2(controller, rollout, on_candidate).value_or(kUnknown_m2));
  }
  const auto best = std::ranges::min_element(costs_m2);
  if (*best == kUnknown_m2) return;
  if (chosen_) {
    const double kept_m2 = costs_m2[*chosen_];
    const bool gains = *best < kept_m2 - settings_.least_gain * std::abs(kept_m2);
    if (!gains && kept_m2 != kUnknown_m2) return;
  }
  chosen_ = static_cast<std::size_t>(best - costs_m2.begin());
}

std::unique_ptr<Policy> make_policy_of(const LookAheadSettings& settings) {
  return std::make_unique<LookAhead>(settings);
}

}  // namespace hlc::policy
