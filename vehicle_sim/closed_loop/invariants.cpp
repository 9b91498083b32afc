#include "vehicle_sim/closed_loop/invariants.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "planner/coordination/certificate.hpp"
#include "planner/coordination/commit.hpp"
#include "planner/coordination/missing.hpp"
#include "planner/coordination/report.hpp"
#include "planner/geometry/polygon.hpp"
#include "planner/geometry/separating_line.hpp"

namespace hlc::closed_loop {
namespace {

bool are_free_for_good(const coordination::OccupiedAreas& a, const coordination::OccupiedAreas& b,
                       StepIndex from, std::size_t horizon_steps) {
  return coordination::are_free(a, b, from, horizon_steps) &&
         separating_line(a.final_area_m, b.final_area_m, coordination::kSeparationTolerance_m);
}

}  // namespace

// --- footprints ---------------------------------------------------------------------------------

FootprintsCheck::FootprintsCheck(const Footprint& footprint,
                                 const std::map<std::uint8_t, Pose>& starts,
                                 std::vector<ConvexPolygon> obstacles_m)
    : footprint_(footprint),
      circumradius_m_(0.5 * std::hypot(footprint.length_m, footprint.width_m)),
      obstacles_m_(std::move(obstacles_m)) {
  for (const auto& [vehicle, start] : starts) cars_[vehicle].start = start;
}

const Pose& FootprintsCheck::Car::at(std::uint64_t tick) const {
  if (poses.empty() || tick < first) return start;
  return tick < end() ? poses[tick - first] : poses.back();
}

void FootprintsCheck::driven(std::uint8_t vehicle, std::uint64_t tick, const Pose& pose,
                             bool is_unreachable) {
  Car& car = cars_.at(vehicle);
  if (car.poses.empty()) {
    car.first = tick;
    if (!next_ || tick < *next_) next_ = tick;
  }
  while (car.end() < tick) car.poses.push_back(car.poses.back());
  if (tick >= car.end()) car.poses.push_back(pose);
  if (is_unreachable) car.exempt(tick, tick + 1);
}

void FootprintsCheck::Car::exempt(std::uint64_t from, std::uint64_t until) {
  if (from > exempt_until) exempt_from = from;
  exempt_until = until;
}

void FootprintsCheck::died(std::uint8_t vehicle, std::uint64_t unreachable_ticks) {
  Car& car = cars_.at(vehicle);
  car.has_ended = true;
  car.exempt(car.end(), car.end() + unreachable_ticks);
}

std::uint64_t FootprintsCheck::all_driven_until() const {
  std::optional<std::uint64_t> end;
  for (const auto& [vehicle, car] : cars_) {
    if (!car.has_ended && !car.poses.empty()) end = std::min(end.value_or(car.end()), car.end());
  }
  return end.value_or(0);
}

void FootprintsCheck::check(Nanoseconds at, Violations& violations) {
  if (!next_) return;
  const std::uint64_t end = all_driven_until();
  for (; *next_ < end; ++*next_) {
    for (auto a = cars_.begin(); a != cars_.end(); ++a) {
      if (touches_obstacle_first_time(*a, *next_)) {
        violations.push_back({.at = at,
                              .check = "footprints",
                              .text = "vehicle " + std::to_string(a->first) +
                                      " touches an obstacle in tick " + std::to_string(*next_)});
      }
      for (auto b = std::next(a); b != cars_.end(); ++b) {
        if (!touches_first_time(*a, *b, *next_)) continue;
        violations.push_back({.at = at,
                              .check = "footprints",
                              .text = "vehicles " + std::to_string(a->first) + " and " +
                                      std::to_string(b->first) + " touch in tick " +
                                      std::to_string(*next_)});
      }
    }
  }
}

bool FootprintsCheck::touches_first_time(const Cars::value_type& a, const Cars::value_type& b,
                                         std::uint64_t tick) {
  const Pose& pose_a = a.second.at(tick);
  const Pose& pose_b = b.second.at(tick);
  const double centres_m = std::hypot(pose_a.x_m - pose_b.x_m, pose_a.y_m - pose_b.y_m);
  if (centres_m - 2 * circumradius_m_ > smallest_distance_m_) return false;
  const double gap_m =
      distance_m(footprint_area(footprint_, pose_a), footprint_area(footprint_, pose_b));
  const bool is_exempt = a.second.is_exempt(tick) || b.second.is_exempt(tick);
  if (!is_exempt) smallest_distance_m_ = std::min(smallest_distance_m_, gap_m);
  return gap_m <= 0.0 && touched_.insert({a.first, b.first}).second && !is_exempt;
}

bool FootprintsCheck::touches_obstacle_first_time(const Cars::value_type& one, std::uint64_t tick) {
  const ConvexPolygon area_m = footprint_area(footprint_, one.second.at(tick));
  const auto touches = [&](const ConvexPolygon& obstacle_m) {
    return intersects(area_m, obstacle_m);
  };
  return !one.second.is_exempt(tick) && std::ranges::any_of(obstacles_m_, touches) &&
         touched_obstacle_.insert(one.first).second;
}

// --- plans --------------------------------------------------------------------------------------

bool PlansCheck::is_relied_on(const InForce& plan, StepIndex now) const {
  const bool has_run_out =
      now.value > plan.last_report.value + horizon_steps_ + 1 + coordination::kSilentSteps;
  const bool is_silent = now.value > plan.last_report.value + 1;
  return !has_run_out && (plan.is_received || !is_silent);
}

bool PlansCheck::meet(const coordination::OccupiedAreas& areas, VehicleId other,
                      const InForce& plan, StepIndex now) const {
  const StepIndex from = std::max(areas.first, plan.areas.first);
  if (are_free_for_good(areas, plan.areas, from, horizon_steps_)) return false;
  const bool has_run_out = now.value >= plan.areas.first.value + plan.areas.areas_m.size();
  return !has_run_out || standing_ == nullptr || !standing_->has(other) ||
         !coordination::are_free(areas, standing_->area(other), from, horizon_steps_);
}

bool PlansCheck::meets_obstacle(const coordination::OccupiedAreas& areas) const {
  const auto meets = [this](const ConvexPolygon& area_m) {
    return std::ranges::any_of(obstacles_m_, [&](const ConvexPolygon& obstacle_m) {
      return !separating_line(area_m, obstacle_m, coordination::kSeparationTolerance_m);
    });
  };
  return std::ranges::any_of(areas.areas_m, meets) || meets(areas.final_area_m);
}

/// A vehicle that stands elsewhere than in its plan: it has been anchored there, and may agree to
/// a new plan in the same step.
void PlansCheck::published(const coordination::Traffic& traffic) {
  const auto found = in_force_.find(traffic.vehicle);
  if (found == in_force_.end() || !traffic.running.areas_m.empty()) return;
  if (traffic.running.final_area_m != found->second.areas.final_area_m) in_force_.erase(found);
}

void PlansCheck::reported(const coordination::Report& report, const coordination::Plan* in_force,
                          Nanoseconds at, Violations& violations) {
  const VehicleId vehicle = report.vehicle;
  const auto before = in_force_.find(vehicle);
  if (before != in_force_.end()) {
    before->second.last_report = report.step;
    const bool has_no_new_plan =
        report.status != coordination::StepStatus::kPlanned && in_force != nullptr;
    if (report.reason == coordination::FallbackReason::kDeviation ||
        (has_no_new_plan &&
         (report.status == coordination::StepStatus::kStandby || is_anchored(*in_force)))) {
      in_force_.erase(before);
    }
  }
  const auto predicted = predicted_.find(vehicle);
  if (report.status != coordination::StepStatus::kPlanned || predicted == predicted_.end() ||
      predicted->second.step != report.step) {
    return;
  }
  const coordination::OccupiedAreas& areas =
      (in_force_[vehicle] = {.areas = std::move(predicted->second.areas),
                             .last_report = report.step})
          .areas;
  predicted_.erase(predicted);
  if (meets_obstacle(areas) && met_obstacle_.insert(vehicle).second) {
    violations.push_back({.at = at,
                          .check = "plans",
                          .text = "the plan of vehicle " + std::to_string(vehicle.value) +
                                  " from step " + std::to_string(areas.first.value) +
                                  " on meets an obstacle"});
  }
  for (const auto& [other, plan] : in_force_) {
    if (other == vehicle || !is_relied_on(plan, report.step) ||
        !meet(areas, other, plan, report.step) ||
        !met_.insert(std::minmax(vehicle, other)).second) {
      continue;
    }
    const StepIndex from = std::max(areas.first, plan.areas.first);
    violations.push_back({.at = at,
                          .check = "plans",
                          .text = "plans in force of vehicles " + std::to_string(other.value) +
                                  " and " + std::to_string(vehicle.value) + " meet from step " +
                                  std::to_string(from.value) + " on"});
  }
}

// --- reasons ------------------------------------------------------------------------------------

void ReasonsCheck::log(const std::string& process, const machine::LogLine& line, Nanoseconds at) {
  Lines& lines = lines_[process];
  lines.last = at;
  if (line.severity != machine::Severity::kInfo) lines.has_complained = true;
}

void ReasonsCheck::driven(const std::string& vehicle, bool follows, Nanoseconds at) {
  Lines& lines = lines_[vehicle];
  if (lines.follows && !follows) lines.stopped = at;
  lines.follows = follows;
}

void ReasonsCheck::ended(const std::string& process, int exit_code, Nanoseconds at,
                         Violations& violations) {
  const Lines& lines = lines_[process];
  if (exit_code == kExitGood || exit_code == kExitInterrupted || lines.has_complained) return;
  violations.push_back(
      {.at = at,
       .check = "reasons",
       .text = process + " ended with code " + std::to_string(exit_code) + " and did not log why"});
}

void ReasonsCheck::reported(const coordination::Report& report, Nanoseconds at,
                            Violations& violations) {
  const bool is_due_to_others = report.reason == coordination::FallbackReason::kMissing ||
                                report.reason == coordination::FallbackReason::kNeighbour;
  if (!is_due_to_others || !report.blocked_by.empty()) return;
  violations.push_back({.at = at,
                        .check = "reasons",
                        .text = "vehicle " + std::to_string(report.vehicle.value) +
                                " falls back, " + coordination::to_string(report.reason) +
                                ", and does not name because of which"});
}

void ReasonsCheck::check(Nanoseconds at, Violations& violations) {
  for (auto& [process, lines] : lines_) {
    const auto stopped = std::exchange(lines.stopped, std::nullopt);
    if (!stopped || (lines.last && *lines.last >= *stopped)) continue;
    violations.push_back(
        {.at = at, .check = "reasons", .text = process + " stopped and did not log why"});
  }
}

// --- planning -----------------------------------------------------------------------------------

void PlanningCheck::report(const ReportRecord& record, Nanoseconds at) {
  const coordination::Report& report = record.report;
  last_[report.vehicle.value] = std::string(coordination::to_string(report.status)) + ", " +
                                coordination::to_string(report.reason);
  if (report.status == coordination::StepStatus::kStandby) {
    standby_.insert(report.vehicle.value);
  } else {
    standby_.erase(report.vehicle.value);
  }
  if (at < calm_from_) return;
  const bool cannot = report.reason == coordination::FallbackReason::kInfeasible ||
                      report.reason == coordination::FallbackReason::kConflict ||
                      report.reason == coordination::FallbackReason::kBudget ||
                      report.reason == coordination::FallbackReason::kOffRoute ||
                      report.status == coordination::StepStatus::kMinimalRiskStop;
  if (cannot || report.status == coordination::StepStatus::kPlanned)
    plans_[report.vehicle.value] = true;
}

void PlanningCheck::check(const std::vector<std::uint8_t>& able, Nanoseconds at,
                          Violations& violations) const {
  for (const std::uint8_t vehicle : able) {
    if (plans_.contains(vehicle)) continue;
    const auto last = last_.find(vehicle);
    violations.push_back({.at = at,
                          .check = "planning",
                          .text = "vehicle " + std::to_string(vehicle) +
                                  " plans nothing 5 s after the last fault; its last report: " +
                                  (last == last_.end() ? "none" : last->second)});
  }
}

}  // namespace hlc::closed_loop
