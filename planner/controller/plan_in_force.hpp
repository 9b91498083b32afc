#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "planner/automaton/subgraph.hpp"
#include "planner/controller/drift.hpp"
#include "planner/controller/replaced_plans.hpp"
#include "planner/coordination/missing.hpp"
#include "planner/coordination/plan.hpp"

namespace hlc::controller {

/// What decides on the reaction to a deviation from the plan; the shares are of the safety margin.
struct DeviationRules {
  /// If the measured position deviates from the plan by more than this and by more than
  /// `tracking_error_max_m`, the next plan starts from the vehicle's real pose.
  double reanchor_share{0.5};
  /// Position error of an undisturbed vehicle (LabLimits): it vanishes by itself, faster than a
  /// plan that jumps after it would let it.
  double tracking_error_max_m{};
  /// A predicted drift (drift.hpp) up to this needs no larger areas; the rest of the margin is for
  /// the error of the prediction.
  double tolerated_drift_share{0.5};
};

/// The deviation of a vehicle from its plan, and the consequences.
struct DeviationCheck {
  double deviation_m{};       ///< footprint_deviation_m, at the time of the measurement
  bool is_disturbed{false};   ///< rule 4 below: nothing new may be planned
  bool is_reanchored{false};  ///< rule 4: the plan is to stand at the vehicle's pose
  bool is_lost{false};        ///< rule 5: no command may be sent
  bool is_elsewhere{false};   ///< rule 6: the same
};

/// The plan that a vehicle drives, the areas of it that have been announced to the others, and the
/// vehicle's real pose.
///
/// The others rely on the areas that a vehicle announces (traffic, prediction); the commit rule
/// makes the announced areas free of each other pair by pair, so it is safe if the vehicle is
/// inside its own at all times. With m the safety margin and "deviation" the footprint_deviation_m
/// of the measured pose from the plan at the time of the measurement:
///
/// 1. A swept area contains a vehicle that deviates by m at most, in position and heading together
///    (planner/automaton/deviation.hpp). Where it has steering to spare it does not deviate more:
///    measured 7.7 mm at most, m = 10 mm. The lab's vehicles do, at starts and stops: rule 4.
/// 2. The areas of a plan that may lead it farther (trims near the steering limit, or a vehicle
///    that deviates already) are those of its predicted drive to the end of the plan (drift.hpp).
///    If they meet anything, a plan without those trims is searched instead. So the old plan also
///    remains safe to its end, however many steps no new one comes into force.
/// 3. A vehicle that deviates by more than `reanchor_share` of m, and by more than undisturbed ones
///    do (`tracking_error_max_m`), plans on from its real pose: the plan in force is moved rigidly
///    onto the measured pose, and the new plan continues it. The current step has been announced
///    already, so this is done only if the predicted drive stays inside the area announced for it.
///    The new plan is a plan like any other: announced, checked, agreed.
/// 4. A vehicle that deviates by more than m and is outside the area announced for that time, or
///    that is no longer seen, was disturbed, without the others' knowledge. It plans nothing new
///    and drives its plan to the end; from this step on its traffic announces all areas in which it
///    can be, so that no other plan enters them. Once it stands, its plan is anchored where it
///    stands. Agreements that the others made before they received this cannot be revoked;
///    everything they do from then on keeps clear. One that deviates by no more than undisturbed
///    ones do (`tracking_error_max_m`) returns to its plan by itself: it plans on, and its traffic
///    announces the areas of its predicted drive, too (rule 2). The others keep clear of them from
///    then on.
///
/// 5. A vehicle that is not seen is lost until it is seen on a plan, or re-anchored. No command is
///    sent to it (in real time; in logical time none is lost): it drives the last command that it
///    has received to its end (kept alive by that command's copy), while another one would make it
///    leave that plan on an unchecked path. If it is seen on an older plan, it has missed the newer
///    ones: the older one is in force again.
///
/// 6. A disturbed vehicle farther than vehicle::kStopBound_m from its plan is *elsewhere*: from
///    there it follows no plan, so somebody moves it. No command is sent to it (in logical time one
///    without points) until it stands and its plan is anchored there, by rule 4.
///
/// Where a disturbed vehicle can be: commands may have been lost, so it may drive any plan that was
/// in force while they were and has not run out since (replaced_plans.hpp), and drop its command
/// and brake at any time. Announced for each step is therefore the hull of the areas of all these
/// plans, in that step and in those that have passed since the vehicle was last seen, with the ways
/// to brake from there; of where it was measured, and of its plan from where it really is. When the
/// vehicle is seen on its plan again, it plans on; the older plans remain announced until they
/// can no longer be driven, since states cannot distinguish plans that part later.
///
/// Invariant. Let D(k) be the plans that the vehicle may drive from t(k) on. At the begin of step
/// k, every other vehicle's plan in force is free of each plan in D(k), as far as nobody was
/// disturbed before.
///
/// Induction. Let P(k) be the plan in force after step k. Before a fault D(k) = {P(k - 1)}. Nobody
/// who receives a vehicle's states does so without it having received, before it sent them, the
/// commands of the steps before (links fail in both directions: *assumption*); a list shows states
/// of the last 0.2 s or none. So with the last sight in the list of step s, P(s - 1) was received,
/// and in the list of step s + 1 the vehicle is not seen: D(s + 1) = {P(s - 1), P(s)}. P(s - 1) is
/// what the others knew as the running plan in step s, P(s) what was predicted then; the commit
/// rule has made all that came into force in step s free of both. From step s + 1 on nothing new is
/// planned here, D does not grow, and its areas are announced: whatever comes into force elsewhere
/// is free of them.
///
/// *Limit.* If the assumption fails, commands are lost or late while states come, D(k) is larger
/// than anybody can know. One lost command leaves the vehicle on P(k - 1), of which all that is in
/// force until t(k + 2) is free; but when the next one arrives, the vehicle changes over from P(k -
/// 1) to P(k + 1) on a way that nobody has checked, as it does when a command arrives after its
/// plan has begun. Two lost in a row do harm, too, if others have planned in step k + 1 what is
/// free of P(k) and P(k + 1) but not of P(k - 1): the vehicle is seen beside its plan in the list
/// of step k + 2 at the earliest, and what came into force in step k + 1 stays if there is no way
/// around.
class PlanInForce {
 public:
  /// Standing at the pose measured at t(step). `standstill` is the equilibrium trim's self-loop;
  /// the automaton owns it.
  /// @param horizon_steps  of each plan: how long a vehicle may drive a replaced one depends on it
  PlanInForce(std::shared_ptr<const automaton::UniversalAutomaton> automaton,
              const automaton::Maneuver& standstill, DeviationRules rules,
              std::size_t horizon_steps, const Pose& measured, StepIndex step);

