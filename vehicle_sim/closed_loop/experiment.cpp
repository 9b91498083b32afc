#include "vehicle_sim/closed_loop/experiment.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "hlc_bridge/hlc/hlc_core.hpp"
#include "hlc_bridge/hlc/observation.hpp"
#include "hlc_bridge/lab_control/logical_run.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/middleware/command_check.hpp"
#include "hlc_bridge/middleware/state_buffer.hpp"
#include "planner/common/demand.hpp"
#include "planner/controller/joint_step.hpp"
#include "planner/policy/subgraph_selector.hpp"
#include "vehicle_sim/closed_loop/applied_forks.hpp"
#include "vehicle_sim/closed_loop/guest_vehicle.hpp"
#include "vehicle_sim/closed_loop/member.hpp"
#include "vehicle_sim/closed_loop/stamps_of.hpp"
#include "vehicle_sim/vehicle/simulated_vehicle.hpp"

namespace hlc::closed_loop {
namespace {

lab_control::LabRunSettings settings_of(const scenario::Scenario& scenario, std::uint64_t steps) {
  lab_control::LabRunSettings settings;
  for (const scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    settings.vehicle_ids.push_back(vehicle.id.value);
  }
  settings.period =
      static_cast<Nanoseconds>(std::llround(1e9 * scenario.subgraph->automaton().step_s));
  settings.steps = steps;
  HLC_DEMAND(settings.period % kVehiclePeriod == 0, settings.period, kVehiclePeriod);
  return settings;
}

std::function<Nanoseconds()> or_zero(const std::function<Nanoseconds()>& clock) {
  return clock ? clock : [] { return Nanoseconds{}; };
}

class Lab {
 public:
  Lab(const scenario::Scenario& scenario, const ExperimentOptions& options)
      : settings_(settings_of(scenario, options.steps)),
        run_(settings_),
        rules_(options.rules),
        after_step_(options.after_step),
        wall_clock_(or_zero(options.clocks.wall)),
        cpu_clock_(or_zero(options.clocks.cpu)) {
    const controller::PreparedSubgraph prepared =
        options.prepared ? *options.prepared : scenario::prepare_subgraph_of(scenario);
    for (const scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
      const std::uint8_t id = vehicle.id.value;
      simulated_vehicle::SimulatedVehicleOptions simulated{
          .vehicle_id = id,
          .start = scenario::measured_start(scenario, vehicle),
          .gains = options.gains,
          .vehicle = scenario.subgraph->automaton().identified,
          .stamps = options.stamps.value_or(stamps_of(scenario))};
      if (options.noise_seed) simulated.noise_seed = *options.noise_seed + id;
      high_level_controller::HlcCore hlc(scenario::make_controller(scenario, vehicle.id, prepared));
      controller::ControlLoop loop(hlc.controller(), cpu_clock_);
      policy::SubgraphSelector choice(hlc.controller(), scenario.reconfiguration);
      members_.push_back({.id = id,
                          .vehicle = simulated_vehicle::SimulatedVehicle(simulated),
                          .hlc = std::move(hlc),
                          .loop = std::move(loop),
                          .choice = std::move(choice)});
    }
    std::ranges::sort(members_, {}, &Member::id);
    for (const scenario::ScenarioGuest& guest : scenario.guests) {
      const std::uint8_t id = guest.guest.vehicle.value;
      std::optional<std::uint64_t> noise_seed;
      if (options.noise_seed) noise_seed = *options.noise_seed + id;
      guests_.emplace(id, simulated_vehicle::SimulatedVehicle(guest_vehicle(
                              guest, noise_seed, options.stamps.value_or(stamps_of(scenario)))));
    }
    forks_.emplace(options.forks, scenario, members_);
  }

  Experiment drive() {
    const Nanoseconds from = wall_clock_();
    appear();
    while (!run_.finished()) {
      for (const Nanoseconds trigger : run_.advance(kNoWallTime).triggers) {
        if (trigger == kStopSymbol) {
          stop();
        } else {
          release(trigger);
        }
      }
    }
    write_facts();
    experiment_.facts.wall_s = seconds_since(from);
    return std::move(experiment_);
  }

 private:
  /// No participant delays another one here.
  static constexpr Nanoseconds kNoWallTime = 0;

