#include "vehicle_sim/closed_loop/run_monitor.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <utility>

#include "vehicle_sim/closed_loop/seeded_random.hpp"

namespace hlc::closed_loop {
namespace {

const automaton::UniversalAutomaton& automaton_of(const scenario::Scenario& scenario) {
  return scenario.subgraph->automaton();
}

Nanoseconds period_of(const scenario::Scenario& scenario) {
  return static_cast<Nanoseconds>(std::llround(1e9 * automaton_of(scenario).step_s));
}

std::map<std::uint8_t, Pose> starts_of(const scenario::Scenario& scenario) {
  std::map<std::uint8_t, Pose> starts;
  for (const scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    starts[vehicle.id.value] = scenario::measured_start(scenario, vehicle);
  }
  return starts;
}

std::vector<ConvexPolygon> obstacles_of(const scenario::Scenario& scenario) {
  std::vector<ConvexPolygon> areas_m;
  std::ranges::transform(scenario.obstacles, std::back_inserter(areas_m),
                         &scenario::ScenarioObstacle::area_m);
  return areas_m;
}

std::string report_line(const coordination::Report& report) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "vehicle %d, step %llu: %s, %s, at (%.3f, %.3f)",
                int{report.vehicle.value}, static_cast<unsigned long long>(report.step.value),
                coordination::to_string(report.status), coordination::to_string(report.reason),
                report.planned_pose.x_m, report.planned_pose.y_m);
  return text.data();
}

std::string follows_line(std::uint8_t vehicle, Nanoseconds create, Nanoseconds period) {
  const std::string name = "vehicle " + std::to_string(vehicle);
  if (create == 0) return name + " follows nothing";
  return name + " follows the command of step " + std::to_string(create / period);
}

}  // namespace

RunMonitor::RunMonitor(const scenario::Scenario& scenario, Nanoseconds calm_from,
                       const Trace& trace)
    : period_(period_of(scenario)),
      footprints_(automaton_of(scenario).vehicle.footprint, starts_of(scenario),
                  obstacles_of(scenario)),
      standing_(automaton_of(scenario).vehicle.footprint,
                automaton_of(scenario).vehicle.safety_margin_m),
      plans_(scenario.horizon_steps, &standing_, obstacles_of(scenario)),
      driven_(scenario.horizon_steps, period_, &standing_),
      announced_(automaton_of(scenario).vehicle.footprint, scenario.horizon_steps, period_),
      planning_(calm_from),
      trace_(trace) {}

void RunMonitor::on_log(NodeId node, const machine::LogLine& line) {
  const std::string& name = lab_->name(node);
  reasons_.log(name, line, lab_->now());
  for (const char letter : line.text) add_to_hash(static_cast<unsigned char>(letter));
  trace([&] { return name + ": " + line.text; });
}

void RunMonitor::on_driven(std::uint8_t vehicle, Nanoseconds time,
                           const result::DrivenSample& sample) {
  const Nanoseconds number = (time + kVehiclePeriod / 2) / kVehiclePeriod;
  const Nanoseconds tick = number * kVehiclePeriod;
  const VehicleId id{vehicle};
  Last& last = last_[vehicle];
  if (std::exchange(last.follows, sample.command_create) != sample.command_create) {
    trace([&] { return follows_line(vehicle, sample.command_create, period_); });
  }
  standing_.driven(id, sample.pose);
  if (!stopped_.contains(vehicle)) {
    driven_.driven(id, tick, sample.command_create, result_.violations);
    plans_.received(id, driven_.has_plan_in_force(id));
    if (driven_.is_out_of_reach(id, tick)) announced_.exempt(id, tick);
    announced_.driven(id, tick, sample.pose, sample.speed_mps, result_.violations);
  }
  footprints_.driven(vehicle, number, sample.pose,
                     stopped_.contains(vehicle) || driven_.is_out_of_reach(id, tick));
  reasons_.driven(name_of({.role = Role::kVehicle, .vehicle = vehicle}), sample.command_create != 0,
                  lab_->now());
  record(vehicle, tick, sample);
  last.pose = sample.pose;
  last.tick = tick;
  add_to_hash(std::bit_cast<std::uint64_t>(sample.pose.x_m));
  add_to_hash(std::bit_cast<std::uint64_t>(sample.pose.y_m));
  add_to_hash(sample.command_create);
}

void RunMonitor::record(std::uint8_t vehicle, Nanoseconds tick,
                        const result::DrivenSample& sample) {
  const VehicleId id{vehicle};
  if (!result_.records || stopped_.contains(vehicle) || driven_.is_out_of_reach(id, tick) ||
      announced_.is_exempt(id)) {
    return;
  }
  result::Drive& drive = result_.records->drives[vehicle];
  if (!drive.empty() && tick <= drive.back().t) return;  // made up for
  drive.push_back(sample);
  drive.back().t = tick;
}

