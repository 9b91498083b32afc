#include "vehicle_sim/campaign/driven_costs.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "hlc_bridge/result/planned_motion.hpp"

namespace hlc::campaign {
namespace {

using RowsOfVehicle = std::vector<const result::StepRecord*>;

/// A sum with an unknown term is unknown.
struct CostSum {
  std::string criterion;
  double sum{};
  bool is_known{true};

  void add(const automaton::Maneuver* maneuver) {
    is_known = is_known && maneuver != nullptr;
    if (!is_known) return;
    const auto value = std::ranges::find(maneuver->criteria, criterion, &CriterionValue::name);
    is_known = value != maneuver->criteria.end();
    if (is_known) sum += value->value;
  }

  [[nodiscard]] std::optional<double> per_metre(double metres) const {
    return is_known && metres > 0.0 ? std::optional(sum / metres) : std::nullopt;
  }
};

double metres_driven(const result::Drive& drive, Nanoseconds from, Nanoseconds to) {
  double metres = 0.0;
  for (std::size_t i = 1; i < drive.size(); ++i) {
    if (drive[i - 1].t < from || drive[i].t > to) continue;
    metres += (drive[i].pose.position_m() - drive[i - 1].pose.position_m()).norm();
  }
  return metres;
}

}  // namespace

DrivenCosts driven_costs(std::span<const result::StepRecord> rows, const result::Drives& drives,
                         const result::RunFacts& facts,
                         const automaton::UniversalAutomaton& automaton) {
  std::map<VehicleId, RowsOfVehicle> by_vehicle;
  for (const result::StepRecord& row : rows) by_vehicle[row.record.report.vehicle].push_back(&row);
  CostSum effort{.criterion = "J2"};
  CostSum comfort{.criterion = "comfort"};
  double metres = 0.0;
  for (const auto& [vehicle, of_vehicle] : by_vehicle) {
    for (std::size_t k = 0; k + 1 < of_vehicle.size(); ++k) {
      const automaton::Maneuver* maneuver =
          result::maneuver_during(*of_vehicle[k], of_vehicle[k + 1], automaton);
      effort.add(maneuver);
      comfort.add(maneuver);
    }
    const auto drive = drives.find(vehicle.value);
    if (drive == drives.end()) return {};
    metres +=
        metres_driven(drive->second, of_vehicle.front()->record.report.step.value * facts.period,
                      of_vehicle.back()->record.report.step.value * facts.period);
  }
  return {.effort_per_m = effort.per_metre(metres), .comfort_per_m = comfort.per_metre(metres)};
}

}  // namespace hlc::campaign
