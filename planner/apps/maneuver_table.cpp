#include "planner/apps/maneuver_table.hpp"

#include <algorithm>
#include <optional>

#include "planner/common/csv.hpp"

namespace hlc::apps {
namespace {

std::optional<double> value_of(const std::string& criterion, const automaton::Maneuver& maneuver) {
  const auto found = std::ranges::find(maneuver.criteria, criterion, &CriterionValue::name);
  return found == maneuver.criteria.end() ? std::nullopt : std::optional(found->value);
}

}  // namespace

std::string maneuver_table(const automaton::UniversalAutomaton& automaton) {
  std::string text = "from,to,criterion,intervals,J1,J2,dx,dy,dpsi,v_max,status\n";
  for (const automaton::Maneuver& m : automaton.maneuvers) {
    if (m.is_self_loop()) continue;
    text += CsvLine(m.from.index + 1, m.to.index + 1, m.label, m.inputs.size(), value_of("J1", m),
                    value_of("J2", m), m.displacement.x_m, m.displacement.y_m,
                    m.displacement.heading_rad, automaton::top_speed_mps(m), "optimal")
                .text();
  }
  return text;
}

}  // namespace hlc::apps
