#pragma once

#include "hlc_bridge/messages/messages.hpp"
#include "planner/coordination/report.hpp"

/// What controllers and lab control tell each other about the run, beside what the lab's messages
/// say.
namespace hlc {

/// A controller's report with what its process measured by the clock.
struct ReportRecord {
  Report report;
  /// Processor time of Controller::plan, see there. How late an answer is, is wall time.
  Nanoseconds planning_ns{};
  bool deadline_missed{};  ///< an answer of this step came after its deadline
  Nanoseconds late_ns{};   ///< by how much
};

enum class RunPhase : std::uint8_t {
  kRunning,
  kMinimalRiskStop,  ///< plan nothing new; drive the running plan to its end
};

/// Said by lab control to all controllers.
struct RunState {
  RunPhase phase{RunPhase::kRunning};
  /// Real time: next_start of the start trigger, for controllers that were not there when it was
  /// sent. 0: none.
  Nanoseconds start{};
};

}  // namespace hlc
