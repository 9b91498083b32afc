// The other vehicles as a controller sees them in a step: obstacles of its plan, and those that its
// vehicle waits for or that keep its plan from coming into force.
#include <algorithm>
#include <utility>

#include "planner/controller/blocked_by.hpp"
#include "planner/controller/controller.hpp"
#include "planner/controller/making_room.hpp"
#include "planner/controller/self_loop.hpp"
#include "planner/controller/waits_for.hpp"

namespace hlc::controller {
namespace {

/// One of them during each step of the horizon from t(from) on.
std::vector<const ConvexPolygon*> during_all(const coordination::OccupiedAreas& areas,
                                             StepIndex from, std::size_t steps) {
  std::vector<const ConvexPolygon*> areas_m;
  for (std::size_t j = 0; j < steps; ++j) areas_m.push_back(&areas.during({from.value + j}));
  return areas_m;
}

/// Also of vehicles that are no obstacle.
void mark(const std::vector<VehicleId>& vehicles, bool OtherVehicle::*as,
          std::vector<OtherVehicle>& others) {
  for (const VehicleId vehicle : vehicles) {
    auto other = std::ranges::find(others, vehicle, &OtherVehicle::vehicle);
    if (other == others.end()) other = others.insert(other, {.vehicle = vehicle});
    (*other).*as = true;
  }
}

}  // namespace

CoupledVehicle Controller::coupled_vehicle(VehicleId other) const {
  const auto respected = step_.respected.find(other);
  return {.traffic = &neighbours_.traffic_of(other),
          .prediction = respected == step_.respected.end() ? nullptr : respected->second.get(),
          .is_predecessor = holds(predecessors(), other)};
}

void Controller::respect_predecessors(
    const coordination::ReceivedMessages<coordination::Prediction>& received) {
  for (const VehicleId other : step_.predecessors) {
    if (auto message = received.find(other, step_.observation.step)) {
      step_.respected[other] = std::move(message);
    }
  }
}

MissingVehicle Controller::missing_vehicle(VehicleId other) const {
  return {.measured = step_.observation.measured(other),
          .stands_for_good = neighbours_.stands_for_good(other, options_.horizon_steps)};
}

void Controller::extend_authority(SharedStep& shared) {
  if (!authority_) return;
  const automaton::UniversalAutomaton& automaton = subgraph().automaton();
  std::vector<right_of_way::Blocked> blocked;
  for (const ConvexPolygon& area_m : standing_m_) blocked.push_back({std::nullopt, area_m});
  std::vector<const coordination::Traffic*> holders;
  for (const coordination::Traffic* traffic : neighbours_.received()) {
    if (traffic->claim && traffic->claim->route < options_.conflicts->num_routes()) {
      holders.push_back(traffic);
      continue;
    }
    for (const ConvexPolygon& area_m : traffic->running.areas_m) {
      blocked.push_back({traffic->vehicle, area_m});
    }
    blocked.push_back({traffic->vehicle, traffic->running.final_area_m});
  }
  authority_->receive(holders);
  std::vector<VehicleId> missing;
  for (const VehicleId other : neighbours_.missing()) {
    const coordination::MeasuredVehicle* const measured = step_.observation.measured(other);
    if (measured != nullptr && neighbours_.stands_for_good(other, options_.horizon_steps)) {
      blocked.push_back({other, coordination::standing_area(*measured, neighbours_.rules())});
    } else if (authority_->knows(other)) {
      missing.push_back(other);
    } else if (measured != nullptr) {
      const double horizon_s = static_cast<double>(options_.horizon_steps + 1) * automaton.step_s;
      blocked.push_back(
          {other, coordination::reachable_disc(*measured, horizon_s, neighbours_.rules())});
    } else {
      return;  // it may be anywhere
    }
  }
  authority_->extend(options_.vehicle, holders, missing, blocked,
                     neighbours_.rules().max_speed_mps * automaton.step_s, shared);
}

std::vector<std::vector<ConvexPolygon>> Controller::obstacles_m(
    std::span<const CoupledVehicle> coupled_vehicles, CoupledObstacleRule rule,
    std::span<const MissingVehicle> missing) const {
  return controller::obstacles_m(coupled_vehicles, rule, missing, neighbours_.rules(),
                                 step_.observation.step, options_.horizon_steps,
                                 subgraph().automaton().step_s);
}

std::vector<std::vector<ConvexPolygon>> Controller::obstacles_m(CoupledObstacleRule rule) const {
  std::vector<CoupledVehicle> coupled_vehicles;
  for (const VehicleId other : coupled()) {
    if (!step_.left_out.holds(other)) coupled_vehicles.push_back(coupled_vehicle(other));
  }
  std::vector<MissingVehicle> missing;
  for (const VehicleId other : neighbours_.missing()) {
    if (!step_.left_out.holds(other)) missing.push_back(missing_vehicle(other));
  }
  return obstacles_m(coupled_vehicles, rule, missing);
}

bool Controller::makes_room_for(const CoupledVehicle& other) const {
  return options_.strategies.coordination.makes_room && other.prediction != nullptr &&
         other.prediction->desired.has_value();
}

std::vector<Controller::AnnouncedPlan> Controller::announced_plans() const {
  std::vector<AnnouncedPlan> plans;
  for (const coordination::Traffic* traffic : neighbours_.received()) {
    const VehicleId other = traffic->vehicle;
    const auto respected = step_.respected.find(other);
    const auto awaited = step_.awaited.find(other);
    if (respected != step_.respected.end() && respected->second->is_new) {
      plans.push_back({other, respected->second->areas});
    } else if (awaited != step_.awaited.end() && awaited->second->is_new) {
      plans.push_back({other, awaited->second->areas});
    } else {
      plans.push_back({other, traffic->running});
    }
  }
  return plans;
}

void Controller::note_opposed(
    const coordination::ReceivedMessages<coordination::Outcome>& outcomes) {
  for (const VehicleId other : step_.component) {
    if (other == options_.vehicle) continue;
    const auto vote = outcomes.find(other, step_.observation.step);
    if (vote == nullptr || vote->wants_fallback) step_.opposed.push_back(other);
  }
}

/// A plan found on the current subgraph.
coordination::Plan Controller::plan_of(
    const std::vector<const automaton::Maneuver*>& maneuvers) const {
  const automaton::Subgraph& on = subgraph();
  return in_force_->base().continued(step_.next(), maneuvers,
                                     self_loop(on.automaton(), maneuvers.back()->to),
                                     on.shared_automaton());
}

std::optional<MotionAlone> Controller::motion_alone() {
  if (!path_s_m()) return std::nullopt;
  const search::SearchResult result = search_.search(posed_alone());
  if (result.maneuvers.empty()) return std::nullopt;
  coordination::Plan plan = plan_of(result.maneuvers);
  coordination::OccupiedAreas areas = in_force_->areas_of(plan, step_.next());
  return MotionAlone{.plan = std::move(plan), .areas = std::move(areas)};
}

/// What planning kept clear of, a desired plan included; also what was only known when this vehicle
/// committed.
OtherVehicle Controller::as_obstacle(VehicleId coupled) const {
  const CoupledVehicle other = coupled_vehicle(coupled);
  OtherVehicle result{
      .vehicle = coupled,
      .areas_m = obstacles_m({&other, 1}, options_.strategies.coordination.obstacles, {}),
      .is_out_of_contact = holds(other.traffic->silent, options_.vehicle)};
  if (!options_.strategies.coordination.commit.needs_votes) {
    result.compared = compared_areas(coupled);
  }
  if (!makes_room_for(other)) return result;
  for (std::size_t j = 0; j < result.areas_m.size(); ++j) {
    result.areas_m[j].push_back(other.prediction->desired->during({step_.next().value + j}));
  }
  return result;
}

std::vector<OtherVehicle> Controller::other_vehicles() const {
  std::vector<OtherVehicle> others;
  for (const VehicleId other : coupled()) others.push_back(as_obstacle(other));
  for (const VehicleId other : neighbours_.missing()) {
    const MissingVehicle missing = missing_vehicle(other);
    OtherVehicle result{.vehicle = other,
                        .is_out_of_contact = missing.measured == nullptr || is_cut_off()};
    if (!result.is_out_of_contact) result.areas_m = obstacles_m({}, nullptr, {&missing, 1});
    others.push_back(std::move(result));
  }
  for (const VehicleId guest : neighbours_.guests().seen()) {
    others.push_back({.vehicle = guest,
                      .areas_m = neighbours_.guests().avoided_in_motion_m(
                          {&guest, 1}, options_.horizon_steps, subgraph().automaton().step_s)});
  }
  mark(step_.opposed, &OtherVehicle::is_opposed, others);
  if (authority_) mark(authority_->withheld_by(), &OtherVehicle::withholds_road, others);
  return others;
}

/// As the step ends. @param is_new  its plan came into force
coordination::Certificate Controller::certificate(bool is_new) const {
  coordination::OccupiedAreas areas = step_.traffic.running;
  if (is_new) {
    const coordination::OccupiedAreas& planned = step_.prediction.areas;
    areas.areas_m = {step_.traffic.running.during(areas.first)};
    areas.areas_m.insert(areas.areas_m.end(), planned.areas_m.begin(), planned.areas_m.end());
    areas.final_area_m = planned.final_area_m;
  }
  std::vector<coordination::Separation> separations = this->separations(areas);
  return {.footprint = subgraph().automaton().vehicle.footprint,
          .areas = std::move(areas),
          .is_agreed = is_agreed_,
          .separations = std::move(separations)};
}

std::vector<coordination::Separation> Controller::separations(
    const coordination::OccupiedAreas& own) const {
  using coordination::KnownMotion;
  std::vector<coordination::Separation> separations;
  const std::size_t steps = options_.horizon_steps;
  const auto add = [&](VehicleId other, KnownMotion known,
                       const std::vector<const ConvexPolygon*>& areas_m) {
    auto lines = coordination::separating_lines(own, step_.next(), areas_m);
    if (lines) separations.push_back({other, known, *std::move(lines)});
  };
  for (const VehicleId other : coupled()) {
    const coordination::Traffic& traffic = neighbours_.traffic_of(other);
    add(other, KnownMotion::kRunning, during_all(traffic.running, step_.next(), steps));
    const auto respected = step_.respected.find(other);
    const auto awaited = step_.awaited.find(other);
    if (respected != step_.respected.end() || awaited != step_.awaited.end()) {
      const auto& plan = respected != step_.respected.end() ? *respected->second : *awaited->second;
      if (plan.is_new) add(other, KnownMotion::kNew, during_all(plan.areas, step_.next(), steps));
    } else {
      add(other, KnownMotion::kReachable,
          std::vector<const ConvexPolygon*>(steps, &traffic.reachable_area_m));
    }
  }
  for (const VehicleId other : missing()) {
    const MissingVehicle vehicle = missing_vehicle(other);
    if (vehicle.measured == nullptr) continue;  // it may be anywhere
    std::vector<const ConvexPolygon*> areas_m;
    const auto obstacles = obstacles_m({}, nullptr, {&vehicle, 1});
    for (const auto& areas : obstacles) areas_m.push_back(&areas.front());
    add(other, KnownMotion::kMissing, areas_m);
  }
  return separations;
}

void Controller::note_arrival(coordination::Report& report) {
  if (!has_plan() || report.status == coordination::StepStatus::kStandby) return;
  const coordination::Plan& plan = plan_in_force();
  const Pose pose = plan.pose_at(report.step);
  tracker_.note_place(pose, stays_at(plan, pose, report.step, std::max(report.step, plan.end())),
                      report.step, options_.horizon_steps,
                      subgraph().automaton().vehicle.footprint);
  report.arrived_since = tracker_.arrived_since();
}

void Controller::note_causes(coordination::Report& report) {
  note_arrival(report);
  if (report.reason != coordination::FallbackReason::kLate) {
    std::vector<VehicleId> vehicles;
    if (has_plan()) {
      std::optional<std::optional<MotionAlone>> alone;  // of one search for both
      const EndedStep step{.report = report,
                           .in_force = plan_in_force(),
                           .new_plan = step_.prediction.is_new ? &step_.prediction.areas : nullptr,
                           .horizon_steps = options_.horizon_steps,
                           .is_disturbed = step_.is_disturbed,
                           .alone =
                               [&] {
                                 if (!alone) alone = motion_alone();
                                 return *alone;
                               },
                           .others = [this] { return other_vehicles(); }};
      if (!report.arrived_since) vehicles = waits_for(step);
      report.blocked_by = blocked_by(step);
    }
    if (vehicles.empty()) waiting_.since = {};
    if (waiting_.vehicles.empty() && !vehicles.empty()) waiting_.since = report.step;
    waiting_.vehicles = std::move(vehicles);
  }
  report.waiting = waiting_;
}

}  // namespace hlc::controller
