#pragma once

#include <cstdint>
#include <optional>

#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::high_level_controller {

/// When the phases of a step end in real time, as shares of the time from the list to the step's
/// end (deadline_in_step).
struct StepDeadlines {
  double traffic{0.20};
  double predecessors{0.55};
  double commit{0.75};
  double command{0.90};     ///< later than this the plan in force stays, and the miss is counted
  double look_ahead{0.50};  ///< later than this policies do not look ahead in this step
};

/// How a controller enters the experiment. Until then the vehicle is planned to stand only where
/// that is safe (HlcCore::may_stand_by).
enum class StartRule : std::uint8_t {
  /// All controllers derive the first step from the same lists: the first list is answered only
  /// when all of them are matched (HlcRules::waits_for_start: or absent for longer than the
  /// patience), and every list from then on. In logical time no message is lost, so a vehicle that
  /// is not seen drives its plan; one that is elsewhere is sent a command without points.
  kTogether,
  /// From the start trigger's time on, or later by joining the running experiment. Before that time
  /// nothing is sent to the vehicle, nor ever to one that fits no route, or stands where no way
  /// leads onto it, is not seen, or is elsewhere (rules 5 and 6 of plan_in_force.hpp).
  kAtTrigger,
};

/// When the copy of a command (command.hpp) is published.
enum class CommandCopy : std::uint8_t {
  kAtOnce,      ///< with the command
  kAfterPause,  ///< later (CommandCopies::kPause): the reader of the lab's middleware keeps one
  kNever,
};

/// Differences between logical and real time for the processes of a run. In logical time the lab
/// control waits for every process, so none can be late, and a step ends when all live controllers
/// have answered. In real time every step ends by its deadlines.
struct HlcRules {
  StartRule start{};
  /// None: a phase ends after kMessageTimeout of silence (wall time) at the latest.
  std::optional<StepDeadlines> deadlines;
  /// False: of several lists only the newest is answered. The steps of the others have no report,
  /// and the summary counts each as a missed deadline.
  bool answers_every_list{};
  /// A controller that is ready and receives no lists logs it. (In logical time a list comes when
  /// everybody is done.)
  bool logs_missing_lists{};
  /// The stop symbol of the lab domain counts, too, not only the one that the middleware forwards.
  /// (In logical time there are 50 triggers a second and no car that a stop could save.)
  bool stops_on_lab_domain{};
  CommandCopy copy{};
  /// Since the start: a name that is alive for longer than this is a running duplicate instance,
  /// not the trace of a dead one. Longer than the lease of a participant.
  Nanoseconds duplicate_patience{};
  Nanoseconds middleware_patience{};  ///< for a middleware that is lost; 0: none
  /// The lab control is asked for a parameter every second, and is lost if it stops answering.
  bool asks_lab_control{};
  /// The start is waited for without a limit, and reminders are logged every kReminderPause. False:
  /// the controller ends if a participant is missing after the startup timeout.
  bool waits_for_start{};
  /// With waits_for_start: an active vehicle whose controller has not appeared this long after the
  /// own start is driven by something else, and is a missing vehicle.
  Nanoseconds controller_patience{};
  Nanoseconds preparation_patience{};  ///< of a step for requested subgraphs; 0: none
  /// While it waits for the others' traffic it warms up (Controller::warm_up): for speed only.
  bool warms_up{true};
};

/// Longest time between two lines about what a controller that waits for the start waits for.
inline constexpr Nanoseconds kReminderPause = 30 * kNanosecondsPerSecond;

/// @param is_in_the_lab  the other programs may be the lab's (its transport). Their middleware
/// keeps the last command only; ours on loopback keeps all until it reads them. And the lab's
/// operator may start the experiment minutes later, with vehicles that other software drives.
[[nodiscard]] HlcRules rules_in_logical_time(bool is_in_the_lab);
[[nodiscard]] HlcRules rules_in_real_time(bool is_in_the_lab, const StepDeadlines& deadlines,
                                          Nanoseconds startup_timeout);

}  // namespace hlc::high_level_controller
