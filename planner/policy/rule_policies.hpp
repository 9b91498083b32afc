#pragma once

#include <memory>

#include "planner/policy/policy.hpp"

namespace hlc {

/// Policies that need nothing but the view; what they do is said at their settings.
[[nodiscard]] std::unique_ptr<Policy> make_policy_of(const TimePolicySettings& settings);
[[nodiscard]] std::unique_ptr<Policy> make_policy_of(const SituationPolicySettings& settings);
/// A battery that is not known is as it was.
[[nodiscard]] std::unique_ptr<Policy> make_policy_of(const BatteryPolicySettings& settings);

}  // namespace hlc
