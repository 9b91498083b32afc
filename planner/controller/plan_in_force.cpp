#include "planner/controller/plan_in_force.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/automaton/deviation.hpp"
#include "planner/controller/command_time.hpp"
#include "planner/coordination/plan_by_index.hpp"
#include "planner/vehicle/lab_limits.hpp"

namespace hlc::controller {
namespace {

/// Share of the safety margin that is reserved for the error of a one-step prediction.
constexpr double kUnderWayShare = 0.2;

std::vector<bool> trims_at_limit(const automaton::UniversalAutomaton& automaton) {
  std::vector<bool> is_at_limit;
  for (const automaton::Trim& trim : automaton.trims) {
    is_at_limit.push_back(
        automaton::is_at_steering_limit(trim, automaton.vehicle, automaton.identified));
  }
  return is_at_limit;
}

/// Adds `more` to `areas`, step by step. @pre more.first <= areas.first
void cover(const coordination::OccupiedAreas& more, coordination::OccupiedAreas& areas) {
  const auto add = [](const ConvexPolygon& one, ConvexPolygon& area) {
    area = convex_hull(std::vector{area, one});
  };
  for (std::size_t i = 0; i < areas.areas_m.size(); ++i) {
    add(more.during({areas.first.value + i}), areas.areas_m[i]);
  }
  add(more.final_area_m, areas.final_area_m);
}

}  // namespace

PlanInForce::PlanInForce(std::shared_ptr<const automaton::UniversalAutomaton> automaton,
                         const automaton::Maneuver& standstill, DeviationRules rules,
                         std::size_t horizon_steps, const Pose& measured, StepIndex step)
    : automaton_(std::move(automaton)),
      standstill_(&standstill),
      rules_(rules),
      is_at_limit_(trims_at_limit(*automaton_)),
      plan_(step,
            automaton::pose_of_measured(measured, 0.0, automaton_->vehicle, automaton_->identified),
            standstill, automaton_),
      announced_(plan_.areas_from(step)),
      replaced_(drivable_steps(horizon_steps, automaton_->step_s)),
      seen_{.step = step, .time_s = 0.0, .pose = measured} {}

PlanInForce::PlanInForce(std::shared_ptr<const automaton::UniversalAutomaton> automaton,
                         const automaton::Maneuver& standstill, DeviationRules rules,
                         coordination::Plan base, const coordination::PlanningInput& input)
    : automaton_(std::move(automaton)),
      standstill_(&standstill),
      rules_(rules),
      is_at_limit_(trims_at_limit(*automaton_)),
      plan_(std::move(base)),
      seen_{.step = input.seen_step, .time_s = input.seen_time_s, .pose = input.seen_pose},
      deviation_m_(input.deviation_m) {
  if (input.is_moved) moved_ = plan_;
}

std::optional<coordination::PlanningInput> PlanInForce::planning_input(
    StepIndex now, const automaton::UniversalAutomaton& automaton) const {
  // A new plan keeps two steps before its own first one (Plan::continued).
  std::optional<coordination::PlanByIndex> base =
      coordination::by_index(this->base(), {std::max<std::uint64_t>(now.value, 1) - 1}, automaton);
  if (!base) return std::nullopt;
  return coordination::PlanningInput{.base = *std::move(base),
                                     .is_moved = is_moved(),
                                     .seen_step = seen_.step,
                                     .seen_time_s = seen_.time_s,
                                     .seen_pose = seen_.pose,
                                     .deviation_m = deviation_m_};
}

DeviationCheck PlanInForce::check_deviation(const coordination::MeasuredVehicle* own,
                                            StepIndex now) {
  const vehicle::VehicleParameters& vehicle = automaton_->vehicle;
  moved_.reset();
  outside_area_m_ = {};
  is_beside_ = false;
  deviation_m_ = 0.0;
  if (own == nullptr) {  // the vehicle's position is unknown: it may stand anywhere on its plan
    moved_ = plan_;
    is_lost_ = true;
    note_outside(seen_.pose, seen_speed_mps_, now);
    return {.deviation_m = 0.0, .is_disturbed = true, .is_lost = true};
  }
  replaced_.forget(now);
  seen_speed_mps_ = own->speed_mps;
  const SeenAt seen = seen_at(*own, now, automaton_->step_s);
  seen_ = {.step = now, .time_s = 0.0, .pose = own->pose};
  if (seen.step < plan_.first()) return {};  // just anchored at its measured pose
  seen_ = seen;
  if (is_lost_) return_to_driven_plan(now);
  const vehicle::State planned = plan_.state_at(seen_.step, seen_.time_s, vehicle);
  deviation_m_ = deviation_from(plan_);
  const double off_m = (own->pose.position_m() - planned.pose.position_m()).norm();
  const bool is_outside =
      deviation_m_ > vehicle.safety_margin_m && !is_inside_announced(own->pose, seen_.step);
  const bool is_disturbed = is_outside && deviation_m_ > rules_.tracking_error_max_m;
  is_beside_ = is_outside && !is_disturbed;
  is_lost_ = is_lost_ && is_disturbed;
  const DeviationCheck result{.deviation_m = deviation_m_,
                              .is_disturbed = is_disturbed,
                              .is_lost = is_lost_,
                              .is_elsewhere = is_disturbed && off_m > vehicle::kStopBound_m};
  const double reanchor_m =
      std::max(rules_.reanchor_share * vehicle.safety_margin_m, rules_.tracking_error_max_m);
  if (!is_disturbed && off_m <= reanchor_m) return result;
  if (is_disturbed && stands_at_end()) {
    anchor_at(own->pose, now);
    return {.deviation_m = deviation_m_, .is_disturbed = false, .is_reanchored = true};
  }
  moved_ = plan_.moved(planned.pose, automaton::pose_of_measured(own->pose, planned.steering_rad,
                                                                 vehicle, automaton_->identified));
  if (!is_disturbed && !stays_inside_announced(*moved_, now)) moved_.reset();
  if (is_disturbed) note_outside(own->pose, own->speed_mps, now);
  return result;
}

/// At the last sight: the plan has run out, and the vehicle does not move.
bool PlanInForce::stands_at_end() const {
  return plan_.end() <= seen_.step &&
         std::abs(seen_speed_mps_) <= coordination::MissingVehicleRules{}.standing_speed_mps;
}

/// The vehicle stands where its plan did not lead.
void PlanInForce::anchor_at(const Pose& pose, StepIndex now) {
  ReplacedPlans replaced = std::move(replaced_);
  const double deviation_m = deviation_m_;
  constexpr std::size_t kAnyHorizon = 0;  // matters to replaced plans only
  *this = PlanInForce(automaton_, *standstill_, rules_, kAnyHorizon, pose, now);
  replaced_ = std::move(replaced);
  deviation_m_ = deviation_m;
}

/// At the last sight.
double PlanInForce::deviation_from(const coordination::Plan& plan) const {
  const vehicle::State planned = plan.state_at(seen_.step, seen_.time_s, automaton_->vehicle);
  return automaton::footprint_deviation_m(seen_.pose, planned, automaton_->vehicle,
                                          automaton_->identified);
}

void PlanInForce::return_to_driven_plan(StepIndex now) {
  const double margin_m = automaton_->vehicle.safety_margin_m;
  if (deviation_from(plan_) <= margin_m) return;
  for (const ReplacedPlans::Former* former : replaced_.doubtful()) {
    const bool was_in_force =
        former->plan.first() <= seen_.step && former->announced.first <= seen_.step;
    if (!was_in_force || deviation_from(former->plan) > margin_m) continue;
    const coordination::Plan driven = former->plan;
    const coordination::OccupiedAreas announced = former->announced;
    replaced_.add(std::exchange(plan_, driven), std::exchange(announced_, announced), now);
    return replaced_.doubt(now);
  }
}

void PlanInForce::note_outside(const Pose& pose, double speed_mps, StepIndex now) {
  const double steering_rad =
      plan_.state_at(seen_.step, seen_.time_s, automaton_->vehicle).steering_rad;
  outside_area_m_ = braking_area(pose, speed_mps, steering_rad, *automaton_);
  replaced_.doubt(now);
}

/// True if the footprint lies in the area announced for that step.
bool PlanInForce::is_inside_announced(const Pose& measured, StepIndex step,
                                      double reserve_m) const {
  if (step < announced_.first) return false;
  const Footprint& footprint = automaton_->vehicle.footprint;
  const ConvexPolygon area = footprint_area(footprint, measured, reserve_m);
  return contains(announced_.during(step), area);
}

/// True if a vehicle that follows `plan` from now on stays in the area announced for the current
/// step.
bool PlanInForce::stays_inside_announced(const coordination::Plan& plan, StepIndex now) const {
  const double reserve_m = kUnderWayShare * automaton_->vehicle.safety_margin_m;
  const std::vector<PredictedInstant> drive =
      predicted_drive(plan, seen_, {now.value + 1}, *automaton_);
  return std::ranges::all_of(drive, [&](const PredictedInstant& instant) {
    return instant.step != now || is_inside_announced(instant.pose, now, reserve_m);
  });
}

/// `way` and the areas in which a disturbed vehicle can be during the step.
ConvexPolygon PlanInForce::with_step(ConvexPolygon way, StepIndex step) const {
  std::vector<ConvexPolygon> areas{std::move(way)};
  const auto add = [&](const coordination::Plan& plan,
                       const coordination::OccupiedAreas& announced) {
    if (step < announced.first || step < plan.first()) return;
    areas.push_back(driven_or_braked_area(plan, announced, step, *automaton_));
  };
  for (const ReplacedPlans::Former* one : replaced_.doubtful()) add(one->plan, one->announced);
  if (!outside_area_m_.empty()) {
    add(plan_, announced_);
    if (step >= moved_->first()) add(*moved_, moved_->areas_from(step));
  }
  return convex_hull(areas);
}

/// The areas of the other plans that may be driven grow from step to step: the vehicle may have
/// stopped anywhere on the way.
coordination::OccupiedAreas PlanInForce::announced_areas(StepIndex from) const {
  const std::vector<const ReplacedPlans::Former*> former = replaced_.doubtful();
  StepIndex end = plan_.end();
  for (const ReplacedPlans::Former* one : former) end = std::max(end, one->plan.end());
  coordination::OccupiedAreas areas{
      .first = from, .areas_m = {}, .final_area_m = announced_.final_area_m};
  if (from < end) areas.areas_m.reserve(end.value - from.value);
  for (StepIndex step = from; step < end; ++step.value) {
    areas.areas_m.push_back(announced_.during(step));
  }
  if (is_beside_) cover(areas_of(plan_, from), areas);
  if (outside_area_m_.empty() && former.empty()) return areas;
  ConvexPolygon way = outside_area_m_;
  for (StepIndex step = seen_.step; step < from; ++step.value) {
    way = with_step(std::move(way), step);
  }
  for (StepIndex step = from; step < end; ++step.value) {
    way = with_step(std::move(way), step);
    ConvexPolygon& area = areas.areas_m[step.value - from.value];
    area = convex_hull(std::vector{area, way});
  }
  areas.final_area_m = convex_hull(std::vector{areas.final_area_m, with_step(std::move(way), end)});
  return areas;
}

double PlanInForce::tolerated_m() const {
  return rules_.tolerated_drift_share * automaton_->vehicle.safety_margin_m;
}

bool PlanInForce::may_drift(const coordination::Plan& candidate) const {
  if (deviates()) return true;
  for (StepIndex step = seen_.step; step <= candidate.end(); ++step.value) {
    if (is_at_limit_[candidate.trim_at(step).index]) return true;
  }
  return false;
}

coordination::OccupiedAreas PlanInForce::areas_of(const coordination::Plan& candidate,
                                                  StepIndex next) const {
  if (!may_drift(candidate)) return candidate.areas_from(next);
  return areas_with_drift(candidate, next, seen_, *automaton_, tolerated_m());
}

void PlanInForce::replace(coordination::Plan candidate, const coordination::OccupiedAreas& areas,
                          StepIndex now) {
  coordination::OccupiedAreas announced{
      .first = now, .areas_m = {}, .final_area_m = areas.final_area_m};
  announced.areas_m.reserve(1 + areas.areas_m.size());
  announced.areas_m.push_back(announced_.during(now));
  announced.areas_m.insert(announced.areas_m.end(), areas.areas_m.begin(), areas.areas_m.end());
  replaced_.add(std::exchange(plan_, std::move(candidate)),
                std::exchange(announced_, std::move(announced)), now);
}

}  // namespace hlc::controller
