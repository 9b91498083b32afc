#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/controller/authority.hpp"
#include "planner/controller/candidate_search.hpp"
#include "planner/controller/controller_options.hpp"
#include "planner/controller/drivable_area.hpp"
#include "planner/controller/ended_step.hpp"
#include "planner/controller/left_out.hpp"
#include "planner/controller/neighbours.hpp"
#include "planner/controller/observation.hpp"
#include "planner/controller/plan_in_force.hpp"
#include "planner/controller/prepared_subgraph.hpp"
#include "planner/controller/problem_alone.hpp"
#include "planner/controller/route_tracker.hpp"
#include "planner/controller/shared_step.hpp"
#include "planner/coordination/coupling.hpp"
#include "planner/coordination/messages.hpp"
#include "planner/coordination/received_messages.hpp"
#include "planner/coordination/report.hpp"
#include "planner/road/corridor.hpp"
#include "planner/road/placement.hpp"
#include "planner/road/reference_path.hpp"

namespace hlc::controller {

/// The high-level controller of one vehicle, as a pure state machine: no clock, no thread, no
/// waiting. ControlLoop takes it through the phases of a step, in their order:
///
///     observe -> couple -> plan -> vote -> commit
///
/// Each phase works with the messages received so far. A vehicle that published nothing is missing
/// and may be anywhere in its reachable set. After `commit` the plan in force holds from t(k) on.
///
/// The plan of step k is for the time from t(k+1) on: the search starts where the plan in force
/// will be then. If no new plan comes into force, the one in force stays: every plan ends in
/// standstill. For a vehicle that is not on its plan see plan_in_force.hpp.
///
/// The vehicle starts from where it stands. Of its permitted routes it follows the best fit, from
/// its place there on (route_tracker.hpp); beside its lanes it drives in an area that leads into
/// them (drivable_area.hpp). A vehicle that fits none, or cannot get onto its route, stands and
/// reports it.
///
/// A value: a copy is an independent controller in the same state, for looking ahead. Copies share
/// what never changes; each makes its own search engine when it first searches.
class Controller {
 public:
  /// @param routes  the permitted ones, at least one
  /// @throws std::invalid_argument as prepare_subgraph and make_search_engine
  Controller(const ControllerOptions& options, std::shared_ptr<const automaton::Subgraph> subgraph,
             std::vector<road::DrivableRoute> routes);
  /// The same on a subgraph that was prepared for this horizon and search.
  Controller(ControllerOptions options, PreparedSubgraph on,
             std::vector<road::DrivableRoute> routes);
  /// With a single route.
  /// @param path      to be followed
  /// @param corridor  area in which the vehicle may drive
  Controller(const ControllerOptions& options, std::shared_ptr<const automaton::Subgraph> subgraph,
             road::ReferencePath path, road::Corridor corridor);

  [[nodiscard]] const ControllerOptions& options() const { return options_; }
  [[nodiscard]] const automaton::Subgraph& subgraph() const {
    return *prepared_subgraph().subgraph;
  }
  /// The same with its tables, shared.
  [[nodiscard]] const PreparedSubgraph& prepared_subgraph() const { return search_.on(); }
  /// Step of the last `observe` or `stand_by`.
  [[nodiscard]] StepIndex last_step() const { return step_.observation.step; }

  /// Applies to each search from now on. Not in the middle of a step.
  void set_max_expansions(std::size_t max_expansions);

  /// ControllerOptions::reference_speed_mps from the next step on, part of the `planning_basis`.
  /// @param speed_mps  > 0
  void set_reference_speed(double speed_mps);

  /// Another order and rule of coordination from the next step on; all vehicles of a run need the
  /// same. Not in the middle of a step.
  void coordinate_by(const coordination::PriorityRule& priorities, const CoordinationRule& rule);

  /// Follows another route from the next step on, from its place there (see `placement`). Not in
  /// the middle of a step. The plan in force stays, and is the fallback as always: where no plan
  /// leads on along the route, the vehicle drives that one to its end, and stands and reports it if
  /// it cannot get onto the route from there. Others can no longer plan for it.
  /// @pre a plan is in force; the route has a number in ControllerOptions::conflicts, if there are
  void change_route(road::DrivableRoute next);

