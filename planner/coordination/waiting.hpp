#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/coordination/ids.hpp"
#include "planner/geometry/pose.hpp"

/// A vehicle that stands because of others, as its controller reports it. The rule that decides on
/// it is planner/controller/waits_for.hpp.
namespace hlc::coordination {

struct Report;

struct Waiting {
  std::vector<VehicleId> vehicles;  ///< it waits for these, the one in its way first; empty: it
                                    ///< does not wait
  StepIndex since;                  ///< first step of the waiting without a break; 0 without one
  friend bool operator==(const Waiting&, const Waiting&) = default;
};

/// A vehicle that has waited for so long without a break is stuck.
inline constexpr double kStuckAfter_s = 20.0;

/// How long the vehicle will have waited at the end of the report's step, t(k+1); 0: it does not
/// wait.
[[nodiscard]] double wait_s(const Report& report, double step_s);
[[nodiscard]] bool is_stuck(const Report& report, double step_s);

/// "vehicle 3, waiting for 1, 2 for 20.4 s". @pre it waits
[[nodiscard]] std::string waiting_text(const Report& report, double step_s);

/// Notices that one vehicle becomes stuck: once per waiting. Reports, too, if it has not moved
/// since the first report: at the start of a run the start places are a knot then.
class StuckNotice {
 public:
  /// @param report  of the next step
  /// @return a line for the log, if the vehicle is stuck and was not so before
  [[nodiscard]] std::optional<std::string> note(const Report& report, double step_s);

 private:
  bool is_stuck_{};
  std::optional<Pose> start_;  ///< of the first report
  bool has_moved_{};
};

}  // namespace hlc::coordination
