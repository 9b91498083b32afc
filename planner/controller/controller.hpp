#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/controller/joining.hpp"
#include "planner/controller/plan_in_force.hpp"
#include "planner/controller/prepared_subgraph.hpp"
#include "planner/coordination/coupling.hpp"
#include "planner/coordination/messages.hpp"
#include "planner/coordination/missing.hpp"
#include "planner/coordination/plan.hpp"
#include "planner/coordination/report.hpp"
#include "planner/coordination/settle.hpp"
#include "planner/road/corridor.hpp"
#include "planner/road/placement.hpp"
#include "planner/road/reference_path.hpp"
#include "planner/road/reference_points.hpp"
#include "planner/search/search_engine.hpp"
#include "planner/vehicle/lab_limits.hpp"

namespace hlc {

struct ControllerOptions {
  VehicleId vehicle;
  std::size_t horizon_steps{8};
  double reference_speed_mps{0.8};
  ReferenceRule reference_rule{half_speed_last};
  SettleRule settle_rule{SettleRule::kStrict};
  SearchOptions search;
  DeviationRules deviation;
  /// What the vehicle can follow: a plan beyond it does not come into force. Absent: anything.
  std::optional<LabLimits> lab;
};

/// What a state list tells a controller at step k.
struct Observation {
  StepIndex step;                       ///< k
  std::vector<VehicleId> active;        ///< vehicles that take part, this one included
  std::vector<MeasuredVehicle> states;  ///< of the vehicles that have a usable one
  /// Vehicles whose controller's process is still there, heard or not (see missing.hpp).
  std::vector<VehicleId> present;
};

/// The high-level controller of one vehicle, as a pure state machine: no clock, no thread, no
/// waiting.
///
/// One control step is the sequence
///
///     observe -> couple -> plan -> vote -> settle
///
/// Between the calls the owner sends what the last one returned and waits, until a deadline, for
/// the messages that the next one needs; each call works with whatever has arrived. A vehicle that
/// said nothing is missing and may be anywhere in its reachable set. After `settle` the plan in
/// force holds from t(k) on.
///
/// The plan of step k is for what happens from t(k+1) on: the search starts where the plan in force
/// will be then. If no new plan comes into force, the one in force stays: every plan ends in
/// standstill. What is done where the vehicle is not on its plan: plan_in_force.hpp.
///
/// The vehicle starts from where it stands. Of the routes that it may take it takes the one that it
/// fits best, from its place there on (placement.hpp); beside its lanes it drives in an area that
/// leads into them (joining.hpp). So does one that has come to stand in its lanes, by a fallback or
/// a change of its subgraph, where nothing that stays in them leads on: it is looked at anew after
/// every horizon in which it stood (not with the cost-to-go of 2022). A vehicle that fits none, or
/// cannot get onto its route, stands and says so in its report.
class Controller {
 public:
  /// @param routes  those that the vehicle may take, at least one
  Controller(ControllerOptions options, std::shared_ptr<const Subgraph> subgraph,
             std::vector<DrivableRoute> routes);
  /// With a single route.
  /// @param path      what the vehicle shall follow
  /// @param corridor  where it may drive
  Controller(ControllerOptions options, std::shared_ptr<const Subgraph> subgraph,
             ReferencePath path, Corridor corridor);

  /// A controller in the same state that goes its own way from here: for looking ahead. Shares only
  /// what never changes. Not in the middle of a step.
  /// @param max_expansions  of its searches; none: as here
  [[nodiscard]] std::unique_ptr<Controller> clone(
      std::optional<std::size_t> max_expansions = {}) const;

  [[nodiscard]] const ControllerOptions& options() const { return options_; }
  [[nodiscard]] const Subgraph& subgraph() const { return *on_.subgraph; }
  /// The same with its tables, to be kept.
  [[nodiscard]] const PreparedSubgraph& prepared_subgraph() const { return on_; }
  /// Step of the last `observe` or `stand_by`.
  [[nodiscard]] StepIndex last_step() const { return step_.observation.step; }

  /// From the next step on plans on another subgraph, of the same automaton or of one that differs
  /// from it in its maneuvers alone. Not in the middle of a step. The plan in force stays, whatever
  /// of it is off now, and is the fallback as ever: see Subgraph for the rule. Where no plan is
  /// found from where the plan in force leads (the way off what is off now leads into something),
  /// the former subgraph is planned on, until something is, for a horizon at most. The other
  /// vehicles need not switch in the same step: where a missing one may be is reckoned with the
  /// highest speed of the whole automaton that was given at first.
  /// @pre `next` was prepared for this controller's horizon and search; its subgraph is of the same
  /// vehicle, step and trims, and on it nothing is faster than that
  void switch_to(const PreparedSubgraph& next);
  /// The same, prepared here and now.
  void switch_to(std::shared_ptr<const Subgraph> next);