  /// From the next step on something that is no vehicle stands there for good: no new plan meets
  /// it, and with right of way no authority reaches into it. Part of the `planning_basis`: all
  /// controllers of a run need the same ones in the same order. Not in the middle of a step.
  void add_obstacle(const ConvexPolygon& area_m) { standing_m_.push_back(area_m); }
  void take_obstacles_of(const Controller& one) { standing_m_ = one.standing_m_; }  ///< instead
  [[nodiscard]] bool has_obstacles() const { return !standing_m_.empty(); }
  /// Whether the plan in force meets the area. Not in the middle of a step. @pre there is one
  [[nodiscard]] bool will_meet(const ConvexPolygon& area_m) const;

  /// Plans on another subgraph from the next step on, of the same automaton or of one that differs
  /// from it in its maneuvers alone. Not in the middle of a step. The plan in force stays, even if
  /// parts of it are disabled now, and is the fallback as always: see Subgraph for the rule. Where
  /// no plan is found from the plan in force (the exit edges lead into something), the former
  /// subgraph is planned on, until a plan is found, for a horizon at most. The other vehicles need
  /// not switch in the same step: the area of a missing one is bounded with the highest speed of
  /// the whole automaton that was given at first.
  /// @pre `next` was prepared for this controller's horizon and search; its subgraph is of the same
  /// vehicle, step and trims, and has no maneuver faster than that
  void switch_to(const PreparedSubgraph& next);
  /// The same, prepared by this call.
  void switch_to(std::shared_ptr<const automaton::Subgraph> next);

  /// A step before the start: the plan in force is to stand at the measured pose. Without a
  /// measurement of the own vehicle the former plan, if any, stays.
  [[nodiscard]] coordination::Report stand_by(const Observation& observation);

  /// If requested, nothing new is planned from the next step on, and the plan in force is driven to
  /// its end; otherwise planning continues from the rest of it.
  void set_minimal_risk_stop(bool is_requested) { minimal_risk_stop_ = is_requested; }

  /// First phase. @pre a plan is in force (see `has_plan`), observation.step has increased
  [[nodiscard]] coordination::Traffic observe(const Observation& observation);
  /// Of another vehicle, in place of its first two phases: takes the state in which its own
  /// controller is after them if that one has received the same traffic. `plan` then returns what
  /// that controller predicts, bit for bit; no other phase may follow.
  /// @param traffic   of this object's vehicle in the step
  /// @param receiver  has received it, and is after `couple`
  /// @return false: this object cannot plan for the vehicle (another basis, or nonsense)
  [[nodiscard]] bool resume(const coordination::Traffic& traffic, const Controller& receiver);
  /// PlanningInput::basis of the vehicle.
  [[nodiscard]] std::uint64_t planning_basis() const;
  /// Any time between the first phase and the third, while the owner waits for the others'
  /// messages: searches the former step's problem, updated as far as that is known without the
  /// messages, and drops the result. Changes nothing; but it fills the processor's caches with the
  /// data of a search, which take longer to fetch than most searches. Returns <= 1024 expansions.
  std::uint64_t warm_up();
  /// Second phase. `received` may hold messages of other steps and senders: they are ignored.
  /// @param shared  of all controllers that are stepped together
  void couple(const coordination::ReceivedMessages<coordination::Traffic>& received,
              SharedStep& shared);
  /// The same alone.
  void couple(const coordination::ReceivedMessages<coordination::Traffic>& received);
  /// Any time between the second phase and the third: another order than PriorityRule::assign gave.
  /// @param level  computation level of this vehicle in it
  void plan_in(const coordination::PriorityOrder& plans_before, std::uint32_t level);
  /// All that the third phase changes.
  class Coupled;
  /// After the second phase, to plan again from there. @pre is_settled
  [[nodiscard]] Coupled coupled_state() const;
  /// The same, moved out of this object: `restore` must follow.
  [[nodiscard]] Coupled take_state();
  /// @param state  of this object in this step
  void restore(Coupled state);
  /// After `plan`, any time before the owner calls it: `plan` then returns this result at once if
  /// it is given the same predictions; otherwise, or before `fall_back`, the object goes back.
  /// @param before  `coupled_state` before the first of these calls
  void keep_plan(std::shared_ptr<const Coupled> before);
  /// Only the current subgraph may be planned on.
  [[nodiscard]] bool is_settled() const { return search_.is_settled(); }
  /// Cost of the first plan that the third phase found; none if there is no new plan.
  [[nodiscard]] std::optional<double> planned_cost_m2() const {
    return step_.candidate.plan ? std::optional(step_.cost_m2) : std::nullopt;
  }
  /// Vertices that the third phase has expanded.
  [[nodiscard]] std::uint64_t expanded() const { return step_.report.expanded; }
  /// Third phase. Needs the predictions of `predecessors`. Poses the problem, searches, predicts
  /// the drift, checks the result, and searches again if the drift leads into something: planning
  /// time is the duration of all this.
  [[nodiscard]] coordination::Prediction plan(
      const coordination::ReceivedMessages<coordination::Prediction>& received);
  /// The result of `plan`.
  [[nodiscard]] const coordination::Prediction& prediction() const { return step_.prediction; }
  /// After `plan`: the prediction that it was given of this vehicle does not count as received, so
  /// that `commit` checks the plan against the vehicle.
  void disregard(VehicleId vehicle) { step_.respected.erase(vehicle); }
  /// Fourth phase, for a commit rule that needs votes: what the others need to know before they
  /// commit.
  [[nodiscard]] coordination::Outcome vote() const;
  /// Last phase. Needs the predictions of `coupled`, or the outcomes of `component` for a commit
  /// rule that needs votes.
  [[nodiscard]] coordination::Report commit(
      const coordination::ReceivedMessages<coordination::Prediction>& predictions,
      const coordination::ReceivedMessages<coordination::Outcome>& outcomes);
  /// Instead of the remaining phases: a deadline has passed, the plan in force stays.
  [[nodiscard]] coordination::Report fall_back(coordination::FallbackReason reason);

