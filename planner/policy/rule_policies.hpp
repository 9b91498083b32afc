#pragma once

#include <memory>

#include "planner/policy/policy.hpp"

namespace hlc::policy {

/// Policies that need nothing but the view; they are specified at their settings.
[[nodiscard]] std::unique_ptr<Policy> make_policy_of(const TimePolicySettings& settings);
[[nodiscard]] std::unique_ptr<Policy> make_policy_of(const SituationPolicySettings& settings);
/// An unknown battery voltage counts as unchanged.
[[nodiscard]] std::unique_ptr<Policy> make_policy_of(const BatteryPolicySettings& settings);

}  // namespace hlc::policy
