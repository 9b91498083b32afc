#include "planner/plot/automaton_data.hpp"

namespace hlc::plot {

nlohmann::ordered_json automaton_data(const automaton::AutomatonFile& file) {
  using Json = nlohmann::ordered_json;
  Json data{{"labels", file.labels}, {"trims", Json::array()}, {"maneuvers", Json::array()}};
  for (const automaton::Trim& trim : file.automaton->trims) {
    data["trims"].push_back({{"speed_mps", trim.speed_mps}, {"steering_rad", trim.steering_rad}});
  }
  for (const automaton::Maneuver& maneuver : file.automaton->maneuvers) {
    if (maneuver.from == maneuver.to) continue;
    data["maneuvers"].push_back({{"from", maneuver.from.index + 1},
                                 {"to", maneuver.to.index + 1},
                                 {"label", maneuver.label}});
  }
  return data;
}

}  // namespace hlc::plot