  /// After the last phase of every step, once the command is published: enters in the step's report
  /// which vehicles kept the new plan from coming into force (blocked_by.hpp), for which this one
  /// waits (waits_for.hpp), and since when, or since when it is at its goal: there it waits for
  /// none. Changes no plan. Searches once if the plan in force stands or no plan was found. In a
  /// late step the waiting of the step before lasts.
  void note_causes(coordination::Report& report);
  /// Likewise: enters Report::bound_m2. Searches once if the vehicle has planned around the new
  /// plans of others, with the budget of a search that makes room.
  void note_bound(coordination::Report& report);

  /// Valid after `couple`: the senders that the phases need.
  [[nodiscard]] const std::vector<VehicleId>& predecessors() const { return step_.predecessors; }
  [[nodiscard]] const std::vector<VehicleId>& coupled() const { return step_.report.coupled; }
  [[nodiscard]] const std::vector<VehicleId>& component() const { return step_.component; }
  [[nodiscard]] const std::vector<VehicleId>& missing() const { return step_.report.missing; }
  [[nodiscard]] const coordination::CouplingGraph& coupling() const { return *step_.coupling; }
  /// In which order the vehicles of the component plan in this step.
  [[nodiscard]] const coordination::PriorityOrder& plans_before() const {
    return step_.plans_before;
  }
  /// Traffic of this step of a vehicle of the component, its own included.
  [[nodiscard]] const coordination::Traffic& traffic_of(VehicleId vehicle) const {
    return vehicle == options_.vehicle ? step_.traffic : neighbours_.traffic_of(vehicle);
  }
  /// What `plan` searched (PlanCandidate::problems): none if it did not get that far. Valid until
  /// the next step.
  [[nodiscard]] std::span<const SearchedProblem> problems() const {
    return step_.candidate.problems;
  }
  /// The problems before those, when the vehicle stands and is to drive off: they determine the
  /// area in which it may drive (lane_entry.hpp). Their vertices are not counted.
  [[nodiscard]] std::span<const search::HorizonProblem> entry_problems() const {
    return step_.entry_problems;
  }

  /// After the last phase of a step in which `plan` searched: the best plan without these limits,
  /// given the same messages; of equal ones that in force. Without any left out: what it did find,
  /// if its budget sufficed. Changes nothing.
  /// @param on  instead of the subgraph in force; prepared as for `switch_to`
  /// @pre `problems` is not empty
  [[nodiscard]] PlanWithout plan_without(const LeftOut& left_out) const;
  [[nodiscard]] PlanWithout plan_without(const LeftOut& left_out, const PreparedSubgraph& on) const;
  /// Those that `Authority::withheld_by` names; none without right of way.
  [[nodiscard]] std::vector<VehicleId> road_withheld_by() const {
    return authority_ ? authority_->withheld_by() : std::vector<VehicleId>{};
  }
  /// Whether the end of an authority limits plans.
  [[nodiscard]] bool has_authority() const { return authority_.has_value(); }

