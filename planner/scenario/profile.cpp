#include "planner/scenario/profile.hpp"

#include <stdexcept>

namespace hlc {

Profile profile_from_name(const std::string& name) {
  if (name == "default") {
    return {.name = name,
            .reference_rule = half_speed_last,
            .engine = Engine::kBranchAndBound,
            .cost_to_go = CostToGo::kReachable,
            .strategies = {}};
  }
  if (name == "2022") {
    return {.name = name,
            .reference_rule = half_speed_last,
            .engine = Engine::kBestFirst,
            .cost_to_go = CostToGo::kReferenceSpeed,
            .strategies = {.commit = kAgreedCommit,
                           .coupled_obstacles = &predictions_and_standing_successors,
                           .incumbent = &no_incumbent,
                           .standstill_timeout = nullptr}};
  }
  throw std::invalid_argument("--profile = " + name + ", must be one of default, 2022");
}

}  // namespace hlc
