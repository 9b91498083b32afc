#include "vehicle_sim/campaign/sweep_settings.hpp"

#include "planner/controller/coordination_rules.hpp"
#include "planner/coordination/priorities/strategies.hpp"

namespace hlc::campaign {
namespace {

/// The search of 2022 has neither an incumbent nor a way out after a standstill.
void set_search(const SweepValue& value, scenario::Scenario& scenario) {
  const scenario::Profile of =
      scenario::profile_from_name(value.text == "2022" ? value.text : "default");
  scenario.search.engine = value.text == "branch_and_bound" ? search::Engine::kBranchAndBound
                                                            : search::Engine::kBestFirst;
  scenario.search.cost_to_go = of.cost_to_go;
  scenario.profile.strategies.incumbent = of.strategies.incumbent;
  scenario.profile.strategies.standstill_timeout = of.strategies.standstill_timeout;
}

void set_drivable(const SweepValue& value, scenario::Scenario& scenario) {
  if (value.text == "lanes") return;
  for (scenario::ScenarioVehicle& vehicle : scenario.vehicles) vehicle.corridor = road::Corridor();
}

void set_wheelbase(const SweepValue& value, maneuver_design::AutomatonConfiguration& automaton) {
  vehicle::VehicleParameters& vehicle = automaton.vehicle;
  vehicle.rear_axle_to_cg_m *= value.number / vehicle.wheelbase_m;
  vehicle.wheelbase_m = value.number;
}

void set_reference_speed(const SweepValue& value, scenario::Scenario& scenario) {
  scenario.reference_speed_mps = value.number;
}

void set_contouring_weight(const SweepValue& value, scenario::Scenario& scenario) {
  scenario.contouring_weight = value.number;
  scenario.held_up_contouring_weight.reset();
}

void set_coordination(const SweepValue& value, scenario::Scenario& scenario) {
  scenario.profile.strategies.coordination = controller::coordination_rules().at(value.text);
}

void set_priorities(const SweepValue& value, scenario::Scenario& scenario) {
  coordination::PriorityRule& rule = scenario.profile.strategies.priorities;
  rule.strategy = coordination::priority_strategy(value.text);
  if (rule.strategy->search != nullptr) scenario.rounds = controller::Rounds::kTwo;
}

void set_reference_rule(const SweepValue& value, scenario::Scenario& scenario) {
  scenario.profile.reference_rule =
      value.text == "2022" ? road::half_speed_last : road::mean_speed_first;
}

using Automaton = maneuver_design::AutomatonConfiguration;
using Value = SweepValue;

std::vector<SweepSetting> scenario_settings() {
  return {
      {kProfileSetting, false, one_of({"default", "2022"}), {}, {}},
      {"coordination", false, one_of({"agreed", "cooperative", "strict"}), {}, set_coordination},
      {"priorities", false, one_of(coordination::priority_strategy_names()), {}, set_priorities},
      {"reference_rule", false, one_of({"2022", "later"}), {}, set_reference_rule},
      {"search", false, one_of({"branch_and_bound", "best_first", "2022"}), {}, set_search},
      {"reference_speed_mps", true, above(0.0, 100.0), {}, set_reference_speed},
      {"contouring_weight",
       true,
       between(0.0, controller::kMostContouringWeight),
       {},
       set_contouring_weight},
      {"drivable", false, one_of({"lanes", "everywhere"}), {}, set_drivable},
  };
}

std::vector<SweepSetting> automaton_settings() {
  return {
      {"acceleration_mps2",
       true,
       above(0.0, 1e4),
       [](const Value& value, Automaton& automaton) {
         automaton.limits.acceleration_mps2 = value.number;
       },
       {}},
      {"steering_rate_radps",
       true,
       above(0.0, 1e4),
       [](const Value& value, Automaton& automaton) {
         automaton.limits.steering_rate_radps = value.number;
       },
       {}},
      {"speed_max_mps",
       true,
       above(0.0, 100.0),
       [](const Value& value, Automaton& automaton) {
         automaton.limits.speed_max_mps = value.number;
       },
       {}},
      {"own_steps",
       false,
       one_of(maneuver_design::kSelfLoopNames),
       [](const Value& value, Automaton& automaton) {
         automaton.self_loops = maneuver_design::self_loops_named(value.text);
       },
       {}},
      {"wheelbase_m", true, above(0.0, 100.0), set_wheelbase, {}},
      {"width_m",
       true,
       above(0.0, 100.0),
       [](const Value& value, Automaton& automaton) {
         automaton.vehicle.footprint.width_m = value.number;
       },
       {}},
      {"safety_margin_m",
       true,
       between(0.0, 100.0),
       [](const Value& value, Automaton& automaton) {
         automaton.vehicle.safety_margin_m = value.number;
       },
       {}},
  };
}

/// Which a sweep applies itself.
std::vector<SweepSetting> other_settings() {
  return {
      // One automaton with every edge serves all choices of trims.
      {kTrimsSetting,
       false,
       {},
       [](const Value&, Automaton& automaton) {
         automaton.edges = maneuver_design::EdgeChoice::kAll;
       },
       {}},
      {kVehicleSetting, false, one_of({"identified", kExactVehicle}), {}, {}},
      {kLapSetting, false, one_of({"standing", "flying"}), {}, {}},
  };
}

}  // namespace

const std::vector<SweepSetting>& sweep_settings() {
  static const std::vector<SweepSetting> kAll = [] {
    std::vector<SweepSetting> all = scenario_settings();
    for (const auto& more : {automaton_settings(), other_settings()}) {
      all.insert(all.end(), more.begin(), more.end());
    }
    return all;
  }();
  return kAll;
}

}  // namespace hlc::campaign