  /// A step before the start: the plan in force is to stand at the measured pose. Without a
  /// measurement of the own vehicle the former plan, if any, stays.
  [[nodiscard]] Report stand_by(const Observation& observation);

  /// From the next step on nothing new is planned, and the plan in force is driven to its end; or
  /// planning goes on, from what is left of it.
  void set_drives_out(bool drives_out) { drives_out_ = drives_out; }

  /// First phase. @pre a plan is in force (see `has_plan`), observation.step has increased
  [[nodiscard]] Traffic observe(const Observation& observation);
  /// Any time between the first phase and the third, by whoever waits for the others' messages
  /// then: searches what the former step's problem has become, as far as that is known without
  /// them, and forgets what is found. Changes nothing; but a processor that did other things since
  /// has in its caches again what a search needs, which takes longer to fetch than most searches.
  /// Ends after 1024 expansions. Returns how many there were.
  std::uint64_t warm_up();
  /// Second phase. `heard` may hold messages of other steps and senders: they are ignored.
  void couple(std::span<const Traffic> heard);
  /// Third phase. Needs the predictions of `predecessors`. Poses the problem, searches, predicts
  /// the drift, checks what was found, and searches again if the drift leads into something:
  /// planning time is the time that all this takes.
  [[nodiscard]] Prediction plan(std::span<const Prediction> heard);
  /// Fourth phase, settle rule `agreed` only: what the others need to know before they settle.
  [[nodiscard]] Outcome vote() const;
  /// Last phase. Needs the predictions of `coupled` (strict) or the outcomes of `component`
  /// (agreed).
  [[nodiscard]] Report settle(std::span<const Prediction> predictions,
                              std::span<const Outcome> outcomes);
  /// Instead of the phases that are left: a deadline has passed, the plan in force stays.
  [[nodiscard]] Report give_up(FallbackReason reason);

  /// Valid after `couple`: whom the phases need.
  [[nodiscard]] const std::vector<VehicleId>& predecessors() const { return step_.predecessors; }
  [[nodiscard]] const std::vector<VehicleId>& coupled() const { return step_.coupled; }
  [[nodiscard]] const std::vector<VehicleId>& component() const { return step_.component; }
  /// The problems that `plan` gave to the search, in order: none if it did not come to that, two if
  /// the first plan would have drifted into something, after a switch perhaps more. Valid until the
  /// next step.
  [[nodiscard]] std::span<const HorizonProblem> problems() const { return step_.problems; }
  /// Before them, where the vehicle stands and shall drive off: those by which it was found out
  /// where it may drive (joining.hpp). Their vertices count nowhere.
  [[nodiscard]] std::span<const HorizonProblem> joining_problems() const {
    return step_.joining_problems;
  }

  /// Those that the vehicle may take.
  [[nodiscard]] const std::vector<DrivableRoute>& routes() const { return *routes_; }
  /// The route taken; before the first measurement the first of all.
  [[nodiscard]] const DrivableRoute& route() const { return (*routes_)[route_]; }
  /// Where the vehicle stood on it in the last `stand_by` that saw it.
  [[nodiscard]] const std::optional<Placement>& placement() const { return placement_; }
  /// True if it did, and fits. @see fits
  [[nodiscard]] bool fits_route() const { return placement_ && fits(*placement_, route()); }
  /// Arc length on it where planning began in the last step, or where the vehicle was placed.
  [[nodiscard]] const std::optional<double>& path_s_m() const { return path_s_m_; }
  /// Arc length of a position that the vehicle may get to within a horizon from there; none if it
  /// has no place on its path.
  [[nodiscard]] std::optional<double> path_s_m_of(const Point& position_m) const;
  /// The area in which it comes into its lanes (joining.hpp), while it does.
  [[nodiscard]] const std::optional<Corridor>& joining_area() const { return joining_.area; }

  /// What another vehicle drives from the next step on, as it has told: its new plan, if this one
  /// heard of it and had to wait for it, else the one that it drove before.
  struct ToldPlan {
    VehicleId vehicle;
    OccupiedAreas areas;  ///< from the last step on, or from the next
  };
  /// Of all that were heard in the last step, by vehicle. Valid after `settle` or `give_up`. It
  /// does not depend on what else came in time.
  [[nodiscard]] std::vector<ToldPlan> told_plans() const;

