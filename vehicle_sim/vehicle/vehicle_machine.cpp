#include "vehicle_sim/vehicle/vehicle_machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::simulated_vehicle {
namespace {

static_assert(machine::Machine<VehicleMachine>);

/// After this many missed ticks (10 s) the vehicle stands anyway.
constexpr Nanoseconds kMostMissedTicks = 500;

const char* reason(tracking::FollowerStatus status) {
  switch (status) {
    case tracking::FollowerStatus::kFollowing:
      return "following";
    case tracking::FollowerStatus::kNoCommand:
      return "no usable command";
    case tracking::FollowerStatus::kNotFollowable:
      return "command empty, malformed, too short or beyond the limits";
    case tracking::FollowerStatus::kTooFar:
      return "too far from its reference";
    case tracking::FollowerStatus::kNoEstimate:
      return "vehicle state not finite";
  }
  return "";
}

}  // namespace

VehicleMachine::VehicleMachine(const VehicleMachineOptions& options)
    : options_(options),
      vehicle_(options.vehicle),
      start_up_(options.startup_timeout),
      lab_control_(options.rules.lab_control_grace),
      // The lab's controllers do not answer before the start. Ours does so soon enough.
      wait_timed_out_(options.is_among_lab_programs) {}

// --- events -------------------------------------------------------------------------------------

void VehicleMachine::on(Event event) {
  std::visit([this](auto& what) { take(std::move(what)); }, event);
}

void VehicleMachine::take(const SystemTrigger& trigger) {
  if (trigger.next_start == kStopSymbol) stop_symbol_ = true;
}

void VehicleMachine::receive_commands(const Instant& now, Actions& actions) {
  const RunParameters& parameters = start_up_.parameters();
  const Nanoseconds period = parameters.complete() ? parameters.period() : 0;
  for (Command& any : std::exchange(received_.commands, {})) {
    const auto stamp = std::visit([](const auto& command) { return command.create_stamp; }, any);
    const machine::StampedMessage message{"command", middleware_name, options_.vehicle.vehicle_id,
                                          stamp};
    if (!received_.check.accepts(message, now, period, actions)) continue;
    received_.newest_answer = std::max(received_.newest_answer, stamp);
    wait_timed_out_ = false;
    std::visit([this](auto& command) { vehicle_.receive(std::move(command)); }, any);
  }
}

// --- what to do ---------------------------------------------------------------------------------

std::vector<VehicleMachine::Action> VehicleMachine::advance(const Instant& now) {
  Actions actions;
  receive_commands(now, actions);
  if (exit_code_) return actions;
  if (is_end_requested_) {
    exit_code_ = kExitGood;
    return actions;
  }
  if (!is_prepared(now, actions)) return actions;
  if (!pending_) {
    if (const std::optional<Nanoseconds> tick = ticks_->take(now)) {
      pending_ = {.time = *tick, .patience_ends = now.wall + options_.rules.patience};
    }
  }
  if (pending_ && !awaits_answer(*pending_, now, actions)) {
    run_tick(std::exchange(pending_, std::nullopt)->time, actions);
  }
  if (!pending_ && !exit_code_) watch_lab_control(now.wall, actions);
  return actions;
}

WakeUp VehicleMachine::wake_up() const {
  if (exit_code_) return {};
  if (!ticks_) return {.wall = start_up_.wake_up()};
  if (pending_) return {.wall = pending_->patience_ends};
  return {.run = ticks_->next()};
}

std::size_t VehicleMachine::awaited() const {
  return !ticks_ || pending_ ? 1 : machine::kOnlyUrgent;
}

void VehicleMachine::fail(int exit_code, std::string line, Actions& actions) {
  exit_code_ = exit_code;
  actions.emplace_back(machine::error(std::move(line)));
}

// --- start --------------------------------------------------------------------------------------

bool VehicleMachine::is_prepared(const Instant& now, Actions& actions) {
  if (ticks_) return true;
  if (options_.rules.connects_before_start) {
    if (stop_symbol_) {
      exit_code_ = kExitGood;
      return false;
    }
    const bool knows = start_up_.learn(now.wall, actions);
    if (knows) {
      if (std::string fault = parameter_fault(); !fault.empty()) {
        fail(kExitBadInput, std::move(fault), actions);
        return false;
      }
    }
    if (!knows || !start_up_.connect(now.wall, who_is_missing(), actions)) {
      exit_code_ = start_up_.exit_code();
      return false;
    }
  }
  begin_ticks(options_.ticks_by_period ? start_up_.parameters().period() : kVehiclePeriod, now);
  return true;
}

/// The vehicle's own ticks where a period does not consist of them.
void VehicleMachine::begin_ticks(Nanoseconds period, const Instant& now) {
  ticks_.emplace(period % kVehiclePeriod == 0 ? period : kVehiclePeriod, 0, now);
}

std::string VehicleMachine::parameter_fault() const {
  const RunParameters& parameters = start_up_.parameters();
  if (parameters.period() == 0) return std::string(kPeriodParameter) + " = 0, must be > 0";
  if (std::ranges::count(parameters.active_ids(), options_.vehicle.vehicle_id) == 0) {
    return fmt::format("--vehicle_id={} is not among the {}: {}", options_.vehicle.vehicle_id,
                       kActiveIdsParameter, fmt::join(parameters.active_ids(), ", "));
  }
  return {};
}

bool VehicleMachine::is_guest(std::int32_t id) const {
  return std::ranges::find(options_.guest_ids, id) != options_.guest_ids.end();
}

