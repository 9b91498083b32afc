#pragma once

#include <map>
#include <string>
#include <vector>

#include "hlc_bridge/lab_control/arrival_notice.hpp"
#include "hlc_bridge/messages/run_messages.hpp"

namespace hlc::lab_control {

/// The vehicles of a run that stand because of others (planner/coordination/waiting.hpp) or at
/// their goals, as their controllers report it.
class StandingVehicles {
 public:
  explicit StandingVehicles(Nanoseconds period);

  /// @param report  of a step of the run, by increasing step for each vehicle
  /// @param start   first step of the run
  void add(const coordination::Report& report, StepIndex start);
  /// One line for each vehicle that has become stuck, or arrived, since the last call.
  [[nodiscard]] std::vector<std::string> take_stuck();
  [[nodiscard]] std::vector<std::string> take_arrived();
  /// The vehicles that are stuck in their last reported step, in one line; empty: none.
  [[nodiscard]] std::string stuck_line() const;

 private:
  struct Reported {
    coordination::Report last;
    coordination::StuckNotice stuck;
    ArrivalNotice arrival;
  };

  double step_s_;
  std::map<VehicleId, Reported> vehicles_;
  std::vector<std::string> stuck_;
  std::vector<std::string> arrived_;
};

}  // namespace hlc::lab_control
