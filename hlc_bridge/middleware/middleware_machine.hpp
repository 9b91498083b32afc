#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hlc_bridge/machine/lab_control_watch.hpp"
#include "hlc_bridge/machine/stamp_check.hpp"
#include "hlc_bridge/machine/start_up.hpp"
#include "hlc_bridge/machine/ticks.hpp"
#include "hlc_bridge/middleware/command_forwarder.hpp"
#include "hlc_bridge/middleware/due_messages.hpp"
#include "hlc_bridge/middleware/experiment_cycle.hpp"
#include "hlc_bridge/middleware/list_composer.hpp"
#include "hlc_bridge/middleware/middleware_messages.hpp"
#include "hlc_bridge/middleware/middleware_settings.hpp"

namespace hlc::middleware {

/// Connects controllers and vehicles (run as described in machine/machine.hpp).
///
/// Every period, at t_now = k P + offset, it publishes a VehicleStateList with the newest valid
/// state of every active vehicle. Commands of a controller are forwarded to its vehicle on arrival,
/// after a check (CommandForwarder); triggers of the lab control are forwarded to the controllers,
/// the stop symbol before the process ends.
///
///     starting ──parameters, connected──► idle ──tick──► states ──► list, answers ──► idle
///        │ timeout: 3, parameters: 2       │ stop symbol, StopSignal: 0
///        ▼                                 ▼ lab control lost: 4
///     finished ◄──controllers gone, or kLeaveTime── leaving
///
/// The first tick with patience waits for the controllers, if they were not awaited before. A tick
/// with patience waits, before the list, for the state of every active vehicle that must be
/// in it, and, after the list, for every controller's answer: only then the next tick is requested.
/// Lost peers are not awaited, nor peers that have been silent for the patience, until their next
/// message. Without patience lists are published from the first period on, whatever the presence;
/// answers that did not arrive within the period are counted.
///
/// Messages of vehicles and controllers whose stamp is not plausible (StampCheck) are dropped, and
/// counted in the log at the end: they would displace all later ones in the lists, or count as the
/// answer to all later lists.
///
/// Controllers receive the stop symbol kLeaveTime before their middleware leaves, or leave earlier,
/// so that they do not take it for lost.
class MiddlewareMachine {
 public:
  using Event = MiddlewareEvent;
  using Action = MiddlewareAction;

  static constexpr Nanoseconds kLeaveTime = 500 * kNanosecondsPerMillisecond;

  explicit MiddlewareMachine(MiddlewareSettings settings);

  void on(Event event) { inbox_.events.push_back(std::move(event)); }
  [[nodiscard]] std::vector<Action> advance(const Instant& now);
  [[nodiscard]] WakeUp wake_up() const;
  [[nodiscard]] std::size_t awaited() const;
  /// 0 success, 2 the lab control's parameters do not fit, 3 a required participant did not appear,
  /// 4 the lab control is lost.
  [[nodiscard]] std::optional<int> exit_code() const;

 private:
  enum class Phase : std::uint8_t { kStarting, kIdle, kStates, kAnswers, kLeaving, kFinished };
  struct Inbox {
    std::vector<Event> events;  ///< since the last advance
    machine::StampCheck stamp_check;
  };
  struct Ending {
    bool is_asked{};  ///< StopSignal
    int exit_code{};
    Nanoseconds until{};  ///< wall time, kLeaving
  };

  void take(machine::StopSignal /*signal*/, const Instant& /*now*/) { ending_.is_asked = true; }
  void take(MiddlewarePeers& peers, const Instant& now);
  void take(const Parameter& parameter, const Instant& now);
  void take(const SystemTrigger& trigger, const Instant& now);
  void take(GoalState& goal, const Instant& now);
  void take(const PublishedState& published, const Instant& now);
  void take(const PublishedObservation& published, const Instant& now);
  void take(const ReadyStatus& status, const Instant& now);
  void take(VehicleCommand& command, const Instant& now);
  [[nodiscard]] bool is_plausible(const machine::StampedMessage& message, const Instant& now);

  void start(const Instant& now);
  [[nodiscard]] std::string missing_peers() const;
  void look_for_end(const Instant& now);
  void leave(int exit_code, const Instant& now);

  void tick(const Instant& now);
  void begin_tick(Nanoseconds t_now, const Instant& now);
  void publish_list(const Instant& now);
  [[nodiscard]] bool waits() const { return settings_.rules.pacing.patience > 0; }
  [[nodiscard]] bool awaits_controllers(const Instant& now);
  [[nodiscard]] bool states_are_in(const Instant& now);
  [[nodiscard]] bool answers_are_in(const Instant& now);

  MiddlewareSettings settings_;
  Inbox inbox_;
  std::vector<Action> actions_;
  Phase phase_{Phase::kStarting};
  MiddlewarePeers peers_;
  machine::StartUp start_up_;
  std::optional<machine::Ticks> ticks_;
  Nanoseconds t_now_{};  ///< of the current tick
  ListComposer lists_;
  DueMessages due_states_;
  DueMessages due_answers_;
  CommandForwarder forwarder_;
  ExperimentCycle cycle_;
  machine::LabControlGrace grace_;
  Ending ending_;
};

}  // namespace hlc::middleware
