#pragma once

#include <algorithm>
#include <chrono>
#include <concepts>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hlc_bridge/machine/log_line.hpp"
#include "hlc_bridge/machine/machine.hpp"
#include "hlc_bridge/machine/pacing.hpp"
#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "hlc_bridge/time/signal.hpp"
#include "hlc_bridge/time/wall_time.hpp"

namespace hlc::process {

/// Runs the machine of a process: a mailbox into which any thread puts events, and the loop
///
///     on -> advance -> perform -> wait
///
/// on the one thread that calls `run`; only that thread accesses the machine. The process around it
/// (the host) has the endpoints, whose callbacks post events, and performs the machine's actions:
///
///     Shell<VehicleMachine> shell_;     // before the endpoints: their callbacks use it
///     Reader<Parameter> reader_{lab_, topics::parameter(),
///                               [this](const Parameter& parameter) { shell_.post(parameter); }};
///     void perform(const VehicleState& state) { state_writer_.write(state); }   // every Action
///     void perform(const machine::LogLine& line) { log(name_, line); }
///     void perform(const ReadyStatus& status);       // logical time, if the machine wants ticks
///     VehicleMachine::Event presence() const;        // a snapshot of the participants
///     int run() { return shell_.run(*this); }
///
/// The thread wakes up for an urgent event, a change of presence, a released tick, the machine's
/// wake-up, and when the number of events that the machine awaits has arrived or one has waited for
/// the pacing's mail delay. So it never waits without a reason given by the machine.
template <machine::Machine M>
class Shell {
 public:
  using Event = typename M::Event;

  /// @param node_id  source_id of the ready status
  Shell(std::string node_id, M machine, std::unique_ptr<machine::Pacing> pacing)
      : node_id_(std::move(node_id)), machine_(std::move(machine)), pacing_(std::move(pacing)) {}
  Shell(const Shell&) = delete;  // callbacks refer to it
  Shell& operator=(const Shell&) = delete;

  // From any thread; also before `run`. They wait only for the mailbox's lock.
  void post(Event event) {
    signal_.post([&] { mail_.push_back(std::move(event)); });
  }
  /// Wakes the machine at once, independent of what it awaits.
  void post_urgent(Event event) {
    signal_.post([&] {
      mail_.push_back(std::move(event));
      is_urgent_ = true;
    });
  }
  /// Participants or matches have changed: urgent. Presence comes before other events.
  void presence_changed() {
    signal_.post([this] { has_presence_changed_ = true; });
  }
  /// Every SystemTrigger of the lab control, for any time.
  void trigger(Nanoseconds next_start) {
    const Nanoseconds wall = time::wall_time_now();
    signal_.post([&] { pacing_->on_trigger(next_start, wall); });
  }
  void stop() { post_urgent(machine::StopSignal{}); }

  /// Runs until the machine ends. Returns its exit code; kExitDied if triggers stop arriving.
  template <class Host>
  [[nodiscard]] int run(Host& host) {
    while (true) {
      feed(host);
      const Instant clocks = clocks_now();
      const Instant now = signal_.locked([&] { return pacing_->now(clocks); });
      for (const auto& action : machine_.advance(now)) {
        std::visit([&](const auto& what) { host.perform(what); }, action);
      }
      if (const std::optional<int> code = machine_.exit_code()) return *code;
      const WakeUp wake = machine_.wake_up();
      signal_.locked([&] { pacing_->want(wake.run); });
      if (!announce(host)) return kExitDied;
      wait(wake.wall);
    }
  }

  /// For the thread of `run`.
  [[nodiscard]] const M& machine() const { return machine_; }

 private:
  [[nodiscard]] static Instant clocks_now() {
    return {.run = time::real_time_now(), .wall = time::wall_time_now()};
  }

  template <class Host>
  void feed(Host& host) {
    const bool has_presence_changed = signal_.locked([this] {
      std::swap(mail_, read_);
      is_urgent_ = false;
      return std::exchange(has_presence_changed_, false);
    });
    if (has_presence_changed) machine_.on(host.presence());
    for (Event& event : read_) machine_.on(std::move(event));
    read_.clear();
  }

  /// Logical time: announces the wanted tick. False if the lab control is not responding.
  template <class Host>
  [[nodiscard]] bool announce(Host& host) {
    if constexpr (requires { host.perform(ReadyStatus{}); }) {
      const Nanoseconds wall = time::wall_time_now();
      const auto [is_timed_out, tick] = signal_.locked([&] {
        return std::pair{pacing_->is_timed_out(wall), pacing_->announcement(wall)};
      });
      if (is_timed_out) {
        host.perform(machine::error(std::string(kLabControlName) +
                                    " is not responding: no triggers received"));
        return false;
      }
      if (tick) host.perform(ReadyStatus{.source_id = node_id_, .next_start = *tick});
    }
    return true;
  }

  void wait(std::optional<Nanoseconds> wake_wall) const {
    const Instant clocks = clocks_now();
    const auto [wake, delay] = signal_.locked([this] {
      return std::pair{pacing_->wake_up(), pacing_->mail_delay()};
    });
    const std::size_t enough = delay == 0 ? 1 : machine_.awaited();
    const auto has_work = [&] {
      return is_urgent_ || has_presence_changed_ || mail_.size() >= enough || pacing_->is_due();
    };
    Nanoseconds until = clocks.wall + (enough > 1 ? delay : kLongestWait);
    until = std::min({until, wake_wall.value_or(until), wake.wall.value_or(until)});
    if (wake.run && time_left(*wake.run, clocks.run) <= time_left(until, clocks.wall)) {
      static_cast<void>(signal_.wait_until(time::real_time_point(*wake.run), has_work));
    } else {
      static_cast<void>(signal_.wait_until(time::wall_time_point(until), has_work));
    }
  }

  [[nodiscard]] static Nanoseconds time_left(Nanoseconds until, Nanoseconds now) {
    return until - std::min(until, now);
  }

  /// Only a bound for an interruptible wait.
  static constexpr Nanoseconds kLongestWait = 3600 * kNanosecondsPerSecond;

  std::string node_id_;
  M machine_;
  std::vector<Event> read_;  ///< keeps its memory

  time::Signal signal_;  // guards the members below
  std::unique_ptr<machine::Pacing> pacing_;
  std::vector<Event> mail_;
  bool is_urgent_{};
  bool has_presence_changed_{true};
};

}  // namespace hlc::process
