#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "hlc_bridge/machine/loop.hpp"
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
  /// @param is_seen  the controller sees its vehicle in this step
  virtual void on_traffic(const coordination::Traffic& traffic, bool is_seen) = 0;
  /// The plan of a step; the report shows whether it came into force.
  virtual void on_prediction(const coordination::Prediction& prediction) = 0;
  /// @param in_force  the plan after the step; nullptr: none
  virtual void on_report(const ReportRecord& record, const coordination::Plan* in_force) = 0;
  virtual void on_command(const TrajectoryCommand& command) = 0;
  /// By a vehicle.
  virtual void on_received(const TrajectoryCommand& command) = 0;
  virtual void on_stop_symbol(std::uint8_t vehicle) = 0;
  /// Of the lab control, for the operator.
  virtual void on_progress(const std::string& /*text*/) {}
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

/// A process of a run: one machine, with the loop of every process (hlc_bridge/machine/loop.hpp).
/// Instead of waiting it returns the time of its next iteration.
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
  virtual void iterate() = 0;
  /// True time of the next iteration without new messages; at or before now: work is pending.
  [[nodiscard]] virtual Nanoseconds next_iteration() const = 0;
  [[nodiscard]] virtual std::optional<int> exit_code() const = 0;
};

inline constexpr Nanoseconds kNever = std::numeric_limits<Nanoseconds>::max();

/// @tparam Host  the host of the machine's loop, and in addition: its type `Machine`; description()
///     of its topics; receive(topic, message, process)
template <class Host>
class MachineProcess final : public SimulatedProcess {
 public:
  using M = typename Host::Machine;
  using Event = typename M::Event;

  MachineProcess(ProcessPlace place, Host host, M machine, Nanoseconds startup_timeout)
      : place_(place),
        host_(std::move(host)),
        loop_(place.network->name(place.node), std::move(machine),
              machine::run_time(place.is_logical).make_pacing(startup_timeout, clocks().wall)) {
    host_.attach(place_, loop_.machine());
  }

  // For the host.
  void post(Event event) { loop_.post(std::move(event)); }
  void post_urgent(Event event) { loop_.post_urgent(std::move(event)); }
  void trigger(Nanoseconds next_start) { loop_.trigger(next_start, clocks().wall); }

  void receive(std::size_t topic, const Message& message) override {
    host_.receive(topic, message, *this);
  }
  void presence_changed() override { loop_.presence_changed(); }
  void stop() override { loop_.post_urgent(machine::StopSignal{}); }

  void iterate() override {
    if (exit_code_) return;
    exit_code_ = loop_.iterate(
        host_, [this] { return clocks(); }, [](const auto& access) { return access(); });
    if constexpr (requires { host_.take_change_of_endpoints(); }) {
      if (host_.take_change_of_endpoints()) loop_.presence_changed();
    }
    if constexpr (requires { host_.log_end(); }) {
      if (exit_code_) host_.log_end();
    }
    clocks_changed();
  }

  void clocks_changed() override {
    if (exit_code_) return;
    const Nanoseconds now = *place_.now;
    const WakeUp wake = loop_.wake_up();
    const auto when = [now](const SimulatedClock& clock, std::optional<Nanoseconds> local) {
      return local ? clock.when(*local, now) : kNever;
    };
    wake_at_ = std::min(when(*place_.wall_clock, wake.wall), when(*place_.run_clock, wake.run));
    read_mail_at_ = now + loop_.mail_delay().value_or(0);
  }

  [[nodiscard]] Nanoseconds next_iteration() const override {
    if (exit_code_) return kNever;
    if (loop_.has_work()) return *place_.now;
    return loop_.has_mail() ? std::min(wake_at_, read_mail_at_) : wake_at_;
  }
  [[nodiscard]] std::optional<int> exit_code() const override { return exit_code_; }

 private:
  [[nodiscard]] Instant clocks() const {
    return {.run = place_.run_clock->at(*place_.now), .wall = place_.wall_clock->at(*place_.now)};
  }

  ProcessPlace place_;
  Host host_;
  machine::Loop<M> loop_;
  Nanoseconds wake_at_{};  ///< true time; 0: at once
  Nanoseconds read_mail_at_{};
  std::optional<int> exit_code_;
};

}  // namespace hlc::closed_loop