  /// The permitted routes.
  [[nodiscard]] const std::vector<road::DrivableRoute>& routes() const { return tracker_.routes(); }
  /// The selected route; before the first measurement the first of all.
  [[nodiscard]] const road::DrivableRoute& route() const { return tracker_.route(); }
  /// Placement on the route in the last `stand_by` with a measurement, or in `change_route`.
  [[nodiscard]] const std::optional<road::Placement>& placement() const {
    return tracker_.placement();
  }
  /// True if there is a placement and it fits. @see fits
  [[nodiscard]] bool fits_route() const { return tracker_.fits_route(); }
  /// Arc length on the route where planning began in the last step, or where the vehicle was
  /// placed.
  [[nodiscard]] const std::optional<double>& path_s_m() const { return tracker_.s_m(); }
  /// Arc length of a position within the vehicle's reach in a horizon from there; none if the
  /// vehicle has no place on its path.
  [[nodiscard]] std::optional<double> path_s_m_of(const Point& position_m) const;
  /// The area in which the vehicle enters its lanes (lane_entry.hpp), while it does.
  [[nodiscard]] const std::optional<road::Corridor>& entry_area() const {
    return drivable_area_.entry_area();
  }

  /// The announced motion of another vehicle from the next step on: its new plan, if this
  /// controller received it and had to wait for it, otherwise its former one.
  struct AnnouncedPlan {
    VehicleId vehicle;
    coordination::OccupiedAreas areas;  ///< from the last step on, or from the next
  };
  /// Of all vehicles received in the last step, by vehicle. Valid after `commit` or `fall_back`.
  /// Independent of which other messages arrived in time.
  [[nodiscard]] std::vector<AnnouncedPlan> announced_plans() const;

  [[nodiscard]] bool has_plan() const { return in_force_.has_value(); }
  /// The vehicle was measured in the last step.
  [[nodiscard]] bool is_vehicle_seen() const { return measured_vehicle() != nullptr; }
  /// As measured in the last step; nullptr: it was not.
  [[nodiscard]] const coordination::MeasuredVehicle* measured_vehicle() const {
    return step_.observation.measured(options_.vehicle);
  }
  /// In the last step the vehicle was to be sent nothing (rule 5 of plan_in_force.hpp).
  [[nodiscard]] bool is_vehicle_lost() const { return step_.is_vehicle_lost; }
  /// In the last step the vehicle was so far from its plan that it was to be sent nothing (rule 6).
  [[nodiscard]] bool is_vehicle_elsewhere() const { return step_.is_vehicle_elsewhere; }
  /// Nobody was received in the last step: the vehicle does not drive off (missing.hpp).
  [[nodiscard]] bool is_cut_off() const { return neighbours_.is_cut_off(options_.horizon_steps); }
  [[nodiscard]] const coordination::Plan& plan_in_force() const { return in_force_->plan(); }

 private:
  /// All data of one step; reset by `observe`.
  struct Step {
    Observation observation;
    coordination::Report report;
    coordination::Traffic traffic;  ///< own
    std::optional<coordination::CouplingGraph> coupling;
    coordination::PriorityOrder plans_before;
    std::vector<VehicleId> predecessors;
    std::vector<VehicleId> component;
    std::vector<search::HorizonProblem> entry_problems;
    LeftOut left_out;  ///< of its problem
    /// Predictions that the search took into account
    std::map<VehicleId, std::shared_ptr<const coordination::Prediction>> respected;
    /// Those of other coupled vehicles, received when this one committed
    std::map<VehicleId, std::shared_ptr<const coordination::Prediction>> awaited;
    PlanCandidate candidate;
    double cost_m2{};  ///< of the candidate's first search, with the whole reference
    coordination::Prediction prediction;      ///< own; of a candidate its areas, from t(k+1) on
    std::vector<VehicleId> opposed;           ///< voted against the plan, or did not vote
    coordination::FallbackReason obstacle{};  ///< why nothing new may be planned
    std::optional<double> former_end_s_m;     ///< of the plan in force as `plan` began
    bool is_vehicle_lost{};
    bool is_vehicle_elsewhere{};
    bool is_disturbed{};                         ///< DeviationCheck
    std::shared_ptr<const Coupled> before_plan;  ///< of `keep_plan`; null: none is kept

    [[nodiscard]] StepIndex next() const { return {observation.step.value + 1}; }
  };

