#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/coordination/messages.hpp"

namespace hlc::coordination {

/// Which vehicles take part in each other's planning. A rule is one function.
///
/// A vehicle plans around the plans of coupled vehicles only. So those that may meet within the
/// horizon are coupled whatever the rule: it can only add further ones.
struct CouplingRule {
  std::string_view name;
  /// Of vehicles whose reachable areas are apart: a pure function of what the two announced, so
  /// that all who received the same couple the same. Two are coupled if it is true either way
  /// round.
  bool (*couples_also)(const Traffic& a, const Traffic& b);
};

/// Both ways round alike.
[[nodiscard]] bool are_coupled(const Traffic& a, const Traffic& b, const CouplingRule& rule);

/// Who may meet within the horizon: the reachable areas intersect.
extern const CouplingRule kReachableAreas;
/// Everybody with everybody: for comparison, and for rules that need to know all.
extern const CouplingRule kAllVehicles;

/// All, kReachableAreas, the default, first. A further rule is one more entry.
[[nodiscard]] std::span<const CouplingRule* const> coupling_rules();
/// nullptr: there is none of this name.
[[nodiscard]] const CouplingRule* coupling_rule(std::string_view name);
[[nodiscard]] std::vector<std::string> coupling_rule_names();

}  // namespace hlc::coordination
