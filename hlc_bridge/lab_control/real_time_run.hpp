#pragma once

#include "hlc_bridge/lab_control/lab_run.hpp"
#include "hlc_bridge/messages/settled_states.hpp"

namespace hlc::lab_control {

/// A run in real time: the lab control starts and stops it, time passes by itself (wire
/// contract, 5.2).
///
/// It begins when every middleware has reported its controller ready, every vehicle's states have
/// settled, and the triggers reach every timer; step 0 is the first list at or after the start
/// trigger's time, one second later. `now` of advance() is the time since the epoch.
///
/// From the start trigger's time on, a report of every live controller is due at least every
/// kReportTimeout, since it reports every list; and when one has left standby, the others whose
/// vehicles are alive must follow within that time. A controller that does not is dead, even if its
/// participant still announces itself.
class RealTimeRun : public LabRun {
 public:
  /// From the trigger to the start.
  static constexpr Nanoseconds kStartDelay = 1 * kNanosecondsPerSecond;

  /// Longer than the lease of 2 s, after which a process without signs of life is lost: a
  /// controller whose middleware is gone gets no lists to report, and is not the cause.
  static constexpr Nanoseconds kReportTimeout = 2'500'000'000;

  explicit RealTimeRun(LabRunSettings settings) : LabRun{std::move(settings)} {}

  void ready(const ReadyStatus& status) override;
  void state(const VehicleState& state) override;
  [[nodiscard]] bool releases_time() const override { return false; }
  [[nodiscard]] bool awaits_states() const override { return true; }
  [[nodiscard]] Nanoseconds time_of(const Instant& now) const override { return now.run; }
  [[nodiscard]] WakeUp wake_up_at(Nanoseconds time) const override { return {.run = time}; }
  [[nodiscard]] Nanoseconds start() const override { return start_.value_or(0); }

 protected:
  [[nodiscard]] std::vector<std::string> not_ready() const override;
  void go_on(LabRunActions& actions) override;
  [[nodiscard]] Nanoseconds clock() const override { return now(); }
  void drop(const std::string& process) override;
  void on_return(const std::string& process) override;
  [[nodiscard]] std::vector<Death> overdue() const override;
  [[nodiscard]] Nanoseconds next_overdue() const override;
  [[nodiscard]] bool is_drive_overdue(std::uint8_t vehicle_id) const override {
    return now() >= must_drive_by(vehicle_id);
  }
  [[nodiscard]] Nanoseconds wall_time_of(Nanoseconds t) const override { return t; }

 private:
  [[nodiscard]] bool has_settled(std::uint8_t vehicle_id) const;
  /// When the living controller of the vehicle is dead unless it speaks (`report_due`), and unless
  /// it drives (`drive_due`); kNever if that is not to be expected.
  [[nodiscard]] Nanoseconds report_due(std::uint8_t vehicle_id) const;
  [[nodiscard]] Nanoseconds drive_due(std::uint8_t vehicle_id) const;
  /// The same of a controller that is dead; kNever while its vehicle is: it stands by for it.
  [[nodiscard]] Nanoseconds must_drive_by(std::uint8_t vehicle_id) const;

  std::set<std::string> ready_;                    ///< node names of middlewares
  std::map<std::uint8_t, SettledStates> settled_;  ///< by vehicle
  std::set<std::uint8_t> silenced_;                ///< their controllers are gone, or get no lists
  /// When vehicles that had died were back; kNever: they are not.
  std::map<std::uint8_t, Nanoseconds> returns_;
  std::optional<Nanoseconds> start_;  ///< next_start of the trigger
};

}  // namespace hlc::lab_control
