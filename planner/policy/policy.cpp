#include "planner/policy/policy.hpp"

#include "planner/policy/look_ahead.hpp"
#include "planner/policy/rule_policies.hpp"

namespace hlc::policy {

std::unique_ptr<Policy> make_policy(const PolicySettings& settings) {
  return std::visit([](const auto& one) { return make_policy_of(one); }, settings);
}

}  // namespace hlc::policy
