#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "planner/controller/lane_entry.hpp"
#include "planner/coordination/report.hpp"

namespace hlc::controller {

/// When the drivable area is searched again after a standstill: true for a vehicle whose plan has
/// kept it in place for `stood_steps` > 0. A rule is one function.
using StandstillTimeoutRule = bool (*)(std::uint64_t stood_steps, std::size_t horizon_steps);

/// Once in every horizon.
[[nodiscard]] bool once_per_horizon(std::uint64_t stood_steps, std::size_t horizon_steps);
/// A vehicle that stands in its lanes stays in them.
[[nodiscard]] bool no_timeout(std::uint64_t stood_steps, std::size_t horizon_steps);

/// Inputs of `update_drivable_area`.
struct DrivableAreaInputs {
  StepIndex next;                         ///< k + 1: planning is for t(next) on
  bool is_ended{};                        ///< the plan in force has ended by then
  bool stands{};                          ///< it is to stay in place from then on
  std::function<bool()> lies_in_lanes;    ///< the plan in force, from then on
  std::function<LaneEntry()> find_entry;  ///< from the vehicle's pose then
};

/// The area in which a vehicle may drive: at the start an area that leads into its lanes, if
/// necessary, and its lanes as soon as the plan in force lies in them. The same holds for a vehicle
/// that has come to stand in its lanes, by a fallback or a change of its subgraph, where no plan
/// that stays in them leads on: see StandstillTimeoutRule. A value.
class DrivableArea {
 public:
  DrivableArea(StandstillTimeoutRule timeout, std::size_t horizon_steps)
      : timeout_(timeout), horizon_steps_(horizon_steps) {}

  /// The vehicle stands at its measured pose, and the area is to be searched from there.
  void depart() { is_departing_ = true; }
  /// The vehicle follows another route: an area that led into the former one counts no longer.
  void change_route() {
    entry_ = {};
    is_departing_ = true;
  }
  /// The controller plans on another subgraph, with which the vehicle may get into its lanes.
  void note_switch() { is_departing_ = is_departing_ || !entry_.is_possible; }

  void update_drivable_area(const DrivableAreaInputs& inputs);

  /// What `update_drivable_area` depends on, and the same again on the same route.
  [[nodiscard]] coordination::DrivableAreaState state() const;
  void resume(const coordination::DrivableAreaState& state, const road::DrivableRoute& route);

  /// The area that leads into the lanes, while it is needed.
  [[nodiscard]] const std::optional<road::Corridor>& entry_area() const { return entry_.area; }
  /// Why the vehicle has to stay in place; none if it need not.
  [[nodiscard]] coordination::FallbackReason obstacle() const;

 private:
  [[nodiscard]] bool has_timed_out(const DrivableAreaInputs& inputs);

  StandstillTimeoutRule timeout_;
  std::size_t horizon_steps_;
  LaneEntry entry_;
  bool is_departing_{false};
  std::optional<StepIndex> stands_since_;  ///< while the plan in force keeps the vehicle in place
};

}  // namespace hlc::controller