void RunMonitor::on_prediction(const coordination::Prediction& prediction) {
  plans_.predicted(prediction);
  driven_.predicted(prediction);
  announced_.predicted(prediction);
}

void RunMonitor::on_report(const ReportRecord& record, const coordination::Plan* in_force) {
  const coordination::Report& report = record.report;
  ++result_.car_steps;
  if (report.status == coordination::StepStatus::kPlanned) ++result_.planned;
  if (driven_.is_out_of_reach(report.vehicle, report.step.value * period_) ||
      announced_.is_exempt(report.vehicle)) {
    ++result_.unreachable;
  }
  planning_.report(record, lab_->now());
  ReasonsCheck::reported(report, lab_->now(), result_.violations);
  check_lab_control(report);
  plans_.reported(report, in_force, lab_->now(), result_.violations);
  driven_.reported(report, in_force);
  announced_.reported(report, report.step.value * period_);
  if (result_.records) result_.records->reports.push_back(record);
  add_to_hash(report.step.value);
  add_to_hash(static_cast<std::uint64_t>(report.status));
  add_to_hash(std::bit_cast<std::uint64_t>(report.cost_m2));
  trace([&] { return report_line(report); });
}

/// Nobody could stop the cars. In logical time ticks end without the lab control.
void RunMonitor::check_lab_control(const coordination::Report& report) {
  const bool is_gone =
      lab_control_died_ && lab_->true_time() > *lab_control_died_ + kLabControlIsMissed;
  if (!is_gone || lab_->is_logical() || report.status != coordination::StepStatus::kPlanned) return;
  result_.violations.push_back({.at = lab_->now(),
                                .check = "stop",
                                .text = "vehicle " + std::to_string(report.vehicle.value) +
                                        " plans, and the lab control has been dead for 3 s"});
  lab_control_died_.reset();  // once
}

void RunMonitor::on_command(const TrajectoryCommand& command) {
  driven_.commanded(command, lab_->true_time(), result_.violations);
  add_to_hash(command.create_stamp);
}

void RunMonitor::held_up(const ProcessSlot& slot) {
  if (slot.key.role != Role::kController) return;
  driven_.controller_stopped(VehicleId{slot.key.vehicle}, lab_->true_time());
}

void RunMonitor::killed(const ProcessSlot& slot) {
  if (slot.key.role == Role::kLabControl) lab_control_died_ = lab_->true_time();
  if (slot.key.role == Role::kController) {
    driven_.controller_died({slot.key.vehicle});
    announced_.controller_died({slot.key.vehicle});
  }
  if (slot.key.role != Role::kVehicle || slot.process) return;
  footprints_.died(slot.key.vehicle, driven_.afterwards() / kVehiclePeriod);
  const Nanoseconds tick = last_[slot.key.vehicle].tick;
  driven_.died({slot.key.vehicle}, tick);
  announced_.exempt({slot.key.vehicle}, tick);
}

void RunMonitor::changed(const ProcessSlot& slot) {
  if (!slot.exit_code) {
    reasons_.started(slot.name);
    if (slot.key.role == Role::kVehicle) came_back(slot.key.vehicle);
    if (slot.key.role == Role::kLabControl) lab_control_died_.reset();
    if (slot.key.role == Role::kController) driven_.controller_started({slot.key.vehicle});
    return trace([&] { return slot.name + " starts"; });
  }
  trace([&] { return slot.name + " ends with code " + std::to_string(*slot.exit_code); });
  held_up(slot);
  reasons_.ended(slot.name, *slot.exit_code, lab_->now(), result_.violations);
  if (slot.key.role == Role::kVehicle) footprints_.ended(slot.key.vehicle);
  add_to_hash(static_cast<std::uint64_t>(*slot.exit_code));
}

/// It stands where it died, and its controller may not know that.
void RunMonitor::came_back(std::uint8_t vehicle) {
  footprints_.came_back(vehicle);
  announced_.exempt(VehicleId{vehicle}, lab_->true_time());
}

void RunMonitor::report_violation(const std::string& text) {
  if (!std::exchange(has_violation_, true)) {
    result_.violations.push_back({.at = lab_->now(), .check = "waits", .text = text});
  }
}

void RunMonitor::check_ticks() {
  footprints_.check(lab_->now(), result_.violations);
  reasons_.check(lab_->now(), result_.violations);
}

std::optional<Pose> RunMonitor::pose_of(std::uint8_t vehicle) const {
  const auto last = last_.find(vehicle);
  return last == last_.end() ? std::nullopt : std::optional(last->second.pose);
}

FaultRunResult RunMonitor::result() {
  check_ticks();
  result_.smallest_distance_m = footprints_.smallest_distance_m();
  return std::move(result_);
}

void RunMonitor::add_to_hash(std::uint64_t value) {
  result_.hash = mixed(result_.hash ^ value, lab_->now());
}

}  // namespace hlc::closed_loop