  [[nodiscard]] double seconds_since(Nanoseconds from) const {
    return 1e-9 * static_cast<double>(wall_clock_() - from);
  }

  /// All are present, receive each other and request their first tick.
  void appear() {
    std::set<std::string> timers;
    for (const Member& member : members_) {
      alive_.insert(controller_name(member.id));
      run_.ready({.source_id = vehicle_name(member.id), .next_start = 0});
      run_.ready({.source_id = middleware_name(member.id), .next_start = kListOffset});
      timers.insert({vehicle_name(member.id), middleware_name(member.id)});
    }
    alive_.insert(timers.begin(), timers.end());
    run_.presence(alive_, lost_);
    run_.trigger_readers(timers);
  }

  void release(Nanoseconds t) {
    if (t % settings_.period == kListOffset) {
      answer_list(t);
      for (const std::uint8_t id : settings_.vehicle_ids) {
        run_.ready({.source_id = middleware_name(id), .next_start = t + settings_.period});
      }
    } else {
      const Nanoseconds from = wall_clock_();
      for (Member& member : members_) tick(member, t);
      for (auto& [id, vehicle] : guests_) {
        const simulated_vehicle::SimulatedVehicle::Tick done = vehicle.tick(t);
        states_.add(id, done.state);
        experiment_.drives[id].push_back(done.driven);
      }
      for (const VehicleId gone : forks_->gone()) {
        run_.ready({.source_id = vehicle_name(gone.value), .next_start = t + kVehiclePeriod});
      }
      experiment_.wall.vehicles_s += seconds_since(from);
    }
  }

  void tick(Member& member, Nanoseconds t) {
    if (member.has_left) return;
    const simulated_vehicle::SimulatedVehicle::Tick done = member.vehicle.tick(t);
    states_.add(member.id, done.state);
    experiment_.drives[member.id].push_back(done.driven);
    if (member.is_stop_requested && !member.vehicle.is_braking()) {
      member.has_left = true;
      alive_.erase(vehicle_name(member.id));
      lost_.insert(vehicle_name(member.id));
      run_.presence(alive_, lost_);
    } else {
      run_.ready({.source_id = vehicle_name(member.id), .next_start = t + kVehiclePeriod});
    }
  }

  void answer_list(Nanoseconds t_now) {
    const Nanoseconds from = cpu_clock_();
    const StepIndex step{step_at(t_now, settings_.period)};
    if (start_) apply_forks(step);
    std::vector<std::int32_t> active;
    for (const Member& member : members_) active.push_back(member.id);
    for (const auto& [id, vehicle] : guests_) active.push_back(id);
    std::ranges::sort(active);
    states_.forget_before(t_now);
    const VehicleStateList list =
        middleware::compose_state_list(states_, t_now, settings_.period, active);
    std::vector<ReportRecord> reports = step_controllers(list);
    for (std::size_t i = 0; i < members_.size(); ++i) {
      Member& member = members_[i];
      const high_level_controller::AnswerToList answer = member.hlc.answer(list);
      forward(answer.command, t_now, member);
      for (const TrajectoryCommand& copy : answer.copies) forward(copy, t_now, member);
      reports[i].report = high_level_controller::with_answer(std::move(reports[i].report), answer);
      member.hlc.controller().note_causes(reports[i].report);
      member.hlc.controller().note_bound(reports[i].report);
      report(reports[i]);
      if (after_step_) after_step_(member.hlc.controller(), member.choice, reports[i].report);
      if (reports[i].report.status == coordination::StepStatus::kStandby) continue;
      member.choice.end_step(member.hlc.controller(), reports[i].report);
    }
    if (start_) experiment_.steps_s.push_back(1e-9 * static_cast<double>(cpu_clock_() - from));
    // Lab control ends a run in logical time when a process is gone.
    for (const VehicleId gone : forks_->gone())
      run_.report({.report = {.vehicle = gone, .step = step}});
  }

  /// @pre the experiment has begun
  void apply_forks(StepIndex step) {
    forks_->apply(step.value - start_->value, step, members_, rules_);
  }

