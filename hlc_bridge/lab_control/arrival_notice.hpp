#pragma once

#include <optional>
#include <string>

#include "hlc_bridge/messages/run_messages.hpp"

namespace hlc::lab_control {

/// Notices that one vehicle arrives at its goal: once per arrival.
class ArrivalNotice {
 public:
  /// @param report  of the next step
  /// @param start   first step of the run
  /// @return a line for the log, if the vehicle has arrived and had not before
  [[nodiscard]] std::optional<std::string> note(const coordination::Report& report, StepIndex start,
                                                double step_s);

 private:
  std::optional<StepIndex> arrived_since_;
};

}  // namespace hlc::lab_control
