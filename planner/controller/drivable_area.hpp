#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "planner/controller/lane_entry.hpp"
#include "planner/coordination/report.hpp"

namespace hlc {

/// After how long a standstill the drivable area is looked for anew: true if a vehicle does so
/// whose plan has kept it where it is for `stood_steps` > 0. A rule is one function.
using StandstillTimeoutRule = bool (*)(std::uint64_t stood_steps, std::size_t horizon_steps);

/// Once in every horizon.
[[nodiscard]] bool once_per_horizon(std::uint64_t stood_steps, std::size_t horizon_steps);

/// What `update_drivable_area` may go by.
struct DrivableAreaInputs {
  StepIndex next;                         ///< k + 1: from t(next) on is planned
  bool is_ended{};                        ///< the plan in force has ended by then
  bool stands{};                          ///< from then on it is to stay where it is
  std::function<bool()> lies_in_lanes;    ///< the plan in force, from then on
  std::function<LaneEntry()> find_entry;  ///< from where the vehicle will be then
};

/// Where a vehicle may drive: at the start in an area that leads into its lanes, if need be, and in
/// them as soon as the plan in force lies there. So does one that has come to stand in its lanes,
/// by a fallback or a change of its subgraph, where nothing that stays in them leads on: see
/// StandstillTimeoutRule. A value.
class DrivableArea {
 public:
  /// @param timeout  absent: whoever stands in its lanes stays in them
  DrivableArea(StandstillTimeoutRule timeout, std::size_t horizon_steps)
      : timeout_(timeout), horizon_steps_(horizon_steps) {}

  /// The vehicle stands where it was measured, and the area is to be looked for from there.
  void depart() { is_departing_ = true; }
  /// It plans on another subgraph, with which it may get into its lanes.
  void note_switch() { is_departing_ = is_departing_ || !entry_.is_possible; }

  void update_drivable_area(const DrivableAreaInputs& inputs);

  /// The area that leads into the lanes, while it is needed.
  [[nodiscard]] const std::optional<Corridor>& entry_area() const { return entry_.area; }
  /// Why the vehicle has to stay where it is; none if it has not.
  [[nodiscard]] FallbackReason obstacle() const;

 private:
  [[nodiscard]] bool has_timed_out(const DrivableAreaInputs& inputs);

  StandstillTimeoutRule timeout_;
  std::size_t horizon_steps_;
  LaneEntry entry_;
  bool is_departing_{false};
  std::optional<StepIndex> stands_since_;  ///< while the plan in force is to stay where it is
};

}  // namespace hlc
