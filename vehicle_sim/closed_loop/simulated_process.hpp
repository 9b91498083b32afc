#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/machine/log_line.hpp"
#include "hlc_bridge/machine/machine.hpp"
#include "hlc_bridge/machine/pacing.hpp"
#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/run_messages.hpp"
#include "hlc_bridge/result/run_record.hpp"
#include "planner/coordination/plan.hpp"
#include "vehicle_sim/closed_loop/simulated_clock.hpp"
#include "vehicle_sim/closed_loop/simulated_network.hpp"

namespace hlc::closed_loop {

/// Observer of the processes of a run.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  virtual void on_log(NodeId node, const machine::LogLine& line) = 0;
  /// @param time  of the sample, true in real time, of the run in logical time
  virtual void on_driven(std::uint8_t vehicle, Nanoseconds time,
                         const result::DrivenSample& sample) = 0;
  virtual void on_traffic(const coordination::Traffic& traffic) = 0;
  /// The plan of a step; the report shows whether it came into force.
  virtual void on_prediction(const coordination::Prediction& prediction) = 0;
  /// @param in_force  the plan after the step; nullptr: none
  virtual void on_report(const ReportRecord& record, const coordination::Plan* in_force) = 0;
  virtual void on_command(const TrajectoryCommand& command) = 0;
  /// By a vehicle.
  virtual void on_received(const TrajectoryCommand& command) = 0;
  virtual void on_stop_symbol(std::uint8_t vehicle) = 0;
};

/// The environment of a process.
struct ProcessPlace {
  NodeId node{};
  SimulatedNetwork* network{};
  RunObserver* observer{};
  const SimulatedClock* run_clock{};   ///< CLOCK_REALTIME
  const SimulatedClock* wall_clock{};  ///< CLOCK_MONOTONIC
  const Nanoseconds* now{};            ///< true time
  bool is_logical{};
};

/// A process of a run: one machine, with the loop of the shell (hlc_bridge/process/shell.hpp), but
/// without waiting: it returns the time of its next turn.
class SimulatedProcess {
 public:
  virtual ~SimulatedProcess() = default;
  virtual void receive(std::size_t topic, const Message& message) = 0;
  virtual void presence_changed() = 0;
  /// SIGTERM.
  virtual void stop() = 0;
  /// Its clocks have been set.
  virtual void clocks_changed() = 0;
  /// Once through the loop.
  virtual void turn() = 0;
  /// True time of the next turn without new messages; at or before now: work is pending.
  [[nodiscard]] virtual Nanoseconds next_turn() const = 0;
  [[nodiscard]] virtual std::optional<int> exit_code() const = 0;
};

inline constexpr Nanoseconds kNoTurn = std::numeric_limits<Nanoseconds>::max();

/// @tparam Host  the endpoints of the machine: its type `Machine`; description() of its topics;
///     receive(topic, message, process); presence(); perform(action) for every action;
///     perform(ReadyStatus) if the machine wants ticks in logical time
template <class Host>
class MachineProcess final : public SimulatedProcess {
 public:
  using M = typename Host::Machine;
  using Event = typename M::Event;

  MachineProcess(ProcessPlace place, Host host, M machine, Nanoseconds startup_timeout)
      : place_(place),
        host_(std::move(host)),
        machine_(std::move(machine)),
        pacing_(machine::run_time(place.is_logical).make_pacing(startup_timeout, wall())) {
    host_.attach(place_, machine_);
  }

  // For the host.
  void post(Event event) { mail_.push_back(std::move(event)); }
  void post_urgent(Event event) {
    mail_.push_back(std::move(event));
    is_urgent_ = true;
  }
  void trigger(Nanoseconds next_start) { pacing_->on_trigger(next_start, wall()); }

  void receive(std::size_t topic, const Message& message) override {
    host_.receive(topic, message, *this);
  }
  void presence_changed() override { has_presence_changed_ = true; }
  void stop() override { post_urgent(machine::StopSignal{}); }

  void turn() override {
    if (exit_code_) return;
    if (std::exchange(has_presence_changed_, false)) machine_.on(host_.presence());
    is_urgent_ = false;
    std::swap(mail_, read_);
    for (Event& event : read_) machine_.on(std::move(event));
    read_.clear();
    const Instant clocks{.run = place_.run_clock->at(*place_.now), .wall = wall()};
    for (const auto& action : machine_.advance(pacing_->now(clocks))) {
      std::visit([&](const auto& what) { host_.perform(what); }, action);
    }
    if constexpr (requires { host_.take_change_of_endpoints(); }) {
      has_presence_changed_ |= host_.take_change_of_endpoints();
    }
    exit_code_ = machine_.exit_code();
    if constexpr (requires { host_.log_end(); }) {
      if (exit_code_) host_.log_end();
    }
    if (exit_code_) return;
    wake_ = machine_.wake_up();
    pacing_->want(wake_.run);
    announce(clocks.wall);
    clocks_changed();
  }

  void clocks_changed() override {
    if (exit_code_) return;
    const Nanoseconds now = *place_.now;
    const Nanoseconds delay = pacing_->mail_delay();
    enough_ = delay == 0 ? 1 : machine_.awaited();
    wake_at_ = kNoTurn;
    const auto wake_by = [&](const SimulatedClock& clock, std::optional<Nanoseconds> local) {
      if (local) wake_at_ = std::min(wake_at_, clock.when(*local, now));
    };
    const WakeUp pacing = pacing_->wake_up();
    wake_by(*place_.wall_clock, wake_.wall);
    wake_by(*place_.wall_clock, pacing.wall);
    wake_by(*place_.run_clock, pacing.run);
    if (enough_ > 1) read_mail_at_ = now + delay;
  }

  [[nodiscard]] Nanoseconds next_turn() const override {
    if (exit_code_) return kNoTurn;
    if (is_urgent_ || has_presence_changed_ || mail_.size() >= enough_ || pacing_->is_due()) {
      return *place_.now;
    }
    if (enough_ > 1 && !mail_.empty()) return std::min(wake_at_, read_mail_at_);
    return wake_at_;
  }
  [[nodiscard]] std::optional<int> exit_code() const override { return exit_code_; }

 private:
  [[nodiscard]] Nanoseconds wall() const { return place_.wall_clock->at(*place_.now); }

  void announce(Nanoseconds wall) {
    if constexpr (requires { host_.perform(ReadyStatus{}); }) {
      if (pacing_->is_timed_out(wall)) {
        host_.perform(machine::error(std::string(kLabControlName) +
                                     " is not responding: no triggers received"));
        exit_code_ = kExitDied;
      } else if (const auto tick = pacing_->announcement(wall)) {
        host_.perform(ReadyStatus{.source_id = host_.name(), .next_start = *tick});
      }
    }
  }

  ProcessPlace place_;
  Host host_;
  M machine_;
  std::unique_ptr<machine::Pacing> pacing_;
  std::vector<Event> mail_;
  std::vector<Event> read_;
  bool is_urgent_{};
  bool has_presence_changed_{true};
  std::size_t enough_{1};
  WakeUp wake_;
  Nanoseconds wake_at_{};  ///< true time; 0: at once
  Nanoseconds read_mail_at_{};
  std::optional<int> exit_code_;
};

}  // namespace hlc::closed_loop
