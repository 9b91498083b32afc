#include "planner/policy/policy_check.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>

#include "planner/automaton/lab_check.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/policy/policy.hpp"
#include "planner/policy/prepared_choice.hpp"
#include "planner/policy/speed_zones.hpp"
#include "planner/search/edge_costs.hpp"

namespace hlc::policy {
namespace {

void check(const automaton::Subgraph& subgraph, const ReconfigurationSettings& settings,
           const std::optional<vehicle::LabLimits>& lab) {
  if (const std::string fault = lab ? automaton::validate_for_lab(subgraph, *lab) : "";
      !fault.empty()) {
    throw std::invalid_argument("subgraph " + subgraph.spec().name + ": " + fault);
  }
  for (const PolicySettings& one : settings.policies) {
    const auto* look_ahead = std::get_if<LookAheadSettings>(&one);
    if (look_ahead == nullptr) continue;
    static_cast<void>(search::EdgeCosts(subgraph, look_ahead->criterion_weights, 1));
  }
}

}  // namespace

std::vector<SubgraphRequest> requests_of(const ReconfigurationSettings& settings) {
  std::vector<SubgraphRequest> requests{{}};
  for (const PolicySettings& one : settings.policies) {
    for (const SubgraphRequest& request : make_policy(one)->choices()) {
      if (std::ranges::find(requests, request) == requests.end()) requests.push_back(request);
    }
  }
  return requests;
}

void check_reconfiguration(const automaton::Subgraph& base, const ReconfigurationSettings& settings,
                           std::size_t horizon_steps,
                           const std::optional<vehicle::LabLimits>& lab) {
  const std::vector<double> limits = limits_mps(settings.zones);
  for (const SubgraphRequest& request : requests_of(settings)) {
    check(*automaton::requested_subgraph(base, request, horizon_steps), settings, lab);
    for (const double limit_mps : limits) {
      try {
        check(*limited_subgraph(base, request, limit_mps, horizon_steps), settings, lab);
      } catch (const std::invalid_argument& error) {
        throw std::invalid_argument("in the zone of " + shortest_text(limit_mps) +
                                    " m/s: " + error.what());
      }
    }
  }
}

}  // namespace hlc::policy
