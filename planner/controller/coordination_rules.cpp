#include "planner/controller/coordination_rules.hpp"

#include <algorithm>

#include "planner/common/demand.hpp"

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
  HLC_DEMAND(found != coordination_rules().end());
  return found->first;
}

}  // namespace hlc::controller