  /// As another controller knows it, for planning in step `now` only: it announces nothing and must
  /// not be checked or replaced.
  /// @param base  of its traffic's planning input
  PlanInForce(std::shared_ptr<const automaton::UniversalAutomaton> automaton,
              const automaton::Maneuver& standstill, DeviationRules rules, coordination::Plan base,
              const coordination::PlanningInput& input);

  [[nodiscard]] const coordination::Plan& plan() const { return plan_; }

  /// What planning in step `now` needs of it. None: its maneuvers are not all of this automaton.
  /// Valid after `check_deviation`.
  [[nodiscard]] std::optional<coordination::PlanningInput> planning_input(
      StepIndex now, const automaton::UniversalAutomaton& automaton) const;

  /// Compares the vehicle's state in the list of step `now` (nullptr: none) with the plan.
  /// @pre now does not decrease
  DeviationCheck check_deviation(const coordination::MeasuredVehicle* own, StepIndex now);

  /// The plan that a new plan continues: the plan in force, moved to the vehicle's real pose under
  /// rule 3 or 4. Valid after `check_deviation`.
  [[nodiscard]] const coordination::Plan& base() const { return moved_ ? *moved_ : plan_; }
  /// True if `base` is not the plan in force itself. Valid after `check_deviation`.
  [[nodiscard]] bool is_moved() const { return moved_.has_value(); }

  /// Areas of the plan in force from t(from) on, as the others must know them (rule 4). @pre from
  /// is the step of `check_deviation` or the next
  [[nodiscard]] coordination::OccupiedAreas announced_areas(StepIndex from) const;

  /// True if `announced_areas` are those that were announced of the plan when it came into force:
  /// the vehicle is on it, and drives no older one. Valid after `check_deviation`.
  [[nodiscard]] bool announces_only_plan() const {
    return !is_beside_ && outside_area_m_.empty() && replaced_.doubtful().empty();
  }

  /// False if a vehicle that drives `candidate`, a plan that continues `base()`, certainly stays
  /// within the margin: it is on the plan, and all trims have steering to spare. Valid after
  /// `check_deviation`.
  [[nodiscard]] bool may_drift(const coordination::Plan& candidate) const;

  /// True if the vehicle deviates by more than is tolerated: every plan that continues `base()` may
  /// drift. Valid after `check_deviation`.
  [[nodiscard]] bool deviates() const { return deviation_m_ > tolerated_m(); }

  /// Areas of a plan that continues `base()`, from t(next) on, with its drift (rule 2).
  [[nodiscard]] coordination::OccupiedAreas areas_of(const coordination::Plan& candidate,
                                                     StepIndex next) const;

  /// Puts `candidate` in force, of which `areas` from t(now + 1) on have been announced. The plan
  /// before is kept for some steps, and with it the automaton of its maneuvers.
  void replace(coordination::Plan candidate, const coordination::OccupiedAreas& areas,
               StepIndex now);

 private:
  [[nodiscard]] ConvexPolygon with_step(ConvexPolygon way, StepIndex step) const;
  [[nodiscard]] bool is_inside_announced(const Pose& measured, StepIndex step,
                                         double reserve_m = 0.0) const;
  [[nodiscard]] double deviation_from(const coordination::Plan& plan) const;
  [[nodiscard]] bool stands_at_end() const;
  void anchor_at(const Pose& pose, StepIndex now);
  void return_to_driven_plan(StepIndex now);
  void note_outside(const Pose& pose, double speed_mps, StepIndex now);
  [[nodiscard]] double tolerated_m() const;
  [[nodiscard]] bool stays_inside_announced(const coordination::Plan& plan, StepIndex now) const;

  std::shared_ptr<const automaton::UniversalAutomaton> automaton_;
  const automaton::Maneuver* standstill_;
  DeviationRules rules_;
  std::vector<bool> is_at_limit_;  ///< of each trim, is_at_steering_limit
  coordination::Plan plan_;
  coordination::OccupiedAreas announced_;  ///< announced areas of the plan, and one step before
  ReplacedPlans replaced_{0};              ///< those of a replica: none
  bool is_lost_{};

  // of the last `check_deviation`
  SeenAt seen_;  ///< the last sight
  double seen_speed_mps_{};
  double deviation_m_{};
  bool is_beside_{};                         ///< rule 4: outside its area, but not disturbed
  std::optional<coordination::Plan> moved_;  ///< the plan moved to the vehicle's real pose
  /// Where a vehicle that is disturbed was seen, and may have braked from there, with margin.
  ConvexPolygon outside_area_m_;
};

}  // namespace hlc::controller
