#include "vehicle_sim/campaign/exact_run.hpp"

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/result/planned_motion.hpp"
#include "planner/rollout/rollout.hpp"

namespace hlc::campaign {
namespace {

/// One vehicle's planned motion as a drive, from t(first) on.
result::Drive as_drive(const std::vector<const result::StepRecord*>& rows, Nanoseconds begin,
                       Nanoseconds period, const automaton::UniversalAutomaton& automaton) {
  result::Drive drive;
  for (const vehicle::State& state :
       result::planned_motion(rows, period, kVehiclePeriod, automaton)) {
    Pose pose = state.pose;
    pose.heading_rad += automaton::yaw_minus_heading_rad(state.steering_rad, automaton.vehicle,
                                                         automaton.identified);
    drive.push_back({.t = begin + static_cast<Nanoseconds>(drive.size()) * kVehiclePeriod,
                     .pose = pose,
                     .speed_mps = state.speed_mps});
  }
  return drive;
}

}  // namespace

DrivenRun drive_exactly(scenario::Scenario scenario) {
  DrivenRun run{.scenario = std::move(scenario), .experiment = {}};
  rollout::Rollout rollout = rollout::make_rollout(run.scenario);
  const automaton::UniversalAutomaton& automaton = run.scenario.subgraph->automaton();
  result::RunFacts& facts = run.experiment.facts;
  facts.simulated_time = true;
  facts.period = static_cast<Nanoseconds>(std::llround(1e9 * automaton.step_s));
  facts.steps = run.scenario.steps;
  facts.first_step = rollout.next_step().value;
  // One more, for the motion of the last step.
  for (std::uint64_t step = 0; step <= facts.steps; ++step) {
    for (coordination::Report& report : rollout.step()) {
      run.experiment.reports.push_back({.report = std::move(report)});
    }
  }
  result::RunFacts all = facts;
  ++all.steps;
  const std::vector<result::StepRecord> records =
      result::step_records(run.experiment.reports, {}, all);
  std::map<std::uint8_t, std::vector<const result::StepRecord*>> by_vehicle;
  for (const result::StepRecord& record : records) {
    by_vehicle[record.record.report.vehicle.value].push_back(&record);
  }
  const Nanoseconds begin = static_cast<Nanoseconds>(*facts.first_step) * facts.period;
  for (const auto& [vehicle, rows] : by_vehicle) {
    facts.vehicle_ids.push_back(vehicle);
    run.experiment.drives[vehicle] = as_drive(rows, begin, facts.period, automaton);
  }
  return run;
}

}  // namespace hlc::campaign