  /// In the order of the members.
  std::vector<ReportRecord> step_controllers(const VehicleStateList& list) {
    controller::Observation observation;
    bool begins = true;
    for (Member& member : members_) {
      observation = member.hlc.observe(list).value();
      if (!member.hlc.has_begun()) member.hlc.note(list, observation);
      begins = member.hlc.begins(list, observation, high_level_controller::StartRule::kTogether,
                                 std::nullopt) &&
               begins;
    }
    observation.present = observation.active;
    if (begins && !start_) {
      start_ = observation.step;
      apply_forks(*start_);
    }
    std::vector<ReportRecord> records(members_.size());
    for (std::size_t i = 0; i < members_.size(); ++i) {
      Member& member = members_[i];
      const Nanoseconds from_cpu = cpu_clock_();
      static_cast<void>(member.choice.begin_step(
          member.hlc.controller(), observation.step, start_,
          high_level_controller::battery_voltage_v(list, VehicleId{member.id})));
      records[i].planning_ns = cpu_clock_() - from_cpu;
    }
    if (begins) {
      run_step(observation, records);
    } else {
      for (std::size_t i = 0; i < members_.size(); ++i) {
        records[i] = {.report = members_[i].loop.stand_by(observation)};
      }
    }
    return records;
  }

  void run_step(const controller::Observation& observation, std::vector<ReportRecord>& records) {
    std::vector<controller::ControlLoop*> loops;
    for (Member& member : members_) loops.push_back(&member.loop);
    double planning_s = 0.0;
    controller::JointStepRules rules = rules_;
    rules.around_planning = [&](const std::function<void()>& plan) {
      const Nanoseconds from = wall_clock_();
      plan();
      planning_s += seconds_since(from);
    };
    const Nanoseconds from = wall_clock_();
    std::vector<coordination::Report> reports = controller::joint_step(loops, observation, rules);
    const double step_s = seconds_since(from);
    for (std::size_t i = 0; i < reports.size(); ++i) {
      records[i].report = std::move(reports[i]);
      records[i].planning_ns += members_[i].loop.planning_ns();
    }
    experiment_.wall.planning_s += planning_s;
    experiment_.wall.coordination_s += step_s - planning_s;
  }

  void report(const ReportRecord& record) {
    run_.report(record);
    experiment_.reports.push_back(record);
  }

  static void forward(const TrajectoryCommand& command, Nanoseconds t_now, Member& member) {
    const std::vector<std::uint8_t> own{member.id};
    if (middleware::check_command(command, t_now, t_now, own).forward)
      member.vehicle.receive(command);
  }

  void stop() {
    for (Member& member : members_) {
      member.vehicle.brake();
      member.is_stop_requested = true;
    }
    for (auto& [id, vehicle] : guests_) vehicle.brake();
    for (const VehicleId gone : forks_->gone()) {
      alive_.erase(vehicle_name(gone.value));
      lost_.insert(vehicle_name(gone.value));
    }
  }

  void write_facts() {
    const lab_control::LabRunResult& result = run_.result();
    result::RunFacts& facts = experiment_.facts;
    facts.simulated_time = true;
    facts.vehicle_ids = settings_.vehicle_ids;
    facts.period = settings_.period;
    facts.steps = settings_.steps;
    facts.first_step = result.first_step;
    facts.clock_s = 1e-9 * static_cast<double>(result.clock);
    facts.exit_code = result.exit_code;
    facts.reason = result.reason;
    facts.died = result.deaths;
  }

  lab_control::LabRunSettings settings_;
  lab_control::LogicalRun run_;
  controller::JointStepRules rules_;
  ExperimentOptions::AfterStep after_step_;
  std::function<Nanoseconds()> wall_clock_;
  std::function<Nanoseconds()> cpu_clock_;
  std::vector<Member> members_;  ///< by id
  std::map<std::uint8_t, simulated_vehicle::SimulatedVehicle> guests_;
  std::optional<AppliedForks> forks_;
  middleware::StateBuffer states_;
  std::optional<StepIndex> start_;  ///< first step of the experiment, once it has begun
  std::set<std::string> alive_;
  std::set<std::string> lost_;
  Experiment experiment_;
};

}  // namespace

Experiment drive_experiment(const scenario::Scenario& scenario, const ExperimentOptions& options) {
  return Lab(scenario, options).drive();
}

}  // namespace hlc::closed_loop
