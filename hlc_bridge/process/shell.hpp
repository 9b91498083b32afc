#pragma once

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "hlc_bridge/machine/loop.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "hlc_bridge/time/signal.hpp"
#include "hlc_bridge/time/wall_time.hpp"

namespace hlc::process {

/// Runs the machine of a process: a mailbox into which any thread puts events, and the loop
///
///     on -> advance -> perform -> wait        (machine/loop.hpp)
///
/// on the one thread that calls `run`. The process around it is the loop's host; its endpoints'
/// callbacks post events:
///
///     Shell<VehicleMachine> shell_;     // before the endpoints: their callbacks use it
///     Reader<Parameter> reader_{lab_, topics::parameter(),
///                               [this](const Parameter& parameter) { shell_.post(parameter); }};
///     void perform(const VehicleState& state) { state_writer_.write(state); }   // every Action
///     void perform(const machine::LogLine& line) { log(name_, line); }
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
      : loop_(std::move(node_id), std::move(machine), std::move(pacing)) {}
  Shell(const Shell&) = delete;  // callbacks refer to it
  Shell& operator=(const Shell&) = delete;

  // From any thread; also before `run`. They wait only for the mailbox's lock.
  void post(Event event) {
    signal_.post([&] { loop_.post(std::move(event)); });
  }
  /// ParticipantOptions::admits: messages that are not admitted are not posted.
  [[nodiscard]] bool admits(const machine::MailBudget::Publisher& publisher, std::size_t bytes) {
    return signal_.locked([&] { return loop_.admits(publisher, bytes); });
  }
  /// Wakes the machine at once, independent of what it awaits.
  void post_urgent(Event event) {
    signal_.post([&] { loop_.post_urgent(std::move(event)); });
  }
  /// Participants or matches have changed: urgent. Presence comes before other events.
  void presence_changed() {
    signal_.post([this] { loop_.presence_changed(); });
  }
  /// Every SystemTrigger of the lab control, for any time.
  void trigger(Nanoseconds next_start) {
    const Nanoseconds wall = time::wall_time_now();
    signal_.post([&] { loop_.trigger(next_start, wall); });
  }
  void stop() { post_urgent(machine::StopSignal{}); }

  /// Runs until the machine ends. Returns its exit code; kExitDied if triggers stop arriving.
  template <class Host>
  [[nodiscard]] int run(Host& host) {
    const auto locked = [this](const auto& access) { return signal_.locked(access); };
    while (true) {
      if (const std::optional<int> code = loop_.iterate(host, clocks_now, locked)) return *code;
      watch_system_clock(host);
      wait();
    }
  }

  /// For the thread of `run`.
  [[nodiscard]] const M& machine() const { return loop_.machine(); }

 private:
  [[nodiscard]] static Instant clocks_now() {
    const time::SteadyRealTime& real_time = time::steady_real_time();
    const Nanoseconds wall = time::wall_time_now();
    return {.run = real_time.at(wall), .wall = wall};
  }

  template <class Host>
  void watch_system_clock(Host& host) {
    const auto step = system_clock_.new_step(time::steady_real_time().system_step());
    if (!step) return;
    loop_.log(host, machine::warning("the system's clock was set " +
                                     std::string(*step < 0 ? "back" : "forth") + " by " +
                                     std::to_string(std::abs(*step) / 1'000'000) +
                                     " ms; this process goes on by its own"));
  }

  void wait() const {
    const Instant clocks = clocks_now();
    const auto [wake, delay] = signal_.locked([this] {
      return std::pair{loop_.wake_up(), loop_.mail_delay()};
    });
    const auto has_work = [this] { return loop_.has_work(); };
    Nanoseconds until = clocks.wall + delay.value_or(kLongestWait);
    until = std::min(until, wake.wall.value_or(until));
    if (wake.run) until = std::min(until, clocks.wall + time_left(*wake.run, clocks.run));
    static_cast<void>(signal_.wait_until(time::wall_time_point(until), has_work));
  }

  [[nodiscard]] static Nanoseconds time_left(Nanoseconds until, Nanoseconds now) {
    return until - std::min(until, now);
  }

  /// Only a bound for an interruptible wait.
  static constexpr Nanoseconds kLongestWait = 3600 * kNanosecondsPerSecond;

  time::SystemClockWatch system_clock_;
  time::Signal signal_;  ///< its lock guards the loop's mailbox
  machine::Loop<M> loop_;
};

}  // namespace hlc::process
