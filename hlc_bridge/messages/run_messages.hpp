#pragma once

#include "hlc_bridge/messages/messages.hpp"
#include "planner/coordination/report.hpp"

/// Messages between controllers and lab control about the run, beside the lab's messages.
namespace hlc {

/// A controller's report with the times measured by its process.
struct ReportRecord {
  coordination::Report report;
  /// Processor time of Controller::plan, see there. The lateness of an answer is wall time.
  Nanoseconds planning_ns{};
  bool deadline_missed{};  ///< an answer of this step came after its deadline
  Nanoseconds late_ns{};   ///< by how much
  /// Response time: from t_now of the step's list until its command, by the clock of the run. 0 in
  /// logical time, whose clock stands meanwhile.
  Nanoseconds response_ns{};
};

enum class RunPhase : std::uint8_t {
  kRunning,
  kMinimalRiskStop,  ///< plan nothing new; drive the running plan to its end
};

/// Published by the lab control for all controllers.
struct RunState {
  RunPhase phase{RunPhase::kRunning};
  /// Real time: next_start of the start trigger, for controllers that were absent when it was sent.
  /// 0: none.
  Nanoseconds start{};
};

}  // namespace hlc
