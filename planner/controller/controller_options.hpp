#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "planner/controller/drivable_area.hpp"
#include "planner/controller/obstacles.hpp"
#include "planner/controller/plan_in_force.hpp"
#include "planner/coordination/commit.hpp"
#include "planner/coordination/coupling_rule.hpp"
#include "planner/coordination/guest.hpp"
#include "planner/coordination/priority.hpp"
#include "planner/right_of_way/conflict_map.hpp"
#include "planner/right_of_way/grant_order.hpp"
#include "planner/road/reference_points.hpp"
#include "planner/search/horizon_problem.hpp"
#include "planner/vehicle/lab_limits.hpp"

namespace hlc::controller {

/// A plan that is known before the search begins (HorizonProblem::incumbent): n maneuvers from
/// t(next) on, or nothing. A rule is one function.
/// @param in_force  planning starts from its pose at t(next)
using IncumbentRule = std::vector<const automaton::Maneuver*> (*)(
    const coordination::Plan& in_force, StepIndex next, std::size_t horizon_steps);

/// The rest of the plan in force, then standing.
[[nodiscard]] std::vector<const automaton::Maneuver*> rest_of_plan_in_force(
    const coordination::Plan& in_force, StepIndex next, std::size_t horizon_steps);
[[nodiscard]] std::vector<const automaton::Maneuver*> no_incumbent(
    const coordination::Plan& in_force, StepIndex next, std::size_t horizon_steps);

/// When a new plan comes into force (commit.hpp), with the obstacles in planning that this relies
/// on, and whether vehicles make room for those that plan before them (making_room.hpp).
struct CoordinationRule {
  coordination::CommitRule commit;
  CoupledObstacleRule obstacles;
  /// What of these remains whatever new plans the others make: for the bound of
  /// coordination/joint_gap.hpp.
  CoupledObstacleRule lasting_obstacles;
  bool makes_room{};
  friend bool operator==(const CoordinationRule&, const CoordinationRule&) = default;
};

inline constexpr CoordinationRule kStrictCoordination{.commit = coordination::kStrictCommit,
                                                      .obstacles = &old_and_new_plans,
                                                      .lasting_obstacles = &old_plans};
inline constexpr CoordinationRule kCooperativeCoordination{.commit = coordination::kStrictCommit,
                                                           .obstacles = &old_and_new_plans,
                                                           .lasting_obstacles = &old_plans,
                                                           .makes_room = true};
inline constexpr CoordinationRule kAgreedCoordination{
    .commit = coordination::kAgreedCommit,
    .obstacles = &predictions_and_standing_successors,
    .lasting_obstacles = &no_plans};

/// The rules by which a controller plans and coordinates. All vehicles of a run need the same.
struct ControllerStrategies {
  coordination::PriorityRule priorities{};
  const coordination::CouplingRule* coupling{&coordination::kReachableAreas};
  const right_of_way::GrantOrder* grant_order{&right_of_way::kLongestWait};
  CoordinationRule coordination{kCooperativeCoordination};
  IncumbentRule incumbent{&rest_of_plan_in_force};
  StandstillTimeoutRule standstill_timeout{&once_per_horizon};
  friend bool operator==(const ControllerStrategies&, const ControllerStrategies&) = default;
};

/// Rounds of messages in a step, after which the vehicles know each other's new plans.
enum class Rounds : std::uint8_t {
  kSequential,  ///< one for each level of priorities: each waits for its predecessors' predictions
  kTwo,         ///< each computes them from the traffic (joint_planning.hpp)
};

class Controller;
/// Makes the controller of another vehicle as that one's own process does.
using ControllerFactory = std::function<std::unique_ptr<Controller>(VehicleId)>;

/// Greater weights cost accuracy: at 1e4 and 10 m costs still differ by 1e-9.
inline constexpr double kMostContouringWeight = 1e4;

struct ControllerOptions {
  VehicleId vehicle;
  std::size_t horizon_steps{8};
  double reference_speed_mps{0.8};  ///< outside slower sections of the route
  /// w of HorizonProblem: how much more an error across the path counts than one along it. 0: as in
  /// the paper.
  double contouring_weight{};
  /// w of a vehicle that is held up (held_up.hpp): a greater one keeps it in its lane where it
  /// waits, and does not slow down others.
  std::optional<double> held_up_contouring_weight{};  ///< none: the same
  road::ReferenceRule reference_rule{road::half_speed_last};
  ControllerStrategies strategies{};
  search::SearchOptions search{};
  DeviationRules deviation{};
  /// Right of way among all vehicles of the run (authority.hpp). Absent: none.
  std::shared_ptr<const right_of_way::ConflictMap> conflicts{};
  /// Limits of the vehicle: a plan beyond them does not come into force. Absent: none.
  std::optional<vehicle::LabLimits> lab{};
  /// Vehicles that take no part in the coordination: none of the observation's active ones.
  std::vector<coordination::Guest> guests{};
  /// With which this controller plans for the others, too (joint_planning.hpp); its traffic then
  /// has a planning input. Absent: vehicles plan one after the other.
  ControllerFactory others{};
};

}  // namespace hlc::controller
