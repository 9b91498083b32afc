#pragma once

#include "hlc_bridge/core/lab_run.hpp"

namespace hlc {

/// A run in real time: the lab control starts and stops it, time passes by itself (wire
/// contract, 5.2).
///
/// It begins when every middleware has told that its controller is ready, every vehicle has sent a
/// state, and the triggers reach every timer; step 0 is the first list at or after the start
/// trigger's time, one second later. `now` of advance() is the time since the epoch.
class RealTimeRun : public LabRun {
 public:
  /// From the trigger to the start.
  static constexpr Nanoseconds kStartDelay = 1 * kNanosecondsPerSecond;

  explicit RealTimeRun(LabRunSettings settings) : LabRun{std::move(settings)} {}

  void ready(const ReadyStatus& status) override;
  void state(const VehicleState& state) override;

 protected:
  [[nodiscard]] std::vector<std::string> not_ready() const override;
  void go_on(LabRunActions& actions) override;
  [[nodiscard]] Nanoseconds clock() const override { return now(); }
  void drop(const std::string& process) override;
  [[nodiscard]] Nanoseconds wall_time_of(Nanoseconds t) const override { return t; }

 private:
  std::set<std::string> ready_;  ///< node names of middlewares and vehicles
  bool triggered_{};
};

}  // namespace hlc
