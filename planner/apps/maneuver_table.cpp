#include "planner/apps/maneuver_table.hpp"

#include <algorithm>

#include "planner/common/yaml_text.hpp"

namespace hlc {
namespace {

std::string value_of(const std::string& criterion, const Maneuver& maneuver) {
  const auto found = std::ranges::find(maneuver.criteria, criterion, &CriterionValue::name);
  return found == maneuver.criteria.end() ? "" : shortest_text(found->value);
}

std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::string maneuver_table(const UniversalAutomaton& automaton) {
  std::string text = "from,to,criterion,intervals,J1,J2,dx,dy,dpsi,v_max,status\n";
  for (const Maneuver& m : automaton.maneuvers) {
    if (m.from == m.to) continue;
    text += std::to_string(m.from.index + 1) + "," + std::to_string(m.to.index + 1) + "," +
            field(m.label) + "," + std::to_string(m.inputs.size()) + "," + value_of("J1", m) + "," +
            value_of("J2", m) + "," + shortest_text(m.displacement.x_m) + "," +
            shortest_text(m.displacement.y_m) + "," + shortest_text(m.displacement.heading_rad) +
            "," + shortest_text(top_speed_mps(m)) + ",optimal\n";
  }
  return text;
}

}  // namespace hlc
