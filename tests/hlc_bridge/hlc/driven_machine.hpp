#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hlc_bridge/hlc/hlc_machine.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "tests/planner/controller/east_bound.hpp"

/// The machine of a controller in memory, on clocks that the test moves. Cars shall drive east.
namespace hlc::high_level_controller::driven_machine {

inline constexpr Nanoseconds kPeriod = kNanosecondsPerSecond / 5;
inline constexpr Nanoseconds kSecond = kNanosecondsPerSecond;
inline constexpr Nanoseconds kMillisecond = kNanosecondsPerMillisecond;
inline constexpr std::uint64_t kFirstStep = 1000;  ///< in real time; logical time begins at 0

inline HlcRules real_time() { return rules_in_real_time(false, {}, 30 * kSecond); }
inline HlcRules logical_time() { return rules_in_logical_time(false); }
inline HlcRules logical_time_in_the_lab() { return rules_in_logical_time(true); }
/// The lab's middleware keeps one command.
inline HlcRules real_time_in_the_lab() { return rules_in_real_time(true, {}, 30 * kSecond); }

/// Middleware, lab control and these vehicles' controllers are there and receive everything.
inline HlcPeers peers(const std::set<std::uint8_t>& others = {}) {
  HlcPeers peers;
  for (const std::uint8_t vehicle : others) peers.receivers.insert(controller_name(vehicle));
  peers.lab.alive = peers.receivers;
  peers.lab.alive.insert(kLabControlName);
  peers.controllers.alive = peers.lab.alive;
  peers.command_readers = peers.stop_request_readers = 1;
  return peers;
}

/// The list of a step, in which these vehicles take part.
inline VehicleStateList list_of(std::uint64_t step,
                                const std::vector<coordination::MeasuredVehicle>& vehicles) {
  VehicleStateList list{.t_now = step * kPeriod + kListOffset, .period_ms = 200};
  for (const coordination::MeasuredVehicle& one : vehicles) {
    list.active_vehicle_ids.push_back(one.vehicle.value);
    list.states.push_back({.vehicle_id = one.vehicle.value,
                           .create_stamp = list.t_now - 60 * kMillisecond,
                           .valid_after_stamp = list.t_now,
                           .pose = one.pose,
                           .speed_mps = one.speed_mps});
  }
  return list;
}

class DrivenMachine {
 public:
  explicit DrivenMachine(const HlcRules& rules, std::uint8_t vehicle = 1, double y_m = 0.0,
                         policy::ReconfigurationSettings reconfiguration = {})
      : DrivenMachine(rules, controller::east_bound::controller(vehicle, y_m),
                      std::move(reconfiguration)) {}
  DrivenMachine(const HlcRules& rules, std::unique_ptr<controller::Controller> controller,
                policy::ReconfigurationSettings reconfiguration = {})
      : machine_({.rules = rules, .reconfiguration = std::move(reconfiguration)},
                 std::move(controller)),
        rules_(rules),
        step_(rules.start == StartRule::kTogether ? 0 : kFirstStep) {
    now_.run = step_ * kPeriod;
    // A controller requests no ticks, so none is ever released to it.
    now_.has_begun = rules.start != StartRule::kTogether;
  }

  [[nodiscard]] const HlcMachine& machine() const { return machine_; }
  [[nodiscard]] const HlcRules& rules() const { return rules_; }
  [[nodiscard]] std::optional<int> exit_code() const { return machine_.exit_code(); }
  [[nodiscard]] const Instant& now() const { return now_; }

  /// What comes from outside, and all that is done then without time passing.
  void on(HlcEvent event) {
    feed(std::move(event));
    advance_until_idle();
  }
  /// ... while the thread is not running.
  void feed(HlcEvent event) { machine_.on(std::move(event)); }
  void delay(Nanoseconds duration) { move_clocks(duration); }

  /// The machine is to be advanced at this instant.
  [[nodiscard]] bool is_due() const { return time_to_wake_up() == Nanoseconds{0}; }
  /// One call of advance: returns the actions to execute.
  std::vector<HlcAction> advance() {
    std::vector<HlcAction> actions = machine_.advance(now_);
    done_.insert(done_.end(), actions.begin(), actions.end());
    return actions;
  }