/// A state or a command without a receiver is lost, and then a tick would wait for it. Among the
/// lab's programs: of any participant.
bool VehicleMachine::is_connected() const {
  if (presence_.ready_readers == 0 || presence_.trigger_writers == 0) return false;
  if (options_.is_among_lab_programs) {
    return presence_.state_readers.count > 0 && presence_.command_writers.count > 0;
  }
  const bool all_middlewares_receive =
      std::ranges::all_of(start_up_.parameters().active_ids(), [&](std::int32_t id) {
        return is_guest(id) || presence_.state_readers.names.contains(
                                   middleware_name(static_cast<std::uint8_t>(id)));
      });
  const std::uint8_t own = options_.vehicle.vehicle_id;
  return all_middlewares_receive &&
         (is_guest(own) || presence_.command_writers.names.contains(middleware_name(own)));
}

std::string VehicleMachine::who_is_missing() const {
  std::vector<std::string> missing;
  if (is_connected()) return {};
  if (presence_.ready_readers == 0 || presence_.trigger_writers == 0) {
    missing.emplace_back(kLabControlName);
  }
  for (const std::int32_t id : start_up_.parameters().active_ids()) {
    if (is_guest(id)) continue;
    const std::string middleware = middleware_name(static_cast<std::uint8_t>(id));
    const bool commands =
        id != options_.vehicle.vehicle_id || presence_.command_writers.names.contains(middleware);
    if (!presence_.state_readers.names.contains(middleware) || !commands) {
      missing.push_back(middleware);
    }
  }
  return fmt::format("{}", fmt::join(missing, ", "));
}

// --- one tick -----------------------------------------------------------------------------------

bool VehicleMachine::is_answered(Nanoseconds list) const {
  const std::uint8_t id = options_.vehicle.vehicle_id;
  return stop_symbol_ || received_.newest_answer >= list || wait_timed_out_ ||
         presence_.lab.lost.contains(middleware_name(id)) ||
         presence_.lab.lost.contains(controller_name(id));
}

bool VehicleMachine::awaits_answer(const PendingTick& tick, const Instant& now, Actions& actions) {
  if (options_.rules.patience == 0 || vehicle_.is_braking()) return false;
  if (is_guest(options_.vehicle.vehicle_id)) return false;
  const std::optional<Nanoseconds> list =
      last_list_before(tick.time, start_up_.parameters().period());
  if (!list || is_answered(*list)) return false;
  if (now.wall < tick.patience_ends) return true;
  actions.emplace_back(
      machine::warning(fmt::format("no answer to the list of {} ns within {} s; no longer waiting",
                                   *list, options_.rules.patience / kNanosecondsPerSecond)));
  wait_timed_out_ = true;
  return false;
}

void VehicleMachine::run_tick(Nanoseconds t_now, Actions& actions) {
  const bool is_by_period = ticks_->period() > kVehiclePeriod;
  if (is_by_period) brake_if_stopped(actions);  // nothing of the period has happened yet
  make_up_for_missed_ticks(t_now, actions);
  brake_if_stopped(actions);
  if (is_by_period && is_stopping_) begin_ticks(kVehiclePeriod, {.run = t_now + 1});
  const SimulatedVehicle::Tick done = vehicle_.tick(t_now);
  actions.emplace_back(done.driven);
  actions.emplace_back(done.state);
  actions.emplace_back(done.observation);
  log_why_it_stops(done, actions);
  last_tick_ = t_now;
  if (is_stopping_ && !vehicle_.is_braking()) {
    is_stopping_ = false;
    if (!options_.keep_running) exit_code_ = kExitGood;
  }
}

void VehicleMachine::make_up_for_missed_ticks(Nanoseconds t_now, Actions& actions) {
  if (!last_tick_) return;
  const Nanoseconds earliest = t_now - std::min(t_now, kMostMissedTicks * kVehiclePeriod);
  for (Nanoseconds t = std::max(*last_tick_ + kVehiclePeriod, earliest); t < t_now;
       t += kVehiclePeriod) {
    const SimulatedVehicle::Tick done = vehicle_.tick(t);
    actions.emplace_back(done.driven);
    if (is_in_list(t)) actions.emplace_back(done.state);
    log_why_it_stops(done, actions);
  }
}

/// The next list holds the state of this made-up tick.
bool VehicleMachine::is_in_list(Nanoseconds t) const {
  if (ticks_->period() == kVehiclePeriod) return false;
  const Nanoseconds list = next_on_grid(t, ticks_->period(), kListOffset);
  return newest_valid_state_stamp(list) == t;
}

void VehicleMachine::brake_if_stopped(Actions& actions) {
  if (!std::exchange(stop_symbol_, false)) return;
  actions.emplace_back(machine::info("stop"));
  vehicle_.brake();
  is_stopping_ = true;
}

void VehicleMachine::log_why_it_stops(const SimulatedVehicle::Tick& done, Actions& actions) {
  if (last_status_ == tracking::FollowerStatus::kFollowing && done.status != last_status_ &&
      !is_stopping_) {
    actions.emplace_back(
        machine::warning(fmt::format("stops at {} ns: {}", done.driven.t, reason(done.status))));
  }
  last_status_ = done.status;
}

/// Without the lab control the plan is driven to its end before the vehicle leaves; a braking
/// vehicle leaves as requested.
void VehicleMachine::watch_lab_control(Nanoseconds wall, Actions& actions) {
  if (!lab_control_.is_over(presence_.lab.lost.contains(kLabControlName), wall)) return;
  if (is_stopping_ || stop_symbol_) {
    exit_code_ = kExitGood;
  } else {
    fail(kExitDied, std::string(kLabControlName) + " lost", actions);
  }
}

}  // namespace hlc::simulated_vehicle
