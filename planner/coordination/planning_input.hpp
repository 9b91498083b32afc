#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/coordination/ids.hpp"
#include "planner/geometry/pose.hpp"

/// What planning for a vehicle depends on, so that every controller can compute the new plan of
/// every vehicle whose traffic it receives.
namespace hlc::coordination {

/// The rest of a plan, its maneuvers by their index in an automaton that sender and receiver share.
struct PlanByIndex {
  StepIndex first;
  std::vector<Pose> poses;  ///< at t(first + i); one more than maneuvers
  std::vector<std::uint32_t> maneuvers;
  std::uint32_t standstill{};  ///< the self-loop that follows
  friend bool operator==(const PlanByIndex&, const PlanByIndex&) = default;
};

/// The drivable area (controller/drivable_area.hpp): by how much the lanes are widened, while the
/// vehicle enters them, and when another area is searched.
struct DrivableAreaState {
  struct Widened {
    double from_s_m{};
    double to_s_m{};
    double left_m{};
    double right_m{};
    friend bool operator==(const Widened&, const Widened&) = default;
  };
  std::optional<Widened> entry;
  bool is_possible{true};
  bool is_certain{true};
  bool is_departing{};
  std::optional<StepIndex> stands_since;
  friend bool operator==(const DrivableAreaState&, const DrivableAreaState&) = default;
};

/// State of the sender when it publishes its traffic in step k. Its new plan is a function of this
/// and the rest of its traffic, of the other vehicles' traffic and state list, and of what `basis`
/// stands for.
struct PlanningInput {
  /// Digest of everything that does not change from step to step: automaton, subgraph, rules,
  /// limits, routes. Two controllers whose digests for a vehicle differ compute different plans for
  /// it.
  std::uint64_t basis{};
  bool may_plan{};   ///< false: the sender keeps its plan in force in this step
  PlanByIndex base;  ///< continued by the new plan; from t(k - 1) on, if it has begun then
  bool is_moved{};   ///< `base` is not the plan in force itself (PlanInForce::is_moved)
  // The vehicle's last sight, and its deviation from the plan then (PlanInForce).
  StepIndex seen_step;
  double seen_time_s{};
  Pose seen_pose;
  double deviation_m{};
  // Its place (RouteTracker).
  std::uint32_t route{};  ///< index among the vehicle's permitted routes
  double path_s_m{};
  DrivableAreaState area;
  friend bool operator==(const PlanningInput&, const PlanningInput&) = default;
};

/// False if a number is none or too large, or numbers do not fit each other: the base begins at
/// t(k - 1) or t(k), and the vehicle was seen between then and t(k + 1). Whether the indices exist
/// only the receiver knows.
/// @param step  k
[[nodiscard]] bool is_well_formed(const PlanningInput& input, StepIndex step);

}  // namespace hlc::coordination