  void report_plan_in_force(coordination::Report& report) const;
  [[nodiscard]] ConvexPolygon reachable_area_m() const;
  void depart_from(const Pose& pose);
  [[nodiscard]] std::optional<coordination::PlanningInput> planning_input() const;
  void take_coupling(const coordination::CouplingGraph& graph,
                     const coordination::PriorityOrder& plans_before);
  [[nodiscard]] std::vector<ConvexPolygon> reference_areas_m() const;
  [[nodiscard]] bool may_plan() const;
  void extend_authority(SharedStep& shared);
  void respect_predecessors(
      const coordination::ReceivedMessages<coordination::Prediction>& received);
  [[nodiscard]] bool has_kept_plan_for(
      const coordination::ReceivedMessages<coordination::Prediction>& received) const;
  void drop_kept_plan();
  void check_start();
  [[nodiscard]] double reach_m() const { return search_.reach_m(step_.traffic.next_trim); }
  [[nodiscard]] search::HorizonProblem problem_in(const road::Corridor& corridor,
                                                  const ReferenceEnd& end = {}) const;
  void update_drivable_area();
  [[nodiscard]] LaneEntry find_lane_entry();
  [[nodiscard]] search::HorizonProblem posed_alone(const ReferenceEnd& end = {}) const;
  [[nodiscard]] search::HorizonProblem pose_problem(CoupledObstacleRule rule) const;
  [[nodiscard]] CoupledVehicle coupled_vehicle(VehicleId other) const;
  [[nodiscard]] MissingVehicle missing_vehicle(VehicleId other) const;
  [[nodiscard]] std::vector<std::vector<ConvexPolygon>> obstacles_m(
      std::span<const CoupledVehicle> coupled_vehicles, CoupledObstacleRule rule,
      std::span<const MissingVehicle> missing) const;
  [[nodiscard]] std::vector<std::vector<ConvexPolygon>> obstacles_m(CoupledObstacleRule rule) const;
  void note_arrival(coordination::Report& report);
  void note_opposed(const coordination::ReceivedMessages<coordination::Outcome>& outcomes);
  [[nodiscard]] coordination::Plan plan_of(
      const std::vector<const automaton::Maneuver*>& maneuvers) const;
  [[nodiscard]] std::optional<MotionAlone> motion_alone();
  [[nodiscard]] OtherVehicle as_obstacle(VehicleId coupled) const;
  [[nodiscard]] std::vector<OtherVehicle> other_vehicles() const;
  void search_candidate();
  bool find_candidate(const search::HorizonProblem& problem, std::size_t budget_share);
  void search_plan(search::HorizonProblem problem, std::size_t budget_share);
  [[nodiscard]] PlanWithout search_again(const LeftOut& left_out);
  bool ends_where_permitted(const coordination::Plan& plan, const search::HorizonProblem& in);
  void find_nearer_end(const search::HorizonProblem& problem, std::size_t budget_share);
  void keep_in_lane_where_held_up(const search::HorizonProblem& problem, std::size_t budget_share);
  [[nodiscard]] bool makes_room_for(const CoupledVehicle& other) const;
  [[nodiscard]] bool make_room(const search::HorizonProblem& own);
  [[nodiscard]] std::optional<coordination::OccupiedAreas> desired_areas();
  void note_awaited(const coordination::ReceivedMessages<coordination::Prediction>& predictions);
  [[nodiscard]] std::optional<coordination::CoupledAreas> compared_areas(VehicleId coupled) const;
  [[nodiscard]] coordination::CommitVerdict decide(
      const coordination::ReceivedMessages<coordination::Outcome>& outcomes) const;
  [[nodiscard]] coordination::Certificate certificate(bool is_new) const;
  [[nodiscard]] std::vector<coordination::Separation> separations(
      const coordination::OccupiedAreas& own) const;
  [[nodiscard]] coordination::Report finish(bool accepted, coordination::FallbackReason reason);

  ControllerOptions options_;
  CandidateSearch search_;
  RouteTracker tracker_;
  DrivableArea drivable_area_;
  Neighbours neighbours_;
  std::vector<ConvexPolygon> standing_m_;  ///< obstacles that are no vehicles
  std::optional<PlanInForce> in_force_;
  std::optional<Authority> authority_;  ///< none: no right of way
  bool minimal_risk_stop_{false};
  bool is_agreed_{false};  ///< Certificate::is_agreed, of the plan in force
  Step step_;
  std::optional<search::HorizonProblem> former_problem_;  ///< for `warm_up`
  coordination::Waiting waiting_;                         ///< in the last step
  std::uint32_t standing_steps_{};                        ///< Traffic::standing_steps
  std::uint64_t routes_digest_;
};

/// For its controller only.
class Controller::Coupled {
  friend class Controller;
  Coupled(Step step, RouteTracker tracker, DrivableArea drivable_area)
      : step_(std::move(step)),
        tracker_(std::move(tracker)),
        drivable_area_(std::move(drivable_area)) {}

  Step step_;
  RouteTracker tracker_;
  DrivableArea drivable_area_;
};

}  // namespace hlc::controller
