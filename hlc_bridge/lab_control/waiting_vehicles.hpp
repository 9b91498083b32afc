#pragma once

#include <map>
#include <string>
#include <vector>

#include "hlc_bridge/messages/run_messages.hpp"

namespace hlc::lab_control {

/// The vehicles of a run that stand because of others, as their controllers report it
/// (planner/coordination/waiting.hpp).
class WaitingVehicles {
 public:
  explicit WaitingVehicles(Nanoseconds period);

  /// @param report  of a step of the run, by increasing step for each vehicle
  void add(const coordination::Report& report);
  /// One line for each vehicle that has become stuck since the last call.
  [[nodiscard]] std::vector<std::string> take_notices();
  /// The vehicles that are stuck in their last reported step, in one line; empty: none.
  [[nodiscard]] std::string stuck_line() const;

 private:
  struct Reported {
    coordination::Report last;
    coordination::StuckNotice notice;
  };

  double step_s_;
  std::map<VehicleId, Reported> vehicles_;
  std::vector<std::string> notices_;
};

}  // namespace hlc::lab_control
