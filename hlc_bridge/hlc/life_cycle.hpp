#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "hlc_bridge/hlc/hlc_events.hpp"
#include "hlc_bridge/hlc/hlc_rules.hpp"
#include "hlc_bridge/hlc/middleware_watch.hpp"
#include "hlc_bridge/hlc/readiness.hpp"
#include "hlc_bridge/machine/lab_control_watch.hpp"
#include "hlc_bridge/machine/wait_notice.hpp"
#include "planner/controller/controller.hpp"

namespace hlc::high_level_controller {

/// The duties of a controller's process beside its steps: becomes ready and publishes it, detects
/// lost and returned participants, logs what it waits for, and ends.
///
/// Ends between two steps, when
///   * its middleware is lost and not back in time: at once if the rules require it, or in a
///     minimal-risk stop of the run (a lost lab control is no reason: to a process that got no
///     processor time for a lease, all others seem lost);
///   * it yields to a duplicate instance (Readiness);
///   * the lab control is lost for longer than kControllerStays (until then: minimal-risk stop);
///   * a participant has not appeared within the startup timeout, unless the start is waited for
///     (HlcRules::waits_for_start).
class LifeCycle {
 public:
  LifeCycle(VehicleId vehicle, const HlcRules& rules, Nanoseconds startup_timeout);

  void receive(const HlcPeers& peers);
  /// A minimal-risk stop is final: it is logged, and the process then ends with kExitDied.
  void receive(const RunState& state, HlcActions& actions);
  /// An answer of the lab control.
  void receive(const Parameter& /*answer*/) { lab_control_.receive_answer(); }
  /// A list was received. @param wall  now
  void receive_list(Nanoseconds wall);

  [[nodiscard]] Readiness& readiness() { return readiness_; }
  [[nodiscard]] const Readiness& readiness() const { return readiness_; }
  /// The plan in force is to be driven to its end and nothing new planned: by order of the lab
  /// control, or because it is lost.
  [[nodiscard]] bool is_minimal_risk_stop() const {
    return minimal_risk_stop_ || lab_control_.is_lost();
  }
  /// By order of the lab control: the run has failed.
  [[nodiscard]] bool is_stopped_for_good() const { return minimal_risk_stop_; }
  [[nodiscard]] bool has_stop_request_readers() const { return stop_request_readers_ > 0; }

  /// Whether the controller is ready now. @param has_started  the experiment has (ExperimentStart)
  void update_readiness(Nanoseconds wall, bool has_started, HlcActions& actions);
  /// At every advance.
  void watch(Nanoseconds wall, bool has_started, HlcActions& actions);
  /// At every advance between two steps: publishes repeatedly that the controller is ready, until
  /// the start.
  void publish_ready(Nanoseconds wall, const controller::Controller& controller, bool has_started,
                     HlcActions& actions);
  /// The code with which to end now; none: continue. Logs the reason. @param has_list  a list is
  /// pending
  [[nodiscard]] std::optional<int> exit_code(Nanoseconds wall, bool has_list,
                                             HlcActions& actions) const;

  /// Between two steps: wall time at which to call the last three without an event.
  [[nodiscard]] std::optional<Nanoseconds> wake_up() const;

 private:
  static constexpr Nanoseconds kReadyRepeat = kNanosecondsPerSecond / 2;

  struct ReadyNotices {
    bool repeats{};
    Nanoseconds next_at{};        ///< 0: not published yet
    Nanoseconds next_reminder{};  ///< that the start is awaited; 0: it is not
  };

  void watch_lab_control(Nanoseconds wall, HlcActions& actions);
  void remind(Nanoseconds wall, HlcActions& actions);
  [[nodiscard]] std::string_view obstacle_to_start(const controller::Controller& controller) const;
  void remind_of_start(Nanoseconds wall, std::string_view missing, HlcActions& actions);
  [[nodiscard]] bool is_start_overdue(Nanoseconds wall) const {
    return !rules_.waits_for_start && !readiness_.is_ready() &&
           wall > *began_at_ + startup_timeout_;
  }

  VehicleId vehicle_;
  HlcRules rules_;
  Nanoseconds startup_timeout_;
  Readiness readiness_;
  MiddlewareWatch middleware_;
  machine::LabControlWatch lab_control_;
  bool is_lab_control_absent_{};  ///< by name
  std::size_t stop_request_readers_{};
  bool minimal_risk_stop_{};
  std::optional<Nanoseconds> began_at_;  ///< first advance
  machine::WaitNotice peers_notice_{0};  ///< for missing participants
  machine::WaitNotice list_notice_{0};   ///< for lists
  Nanoseconds last_list_at_{};
  ReadyNotices ready_;
};

}  // namespace hlc::high_level_controller
