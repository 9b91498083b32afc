#pragma once

#include "planner/rollout/rollout.hpp"

namespace hlc::test {

/// True if the plans in force after the last step share no point pair by pair, from that step on
/// until every one of them stands.
inline bool plans_in_force_are_free(const rollout::Rollout& rollout) {
  const auto& controllers = rollout.controllers();
  const StepIndex now{rollout.next_step().value - 1};
  for (std::size_t i = 0; i < controllers.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const std::size_t steps = controllers[i]->options().horizon_steps + 2;
      if (!coordination::are_free(controllers[i]->plan_in_force().areas_from(now),
                                  controllers[j]->plan_in_force().areas_from(now), now, steps)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace hlc::test
