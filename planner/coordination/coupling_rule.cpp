#include "planner/coordination/coupling_rule.hpp"

#include <algorithm>
#include <array>

namespace hlc::coordination {
namespace {

bool never(const Traffic& /*a*/, const Traffic& /*b*/) { return false; }

bool always(const Traffic& /*a*/, const Traffic& /*b*/) { return true; }

}  // namespace

constinit const CouplingRule kReachableAreas{.name = "reachable_areas", .couples_also = &never};
constinit const CouplingRule kAllVehicles{.name = "all", .couples_also = &always};

bool are_coupled(const Traffic& a, const Traffic& b, const CouplingRule& rule) {
  return intersects(a.reachable_area_m, b.reachable_area_m) || rule.couples_also(a, b) ||
         rule.couples_also(b, a);
}

std::span<const CouplingRule* const> coupling_rules() {
  static constexpr std::array kAll{&kReachableAreas, &kAllVehicles};
  return kAll;
}

const CouplingRule* coupling_rule(std::string_view name) {
  const auto all = coupling_rules();
  const auto found = std::ranges::find(all, name, &CouplingRule::name);
  return found == all.end() ? nullptr : *found;
}

std::vector<std::string> coupling_rule_names() {
  std::vector<std::string> names;
  for (const CouplingRule* one : coupling_rules()) names.emplace_back(one->name);
  return names;
}

}  // namespace hlc::coordination
