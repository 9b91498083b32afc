#include "planner/scenario/profile.hpp"

#include <stdexcept>

namespace hlc::scenario {

Profile profile_from_name(const std::string& name) {
  if (name == "default") {
    return {.name = name,
            .reference_rule = road::half_speed_last,
            .engine = search::Engine::kBranchAndBound,
            .cost_to_go = search::CostToGo::kReachable,
            .strategies = {}};
  }
  if (name == "2022") {
    return {.name = name,
            .reference_rule = road::half_speed_last,
            .engine = search::Engine::kBestFirst,
            .cost_to_go = search::CostToGo::kReferenceSpeed,
            .strategies = {.coordination = controller::kAgreedCoordination,
                           .incumbent = &controller::no_incumbent,
                           .standstill_timeout = &controller::no_timeout}};
  }
  throw std::invalid_argument("--profile = " + name + ", must be one of default, 2022");
}

}  // namespace hlc::scenario
