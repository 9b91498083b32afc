#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hlc_bridge/machine/log_line.hpp"
#include "hlc_bridge/machine/machine.hpp"
#include "hlc_bridge/machine/mail_budget.hpp"
#include "hlc_bridge/machine/pacing.hpp"
#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::machine {

/// The loop of every process around its machine, without clock, lock and waiting:
///
///     on -> advance -> perform        (`iterate`)
///
/// and until the next iteration the owner waits for `has_work`, at most until `wake_up`. Owners:
/// Shell (process/shell.hpp) waits on a thread, SimulatedProcess (vehicle_sim/closed_loop) in
/// simulated time.
///
/// The host has the endpoints and performs the actions:
///
///     void perform(const Action& action);            // one for each type of the machine's actions
///     Event presence() const;                        // a snapshot of the participants
///     void announce_tick(const ReadyStatus& status); // if the machine wants ticks in logical time
///
/// Where several threads post events, all calls but `iterate` and `machine` are made under the
/// owner's lock. `iterate` is called by one thread, which alone accesses the machine.
template <Machine M>
class Loop {
 public:
  using Event = typename M::Event;

  /// @param node_id  source_id of the ready status
  Loop(std::string node_id, M machine, std::unique_ptr<Pacing> pacing)
      : node_id_(std::move(node_id)), machine_(std::move(machine)), pacing_(std::move(pacing)) {}

  void post(Event event) { mail_.push_back(std::move(event)); }
  /// Before a message of another process is posted. False: too many of this publisher already wait.
  [[nodiscard]] bool admits(const MailBudget::Publisher& publisher, std::size_t bytes) {
    return budget_.admits(publisher, bytes);
  }
  /// Work, independent of what the machine awaits.
  void post_urgent(Event event) {
    post(std::move(event));
    is_urgent_ = true;
  }
  /// Participants or matches have changed: urgent. Presence comes before other events.
  void presence_changed() { has_presence_changed_ = true; }
  /// Every SystemTrigger of the lab control, for any time.
  void trigger(Nanoseconds next_start, Nanoseconds wall) { pacing_->on_trigger(next_start, wall); }

  /// There is something to do before `wake_up`.
  [[nodiscard]] bool has_work() const {
    return is_urgent_ || has_presence_changed_ || mail_.size() >= enough_ || pacing_->is_due();
  }
  [[nodiscard]] bool has_mail() const { return !mail_.empty(); }
  /// By the clocks.
  [[nodiscard]] WakeUp wake_up() const {
    const WakeUp pacing = pacing_->wake_up();
    return {.run = pacing.run, .wall = earlier(wake_wall_, pacing.wall)};
  }
  /// How long mail may wait until there is work; empty: any mail is work.
  [[nodiscard]] std::optional<Nanoseconds> mail_delay() const {
    return enough_ > 1 ? std::optional(pacing_->mail_delay()) : std::nullopt;
  }

  /// Once through the loop. Returns the exit code when the machine has ended; kExitDied if triggers
  /// stop arriving.
  /// @param clocks  () -> Instant, their values, `run` being CLOCK_REALTIME
  /// @param locked  calls its argument under the owner's lock and returns its result
  template <class Host, class Clocks, class Locked>
  [[nodiscard]] std::optional<int> iterate(Host& host, const Clocks& clocks, const Locked& locked) {
    const bool has_presence_changed = locked([this] {
      std::swap(mail_, read_);
      budget_.reset();
      is_urgent_ = false;
      return std::exchange(has_presence_changed_, false);
    });
    if (has_presence_changed) machine_.on(host.presence());
    for (Event& event : read_) machine_.on(std::move(event));
    read_.clear();
    const Instant shown = clocks();
    const Instant now = locked([&] { return pacing_->now(shown); });
    for (const auto& action : machine_.advance(now)) {
      std::visit([&](const auto& what) { host.perform(what); }, action);
    }
    if (const std::optional<int> code = machine_.exit_code()) return code;
    const WakeUp wake = machine_.wake_up();
    const std::size_t awaited = machine_.awaited();
    locked([&] {
      wake_wall_ = wake.wall;
      enough_ = pacing_->mail_delay() == 0 ? 1 : awaited;
      pacing_->want(wake.run);
    });
    return announce(host, clocks().wall, locked);
  }

  [[nodiscard]] const M& machine() const { return machine_; }

  /// A line of the owner's. For the thread of `iterate`.
  template <class Host>
  void log(Host& host, const LogLine& line) const {
    host.perform(line);
  }

 private:
  /// Logical time: announces the wanted tick, unless the lab control is not responding.
  template <class Host, class Locked>
  [[nodiscard]] std::optional<int> announce(Host& host, Nanoseconds wall, const Locked& locked) {
    if constexpr (requires { host.announce_tick(ReadyStatus{}); }) {
      const auto [is_timed_out, tick] = locked([&] {
        return std::pair{pacing_->is_timed_out(wall), pacing_->announcement(wall)};
      });
      if (is_timed_out) {
        host.perform(
            error(std::string(kLabControlName) + " is not responding: no triggers received"));
        return kExitDied;
      }
      if (tick) host.announce_tick({.source_id = node_id_, .next_start = *tick});
    }
    return std::nullopt;
  }

  std::string node_id_;
  M machine_;
  std::vector<Event> read_;  ///< keeps its memory
  // Under the owner's lock:
  std::unique_ptr<Pacing> pacing_;
  std::vector<Event> mail_;
  MailBudget budget_;
  bool is_urgent_{};
  bool has_presence_changed_{true};
  std::size_t enough_{1};  ///< events that are work
  std::optional<Nanoseconds> wake_wall_;
};

}  // namespace hlc::machine
