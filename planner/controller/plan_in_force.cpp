#include "planner/controller/plan_in_force.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/automaton/deviation.hpp"

namespace hlc {
namespace {

/// Share of the safety margin that is reserved for the error of a one-step prediction.
constexpr double kUnderWayShare = 0.2;

}  // namespace

PlanInForce::PlanInForce(std::shared_ptr<const UniversalAutomaton> automaton,
                         const Maneuver& standstill, DeviationRules rules, const Pose& measured,
                         StepIndex step)
    : automaton_(std::move(automaton)),
      standstill_(&standstill),
      rules_(rules),
      plan_(step, pose_of_measured(measured, 0.0, automaton_->vehicle, automaton_->identified),
            standstill, automaton_),
      announced_(plan_.areas_from(step)),
      last_seen_(measured),
      seen_{.step = step, .time_s = 0.0, .pose = measured} {
  for (const Trim& trim : automaton_->trims) {
    is_at_limit_.push_back(is_at_steering_limit(trim, automaton_->vehicle, automaton_->identified));
  }
}

DeviationCheck PlanInForce::check_deviation(const MeasuredVehicle* own, StepIndex now) {
  const VehicleParameters& vehicle = automaton_->vehicle;
  const double step_s = automaton_->step_s;
  moved_.reset();
  outside_area_m_ = {};
  deviation_m_ = 0.0;
  if (own == nullptr) {  // the vehicle's position is unknown: it may stand anywhere on its plan
    moved_ = plan_;
    outside_area_m_ = footprint_area(vehicle.footprint, last_seen_, vehicle.safety_margin_m);
    return {.deviation_m = 0.0, .is_disturbed = true};
  }
  last_seen_ = own->pose;
  const auto steps_back = static_cast<std::uint64_t>(std::ceil(own->age_s / step_s));
  seen_ = {.step = now, .time_s = 0.0, .pose = own->pose};
  if (now.value < plan_.first().value + steps_back)
    return {};  // just anchored at its measured pose
  seen_.step.value -= steps_back;
  seen_.time_s = static_cast<double>(steps_back) * step_s - own->age_s;
  const State planned = plan_.state_at(seen_.step, seen_.time_s, vehicle);
  deviation_m_ = footprint_deviation_m(own->pose, planned, vehicle, automaton_->identified);
  const double off_m = (own->pose.position_m() - planned.pose.position_m()).norm();
  const bool is_outside =
      deviation_m_ > vehicle.safety_margin_m && !is_inside_announced(own->pose, seen_.step);
  const DeviationCheck result{.deviation_m = deviation_m_, .is_disturbed = is_outside};
  if (!is_outside && off_m <= rules_.reanchor_share * vehicle.safety_margin_m) return result;
  const bool stands = plan_.end().value + steps_back <= now.value &&
                      std::abs(own->speed_mps) <= MissingVehicleRules{}.standing_speed_mps;
  if (is_outside && stands) {
    *this = PlanInForce(automaton_, *standstill_, rules_, own->pose, now);
    deviation_m_ = result.deviation_m;
    return {.deviation_m = deviation_m_, .is_disturbed = false, .is_anchored_anew = true};
  }
  moved_ = plan_.moved(planned.pose, pose_of_measured(own->pose, planned.steering_rad, vehicle,
                                                      automaton_->identified));
  if (!is_outside && !stays_inside_announced(*moved_, now)) moved_.reset();
  if (is_outside) {
    outside_area_m_ = footprint_area(vehicle.footprint, own->pose, vehicle.safety_margin_m);
  }
  return result;
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
bool PlanInForce::stays_inside_announced(const Plan& plan, StepIndex now) const {
  const double reserve_m = kUnderWayShare * automaton_->vehicle.safety_margin_m;
  const std::vector<PredictedInstant> drive =
      predicted_drive(plan, seen_, {now.value + 1}, *automaton_);
  return std::ranges::all_of(drive, [&](const PredictedInstant& instant) {
    return instant.step != now || is_inside_announced(instant.pose, now, reserve_m);
  });
}

/// For a vehicle outside its areas also its pose if it stays where it was measured, if it continues
/// beside its plan, and the hull of all these. The same for a vehicle that is no longer seen: it
/// may have stopped on the way.
OccupiedAreas PlanInForce::announced_areas(StepIndex from) const {
  OccupiedAreas areas{.first = from, .areas_m = {}, .final_area_m = announced_.final_area_m};
  if (from < plan_.end()) areas.areas_m.reserve(plan_.end().value - from.value);
  for (StepIndex step = from; step < plan_.end(); ++step.value) {
    areas.areas_m.push_back(announced_.during(step));
  }
  if (outside_area_m_.empty()) return areas;
  const OccupiedAreas beside = moved_->areas_from(from);
  const auto join = [this](ConvexPolygon& area, const ConvexPolygon& other) {
    area = convex_hull(std::vector{area, other, outside_area_m_});
  };
  for (std::size_t i = 0; i < areas.areas_m.size(); ++i) {
    join(areas.areas_m[i], beside.during({from.value + i}));
  }
  join(areas.final_area_m, beside.final_area_m);
  return areas;
}

double PlanInForce::tolerated_m() const {
  return rules_.tolerated_drift_share * automaton_->vehicle.safety_margin_m;
}

bool PlanInForce::may_drift(const Plan& candidate) const {
  if (deviation_m_ > tolerated_m()) return true;
  for (StepIndex step = seen_.step; step <= candidate.end(); ++step.value) {
    if (is_at_limit_[candidate.trim_at(step).index]) return true;
  }
  return false;
}

OccupiedAreas PlanInForce::areas_of(const Plan& candidate, StepIndex next) const {
  if (!may_drift(candidate)) return candidate.areas_from(next);
  return areas_with_drift(candidate, next, seen_, *automaton_, tolerated_m());
}

Plan PlanInForce::replace(Plan candidate, const OccupiedAreas& areas, StepIndex now) {
  const ConvexPolygon under_way = announced_.during(now);
  announced_.first = now;
  announced_.areas_m.resize(1 + areas.areas_m.size());
  announced_.areas_m.front() = under_way;
  std::ranges::copy(areas.areas_m, announced_.areas_m.begin() + 1);
  announced_.final_area_m = areas.final_area_m;
  return std::exchange(plan_, std::move(candidate));
}

}  // namespace hlc
