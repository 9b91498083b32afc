#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "planner/policy/policy.hpp"

namespace hlc::policy {

/// Proposes the candidate whose look-ahead rollout over the next steps (look_ahead_rollout.hpp)
/// costs least.
///
/// The rollouts are made after a step, when its command has been sent, so they do not delay the
/// step; their result holds from the next step on. The last choice is kept unless another one costs
/// less by least_gain of its amount. A candidate whose rollout would exceed its expansions is not
/// chosen.
class LookAhead final : public Policy {
 public:
  explicit LookAhead(LookAheadSettings settings);

  std::optional<SubgraphRequest> propose(const PolicyView& view) override;
  std::vector<SubgraphRequest> choices() const override { return settings_.candidates; }
  bool looks_ahead() const override { return true; }
  void look_ahead(const controller::Controller& controller, const SwitchTo& switch_to) override;

 private:
  LookAheadSettings settings_;
  std::optional<std::size_t> chosen_;  ///< none before the first rollout
};

[[nodiscard]] std::unique_ptr<Policy> make_policy_of(const LookAheadSettings& settings);

}  // namespace hlc::policy
