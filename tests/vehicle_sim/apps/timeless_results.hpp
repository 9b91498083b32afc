#pragma once

#include <nlohmann/json.hpp>

namespace hlc::test {

/// The content of a campaign's results.json without what a clock measured.
template <class Json>
[[nodiscard]] Json timeless(Json results) {
  for (auto& run : results["runs"]) {
    run.erase("wall_s");
    run.erase("realtime_factor");
    for (const char* time : {"planning_mean_ms", "planning_std_ms", "planning_max_ms",
                             "exceeding_step_share", "step_p99_ms", "step_max_ms", "wall_s",
                             "wall_planning_s", "wall_coordination_s", "wall_vehicles_s"}) {
      run["figures"].erase(time);
    }
    for (auto& vehicle : run["vehicles"]) vehicle.erase("planning_time_ms");
  }
  return results;
}

}  // namespace hlc::test