  /// As the shell: advances until the machine has nothing more to do at this instant.
  void advance_until_idle() {
    for (int i = 0; i < 100 && !exit_code(); ++i) {
      static_cast<void>(advance());
      if (!is_due()) return;
    }
    if (!exit_code()) ADD_FAILURE() << "the machine asks to be advanced without end";
  }

  /// Time passes; the machine is advanced when it asks for it.
  void pass(Nanoseconds duration) {
    const Nanoseconds until = now_.wall + duration;
    advance_until_idle();
    while (!exit_code()) {
      const std::optional<Nanoseconds> wait = time_to_wake_up();
      if (!wait || now_.wall + *wait > until) break;
      move_clocks(*wait);
      advance_until_idle();
    }
    move_clocks(until - now_.wall);
  }

  /// Until the next step begins; its list.
  VehicleStateList wait_for_list(const std::vector<coordination::MeasuredVehicle>& vehicles) {
    step_ = std::max(step_ + 1, (now_.run + kPeriod - 1) / kPeriod);
    VehicleStateList list = list_of(step_, vehicles);
    pass(list.t_now - now_.run);
    return list;
  }
  /// ... and it comes.
  void next_list(const std::vector<coordination::MeasuredVehicle>& vehicles) {
    on(wait_for_list(vehicles));
  }
  [[nodiscard]] std::uint64_t step() const { return step_; }

  /// Actions of a kind since this was asked last.
  template <class Action>
  std::vector<Action> take() {
    std::vector<Action> result;
    std::erase_if(done_, [&](const HlcAction& action) {
      if (const Action* one = std::get_if<Action>(&action)) result.push_back(*one);
      return std::holds_alternative<Action>(action);
    });
    return result;
  }
  /// All of them, in order.
  std::vector<HlcAction> take_all() { return std::exchange(done_, {}); }
  void forget() { done_.clear(); }

  [[nodiscard]] bool has_logged(const std::string& text) const {
    return std::ranges::any_of(done_, [&](const HlcAction& action) {
      const auto* line = std::get_if<machine::LogLine>(&action);
      return line != nullptr && line->text.find(text) != std::string::npos;
    });
  }

 private:
  /// None: only when something comes.
  [[nodiscard]] std::optional<Nanoseconds> time_to_wake_up() const {
    const auto from = [](std::optional<Nanoseconds> wake, Nanoseconds now) {
      return wake ? std::optional{*wake - std::min(*wake, now)} : std::nullopt;
    };
    const WakeUp wake = machine_.wake_up();
    return machine::earlier(from(wake.run, now_.run), from(wake.wall, now_.wall));
  }
  void move_clocks(Nanoseconds by) {
    now_.run += by;
    now_.wall += by;
  }

  HlcMachine machine_;
  HlcRules rules_;
  Instant now_{.run = 0, .wall = 50 * kSecond};
  std::uint64_t step_;
  std::vector<HlcAction> done_;
};

/// Car 1, alone by default, stands at its start.
inline const std::vector<coordination::MeasuredVehicle>& standing() {
  static const std::vector<coordination::MeasuredVehicle> one{
      controller::east_bound::seen(1, 0.0, 0.0)};
  return one;
}

/// Until the car has stood for so long that it may drive off (real time), or that its states may
/// be trusted with the next list (logical time), and the controller is ready.
inline void stand(DrivenMachine& one,
                  const std::vector<coordination::MeasuredVehicle>& vehicles = standing()) {
  const int lists = one.rules().start == StartRule::kTogether ? 5 : 9;
  for (int i = 0; i < lists; ++i) one.next_list(vehicles);
}

/// ... and drives from the next list on.
inline void start(DrivenMachine& one,
                  const std::vector<coordination::MeasuredVehicle>& vehicles = standing()) {
  stand(one, vehicles);
  one.pass(CommandCopies::kPause);
  one.on(SystemTrigger{.next_start = one.now().run});
  one.forget();
}

/// Of the reports since they were taken last.
inline coordination::StepStatus last_status(DrivenMachine& one) {
  const std::vector<ReportRecord> records = one.take<ReportRecord>();
  EXPECT_FALSE(records.empty());
  return records.empty() ? coordination::StepStatus::kStandby : records.back().report.status;
}

}  // namespace hlc::high_level_controller::driven_machine