  [[nodiscard]] bool has_plan() const { return in_force_.has_value(); }
  [[nodiscard]] const Plan& plan_in_force() const { return in_force_->plan(); }

 private:
  /// All that one step gathers; reset by `observe`.
  struct Step {
    Observation observation;
    Report report;
    Traffic traffic;                     ///< own
    std::map<VehicleId, Traffic> heard;  ///< of this step
    std::vector<VehicleId> coupled;
    std::vector<VehicleId> predecessors;
    std::vector<VehicleId> component;
    std::vector<HorizonProblem> joining_problems;
    std::vector<HorizonProblem> problems;        ///< the last is the one to solve
    std::map<VehicleId, Prediction> respected;   ///< predictions that the search took into account
    std::map<VehicleId, OccupiedAreas> settled;  ///< new plans of other coupled vehicles
    std::optional<Plan> candidate;
    std::optional<Plan> replaced;  ///< in force before; keeps the maneuvers of `problems`
    Prediction prediction;         ///< own; of a candidate its areas, from t(k+1) on
    FallbackReason obstacle{FallbackReason::kNone};  ///< why nothing new may be planned
  };

  /// What was planned on before a switch.
  struct Former {
    PreparedSubgraph on;
    std::unique_ptr<SearchEngine> engine;
    StepIndex last;  ///< of the steps that may still use it
  };

  Controller(ControllerOptions options, PreparedSubgraph on,
             std::shared_ptr<const std::vector<DrivableRoute>> routes);

  void say_what_is_in_force(Report& report) const;
  void take_route(const Pose& measured);
  void look_at_lanes();
  [[nodiscard]] bool has_rested_for_long();
  [[nodiscard]] double project(const Point& position_m) const;
  [[nodiscard]] double reach_m() const;
  [[nodiscard]] static PlanQuality quality_of(SearchStatus found);
  void search_candidate(StepIndex next, SearchEngine& engine, const Subgraph& on);
  void find_candidate(StepIndex next, SearchEngine& engine, const Subgraph& on);
  void plan_on_former(StepIndex next);
  [[nodiscard]] bool is_candidate_free() const;
  [[nodiscard]] bool is_candidate_drivable() const;
  const Traffic& note_heard(const Traffic& message);
  void note_who_lives();
  void note_who_stands();
  [[nodiscard]] const MeasuredVehicle* measured(VehicleId vehicle) const;
  [[nodiscard]] HorizonProblem pose_problem();
  [[nodiscard]] HorizonProblem problem_alone(const Corridor& corridor) const;
  [[nodiscard]] std::vector<const Maneuver*> incumbent() const;
  void add_coupled_obstacles(HorizonProblem& problem) const;
  void add_missing_obstacles(HorizonProblem& problem) const;
  void note_settled(std::span<const Prediction> predictions);
  [[nodiscard]] SettleVerdict strict_verdict(std::span<const Prediction> predictions) const;
  [[nodiscard]] SettleVerdict agreed_verdict(std::span<const Outcome> outcomes) const;
  [[nodiscard]] Report finish(bool accepted, FallbackReason reason);

  ControllerOptions options_;
  PreparedSubgraph on_;
  std::shared_ptr<const std::vector<DrivableRoute>> routes_;
  std::unique_ptr<SearchEngine> engine_;
  std::optional<Former> former_;  ///< until something was found on what is planned on now
  const Maneuver* standstill_;
  MissingVehicleRules missing_rules_;

  std::optional<PlanInForce> in_force_;
  std::size_t route_{};  ///< index of the one taken
  std::optional<Placement> placement_;
  std::optional<double> path_s_m_;  ///< where the vehicle was on its path
  Joining joining_;
  bool sets_out_{false};  ///< stands where it was measured, and has not been looked at yet
  std::optional<StepIndex> rests_since_;  ///< while the plan in force is to stay where it is
  std::map<VehicleId, StepIndex> last_heard_;
  std::map<VehicleId, StepIndex>
      last_sign_of_life_;  ///< last step in which it was heard or present
  std::map<VehicleId, StepIndex> last_not_standing_;
  bool drives_out_{false};
  Step step_;
  std::map<VehicleId, Traffic> former_heard_;     ///< a step ago; only its memory is of use
  std::optional<HorizonProblem> former_problem_;  ///< for `warm_up`
};

}  // namespace hlc
