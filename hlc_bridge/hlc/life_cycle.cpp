#include "hlc_bridge/hlc/life_cycle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/run_parameters.hpp"
#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::high_level_controller {

LifeCycle::LifeCycle(VehicleId vehicle, const HlcRules& rules, Nanoseconds startup_timeout)
    : vehicle_(vehicle),
      rules_(rules),
      startup_timeout_(startup_timeout),
      readiness_(vehicle, rules),
      middleware_(middleware_name(vehicle.value), rules.middleware_patience) {}

void LifeCycle::receive(const HlcPeers& peers) {
  readiness_.receive(peers);
  middleware_.receive(peers);
  is_lab_control_absent_ = peers.lab.lost.contains(kLabControlName);
  stop_request_readers_ = peers.stop_request_readers;
}

void LifeCycle::receive(const RunState& state, HlcActions& actions) {
  if (state.phase != RunPhase::kMinimalRiskStop || minimal_risk_stop_) return;
  minimal_risk_stop_ = true;
  actions.warn(std::string(kLabControlName) +
               " demands a minimal-risk stop: driving the plan in force to its end");
}

void LifeCycle::receive_list(Nanoseconds wall) {
  last_list_at_ = wall;
  list_notice_ = machine::WaitNotice{wall};
}

void LifeCycle::watch(Nanoseconds wall, bool has_started, HlcActions& actions) {
  if (!began_at_) {
    began_at_ = wall;
    list_notice_ = machine::WaitNotice{wall};
    peers_notice_ = rules_.waits_for_start ? machine::WaitNotice{wall, kReminderPause}
                                           : machine::WaitNotice{wall};
  }
  watch_lab_control(wall, actions);
  middleware_.look(wall, actions);
  update_readiness(wall, has_started, actions);
  remind(wall, actions);
}

void LifeCycle::update_readiness(Nanoseconds wall, bool has_started, HlcActions& actions) {
  if (readiness_.is_ready()) return;
  readiness_.update(has_started, wall - *began_at_);
  const std::set<std::string> absent = readiness_.absent_controllers();
  if (!rules_.waits_for_start || !readiness_.is_ready() || absent.empty()) return;
  actions.warn("absent: " + machine::joined(absent) +
               "; their vehicles may be driven by other software and are avoided");
}

void LifeCycle::watch_lab_control(Nanoseconds wall, HlcActions& actions) {
  if (rules_.asks_lab_control && lab_control_.request_is_due(wall)) {
    actions.add(ParameterRequest{.name = kPeriodParameter});
  }
  switch (lab_control_.look(is_lab_control_absent_, stop_request_readers_, wall)) {
    case machine::LabControlWatch::Change::kNone:
      return;
    case machine::LabControlWatch::Change::kLost:
      actions.error(std::string(kLabControlName) +
                    " lost; minimal-risk stop: driving the plan in force to its end" +
                    (rules_.stops_on_lab_domain ? std::string{}
                                                : "; no stop came through " + middleware_.name()));
      return;
    case machine::LabControlWatch::Change::kBack:
      actions.info(std::string(kLabControlName) + " is back; planning resumed");
      return;
  }
}

/// Missing lists are reported only where they come by the clock: in logical time they come as fast
/// as all processes are done.
void LifeCycle::remind(Nanoseconds wall, HlcActions& actions) {
  if (!readiness_.is_ready() && peers_notice_.is_due(wall)) {
    actions.info("waiting: " + readiness_.missing());
  }
  if (readiness_.is_ready() && rules_.logs_missing_lists && list_notice_.is_due(wall)) {
    const Nanoseconds silence = wall - last_list_at_ + kNanosecondsPerSecond / 2;
    actions.warn(fmt::format("waiting: no state list from {} for {} s", middleware_.name(),
                             silence / kNanosecondsPerSecond));
  }
}

/// Why the vehicle cannot start from where it is; empty: it can.
std::string_view LifeCycle::obstacle_to_start(const controller::Controller& controller) const {
  if (controller.placement()) {
    return controller.fits_route() ? "" : "the vehicle fits no route";
  }
  return rules_.start == StartRule::kAtTrigger ? "the vehicle has not been seen standing yet" : "";
}

/// @param missing  what the start waits for; empty: nothing
void LifeCycle::remind_of_start(Nanoseconds wall, std::string_view missing, HlcActions& actions) {
  if (!rules_.waits_for_start || rules_.start != StartRule::kAtTrigger) return;
  if (missing.empty()) {
    ready_.next_reminder = 0;
    return;
  }
  if (ready_.next_reminder != 0 && wall >= ready_.next_reminder) {
    actions.info(fmt::format("waiting: {}", missing));
    ready_.next_reminder = 0;
  }
  if (ready_.next_reminder == 0) ready_.next_reminder = wall + kReminderPause;
}

void LifeCycle::publish_ready(Nanoseconds wall, const controller::Controller& controller,
                              bool has_started, HlcActions& actions) {
  const bool is_open = readiness_.is_ready() && !has_started;
  const std::string_view obstacle = obstacle_to_start(controller);
  ready_.repeats = is_open && obstacle.empty();
  std::string_view missing = obstacle.empty() ? "no start trigger received" : obstacle;
  if (!is_open) missing = {};
  remind_of_start(wall, missing, actions);
  if (!ready_.repeats || wall < ready_.next_at) return;
  if (ready_.next_at == 0 && rules_.start == StartRule::kAtTrigger) {
    actions.info("ready; waiting for the start trigger");
  }
  actions.add(ReadyStatus{.source_id = controller_ready_id(vehicle_.value)});
  ready_.next_at = wall + kReadyRepeat;
}

std::optional<int> LifeCycle::exit_code(Nanoseconds wall, bool has_list,
                                        HlcActions& actions) const {
  if (middleware_.is_lost_for_good(wall) || (middleware_.is_lost() && minimal_risk_stop_)) {
    return readiness_.is_ready() ? kExitDied : kExitMissing;
  }
  if (readiness_.leaves_to_duplicate(wall - *began_at_)) {
    actions.error("another instance of " + controller_name(vehicle_.value) +
                  " is running; stop it first");
    return kExitBadInput;
  }
  if (lab_control_.is_lost_for_good(wall)) return kExitDied;
  if (!has_list && is_start_overdue(wall)) {
    actions.error(fmt::format("{} within {} s", readiness_.missing(),
                              startup_timeout_ / kNanosecondsPerSecond));
    return kExitMissing;
  }
  return std::nullopt;
}

std::optional<Nanoseconds> LifeCycle::wake_up() const {
  using machine::earlier;
  if (!began_at_) return std::nullopt;
  std::optional<Nanoseconds> wake = earlier(lab_control_.wake_up(), middleware_.wake_up());
  if (rules_.asks_lab_control) wake = earlier(wake, lab_control_.next_request());
  if (readiness_.yields_to_duplicate()) {
    wake = earlier(wake, *began_at_ + rules_.duplicate_patience + 1);
  }
  if (!readiness_.is_ready()) {
    wake = earlier(wake, peers_notice_.next());
    return rules_.waits_for_start ? wake : earlier(wake, *began_at_ + startup_timeout_ + 1);
  }
  if (ready_.next_reminder != 0) wake = earlier(wake, ready_.next_reminder);
  if (ready_.repeats) wake = earlier(wake, ready_.next_at);
  return rules_.logs_missing_lists ? earlier(wake, list_notice_.next()) : wake;
}

}  // namespace hlc::high_level_controller
