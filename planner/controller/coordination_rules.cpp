#include "planner/controller/coordination_rules.hpp"

#include <algorithm>

namespace hlc::controller {

const std::map<std::string, CoordinationRule>& coordination_rules() {
  static const std::map<std::string, CoordinationRule> kRules{
      {"agreed", kAgreedCoordination},
      {"cooperative", kCooperativeCoordination},
      {"strict", kStrictCoordination}};
  return kRules;
}

std::string_view name_of(const CoordinationRule& rule) {
  const auto found = std::ranges::find(coordination_rules(), rule,
                                       &std::pair<const std::string, CoordinationRule>::second);
  return found == coordination_rules().end() ? std::string_view("other") : found->first;
}

}  // namespace hlc::controller
