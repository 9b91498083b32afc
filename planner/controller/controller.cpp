#include "planner/controller/controller.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "planner/automaton/deviation.hpp"
#include "planner/coordination/priority.hpp"

namespace hlc {
namespace {

/// The path is searched this far behind the last projection, for a vehicle that was moved a little.
constexpr double kProjectionBack_m = 0.3;
/// Boundary pieces this far beyond what the plan can reach are kept, so that no footprint looks
/// past them.
constexpr double kBoundaryReserve_m = 0.4;

/// Share of the safety margin that is kept for the error of a prediction of one step.
constexpr double kUnderWayShare = 0.2;
/// Swept areas are rounded outwards on the way to the reachable area.
constexpr double kReachRounding_m = 1e-5;

double top_speed_mps(const Subgraph& subgraph) {
  double result = 0.0;
  for (const TrimId trim : subgraph.spec().trims) {
    for (const Edge& edge : subgraph.successors(trim)) {
      for (const State& state : edge.maneuver->states) result = std::max(result, state.speed_mps);
    }
  }
  return result;
}

const Maneuver* standing_step(const Subgraph& subgraph) {
  for (const Edge& edge : subgraph.successors(subgraph.standstill())) {
    if (edge.to == subgraph.standstill()) return edge.maneuver;
  }
  assert(false && "every trim that is on has its own step");
  return nullptr;
}

MissingVehicleRules rules_for_missing(const Subgraph& subgraph) {
  const VehicleParameters& vehicle = subgraph.automaton().vehicle;
  return {
      .max_speed_mps = top_speed_mps(subgraph),
      .circumradius_m = 0.5 * std::hypot(vehicle.footprint.length_m, vehicle.footprint.width_m) +
                        std::sqrt(2.0) * vehicle.safety_margin_m,
      .footprint = vehicle.footprint,
      .safety_margin_m = vehicle.safety_margin_m};
}

bool is_well_formed(const Outcome& /*outcome*/) { return true; }

/// The message of one vehicle in one step, if it has come and is well-formed.
template <class Message>
const Message* find_message(std::span<const Message> messages, VehicleId vehicle, StepIndex step) {
  for (const Message& message : messages) {
    if (message.vehicle == vehicle && message.step == step) {
      return is_well_formed(message) ? &message : nullptr;
    }
  }
  return nullptr;
}

FallbackReason reason_of(SettleVerdict verdict) {
  switch (verdict) {
    case SettleVerdict::kInForce:
      break;
    case SettleVerdict::kConflict:
      return FallbackReason::kConflict;
    case SettleVerdict::kUnheard:
      return FallbackReason::kMissing;
    case SettleVerdict::kFallback:
      return FallbackReason::kNeighbour;
  }
  return FallbackReason::kNone;
}

bool holds(const std::vector<VehicleId>& vehicles, VehicleId vehicle) {
  return std::ranges::find(vehicles, vehicle) != vehicles.end();
}

}  // namespace

Controller::Controller(ControllerOptions options, std::shared_ptr<const Subgraph> subgraph,
                       ReferencePath path, Corridor corridor)
    : Controller(options, subgraph, std::move(path), std::move(corridor),
                 std::make_shared<const ReachableSets>(*subgraph, options.horizon_steps + 1)) {}

Controller::Controller(ControllerOptions options, std::shared_ptr<const Subgraph> subgraph,
                       ReferencePath path, Corridor corridor,
                       std::shared_ptr<const ReachableSets> reachable)
    : options_(options),
      subgraph_(std::move(subgraph)),
      path_(std::move(path)),
      corridor_(std::move(corridor)),
      reachable_(std::move(reachable)),
      planner_(make_best_first_planner(*subgraph_, *reachable_, options.search)),
      standstill_(standing_step(*subgraph_)),
      missing_rules_(rules_for_missing(*subgraph_)) {}

std::unique_ptr<Controller> Controller::clone() const {
  std::unique_ptr<Controller> result(
      new Controller(options_, subgraph_, path_, corridor_, reachable_));
  result->plan_ = plan_;
  result->told_ = told_;
  result->last_seen_ = last_seen_;
  result->path_s_m_ = path_s_m_;
  result->last_heard_ = last_heard_;
  result->last_sign_of_life_ = last_sign_of_life_;
  result->last_not_standing_ = last_not_standing_;
  result->drives_out_ = drives_out_;
  return result;
}

const MeasuredVehicle* Controller::measured(VehicleId vehicle) const {
  const auto& states = step_.observation.states;
  const auto found = std::ranges::find(states, vehicle, &MeasuredVehicle::vehicle);
  return found == states.end() ? nullptr : &*found;
}

void Controller::anchor(const MeasuredVehicle& measured, StepIndex step) {
  const UniversalAutomaton& automaton = subgraph_->automaton();
  plan_.emplace(step, pose_of_measured(measured.pose, 0.0, automaton.vehicle, automaton.identified),
                *standstill_);
  told_ = plan_->areas_from(step);
  step_.seen = {.step = step, .time_s = 0.0, .pose = measured.pose};
}

Report Controller::stand_by(const Observation& observation) {
  step_ = Step{};
  step_.observation = observation;
  if (const MeasuredVehicle* own = measured(options_.vehicle)) {
    anchor(*own, observation.step);
    path_s_m_.reset();
  }
  Report report{.vehicle = options_.vehicle, .step = observation.step};
  if (plan_) {
    report.planned_pose = plan_->pose_at(observation.step);
    report.planned_trim = plan_->trim_at(observation.step);
  }
  return report;
}

/// Compares the measured pose with the plan at the time of the measurement.
void Controller::watch_deviation() {
  const MeasuredVehicle* own = measured(options_.vehicle);
  const StepIndex now = step_.observation.step;
  const UniversalAutomaton& automaton = subgraph_->automaton();
  const VehicleParameters& vehicle = automaton.vehicle;
  const double step_s = automaton.step_s;
  if (own == nullptr) {  // nobody knows where the vehicle is: it may stand somewhere on its plan
    step_.obstacle = FallbackReason::kDeviation;
    if (last_seen_) {
      step_.moved = *plan_;
      step_.astray_m = footprint_area(vehicle.footprint, *last_seen_, vehicle.safety_margin_m);
    }
    return;
  }
  last_seen_ = own->pose;
  const auto steps_back = static_cast<std::uint64_t>(std::ceil(own->age_s / step_s));
  step_.seen = {.step = now, .time_s = 0.0, .pose = own->pose};
  if (now.value < plan_->first().value + steps_back) return;  // just anchored, where it was seen
  step_.seen.step.value -= steps_back;
  step_.seen.time_s = static_cast<double>(steps_back) * step_s - own->age_s;
  const State planned = plan_->state_at(step_.seen.step, step_.seen.time_s, vehicle);
  step_.report.deviation_m =
      footprint_deviation_m(own->pose, planned, vehicle, automaton.identified);
  const double off_m = (own->pose.position_m() - planned.pose.position_m()).norm();
  const bool is_astray = step_.report.deviation_m > vehicle.safety_margin_m &&
                         !is_inside_told(own->pose, step_.seen.step);
  if (!is_astray && off_m <= options_.reanchor_share * vehicle.safety_margin_m) return;
  const bool stands = plan_->end().value + steps_back <= now.value &&
                      std::abs(own->speed_mps) <= missing_rules_.standing_speed_mps;
  if (is_astray && stands) {
    anchor(*own, now);
    return;
  }
  step_.moved = plan_->moved(planned.pose, pose_of_measured(own->pose, planned.steering_rad,
                                                            vehicle, automaton.identified));
  if (!is_astray && !stays_inside_told(*step_.moved)) step_.moved.reset();
  if (is_astray) {
    step_.obstacle = FallbackReason::kDeviation;
    step_.astray_m = footprint_area(vehicle.footprint, own->pose, vehicle.safety_margin_m);
  }
}

/// True if the footprint lies in the area that the others know of that step.
bool Controller::is_inside_told(const Pose& measured, StepIndex step, double reserve_m) const {
  if (step < told_.first) return false;
  const Footprint& footprint = subgraph_->automaton().vehicle.footprint;
  const std::vector<Point> corners = footprint_area(footprint, measured, reserve_m).vertices_m;
  return std::ranges::all_of(
      corners, [&](const Point& corner) { return contains(told_.during(step), corner); });
}

/// True if a vehicle that follows `plan` from now on keeps to what is known of the step under way.
bool Controller::stays_inside_told(const Plan& plan) const {
  const StepIndex now = step_.observation.step;
  const UniversalAutomaton& automaton = subgraph_->automaton();
  const double reserve_m = kUnderWayShare * automaton.vehicle.safety_margin_m;
  const std::vector<PredictedInstant> drive =
      predicted_drive(plan, step_.seen, {now.value + 1}, automaton);
  return std::ranges::all_of(drive, [&](const PredictedInstant& instant) {
    return instant.step != now || is_inside_told(instant.pose, now, reserve_m);
  });
}

/// Areas of the plan in force from t(from) on. Of a vehicle outside them also where it is if it
/// stays where it was measured, if it drives on beside its plan as it is, and what lies between all
/// these. So too of a vehicle that is not seen any more: it may have stopped on the way.
OccupiedAreas Controller::areas_to_tell(StepIndex from) const {
  OccupiedAreas areas = plan_->areas_from(from);
  for (std::size_t i = 0; i < areas.areas_m.size(); ++i) {
    areas.areas_m[i] = told_.during({from.value + i});
  }
  areas.final_area_m = told_.final_area_m;
  if (step_.astray_m.empty()) return areas;
  const OccupiedAreas beside = step_.moved->areas_from(from);
  const auto join = [this](ConvexPolygon& area, const ConvexPolygon& other) {
    std::vector<Point> points = area.vertices_m;
    points.insert(points.end(), other.vertices_m.begin(), other.vertices_m.end());
    points.insert(points.end(), step_.astray_m.vertices_m.begin(), step_.astray_m.vertices_m.end());
    area = convex_hull(std::move(points));
  };
  for (std::size_t i = 0; i < areas.areas_m.size(); ++i) {
    join(areas.areas_m[i], beside.during({from.value + i}));
  }
  join(areas.final_area_m, beside.final_area_m);
  return areas;
}

Traffic Controller::observe(const Observation& observation) {
  assert(plan_.has_value());
  const StepIndex now = observation.step;
  step_ = Step{};
  step_.observation = observation;
  step_.report = {.vehicle = options_.vehicle, .step = now};
  watch_deviation();
  step_.report.planned_pose = plan_->pose_at(now);
  step_.report.planned_trim = plan_->trim_at(now);

  const StepIndex next{now.value + 1};
  Traffic& traffic = step_.traffic;
  traffic.vehicle = options_.vehicle;
  traffic.step = now;
  const Plan& base = step_.moved ? *step_.moved : *plan_;
  traffic.next_pose = base.pose_at(next);
  traffic.next_trim = base.trim_at(next);
  traffic.running = areas_to_tell(now);
  const ConvexPolygon reach =
      transformed(reachable_->swept_area_until_m(traffic.next_trim, options_.horizon_steps + 1),
                  traffic.next_pose);
  std::vector<Point> points = reach.vertices_m;
  const auto join = [&points](const ConvexPolygon& area) {
    points.insert(points.end(), area.vertices_m.begin(), area.vertices_m.end());
  };
  for (const ConvexPolygon& area : traffic.running.areas_m) join(area);
  join(traffic.running.final_area_m);
  traffic.reachable_area_m = convex_hull(std::move(points));
  for (const VehicleId other : observation.active) {
    if (other == options_.vehicle) continue;
    const auto heard = last_heard_.try_emplace(other, now).first->second;
    if (now.value >= heard.value + kSilentSteps) traffic.silent.push_back(other);
  }
  return traffic;
}

void Controller::couple(std::span<const Traffic> heard) {
  const StepIndex now = step_.observation.step;
  std::vector<Traffic> traffic{step_.traffic};
  for (const VehicleId other : step_.observation.active) {
    if (other == options_.vehicle) continue;
    const Traffic* message = find_message(heard, other, now);
    if (message == nullptr) {
      step_.report.missing.push_back(other);
      continue;
    }
    step_.heard[other] = *message;
    last_heard_[other] = now;
    traffic.push_back(*message);
  }
  note_who_lives();
  note_who_stands();
  const CouplingGraph graph(std::move(traffic));
  step_.coupled = graph.neighbours(options_.vehicle);
  step_.predecessors = hlc::predecessors(graph, options_.vehicle);
  step_.component = graph.component(options_.vehicle);
  step_.report.coupled = step_.coupled;
  step_.report.level = computation_level(graph, options_.vehicle);
  // A coupled vehicle that does not hear us may soon drive as if we stood for good (missing.hpp).
  for (const VehicleId other : step_.coupled) {
    if (holds(step_.heard.at(other).silent, options_.vehicle) &&
        step_.obstacle == FallbackReason::kNone) {
      step_.obstacle = FallbackReason::kMissing;
    }
  }
}

/// Of every other vehicle the last step in which its controller may have agreed to something.
void Controller::note_who_lives() {
  const StepIndex now = step_.observation.step;
  for (const VehicleId other : step_.observation.active) {
    const bool lives = step_.heard.contains(other) || holds(step_.observation.present, other);
    const auto [last, is_first] = last_sign_of_life_.try_emplace(other, now);
    if (lives && !is_first) last->second = now;
  }
}

/// Of every other vehicle the last step in which the list did not show it standing.
void Controller::note_who_stands() {
  const StepIndex now = step_.observation.step;
  for (const VehicleId other : step_.observation.active) {
    const MeasuredVehicle* state = measured(other);
    const bool stands = state != nullptr && is_seen_standing(*state, missing_rules_);
    const auto [last, is_first] = last_not_standing_.try_emplace(other, now);
    if (!stands && !is_first) last->second = now;
  }
}

void Controller::add_coupled_obstacles(HorizonProblem& problem) const {
  const std::uint64_t now = step_.observation.step.value;
  const bool strict = options_.settle_rule == SettleRule::kStrict;
  for (const VehicleId other : step_.coupled) {
    const Traffic& traffic = step_.heard.at(other);
    const auto respected = step_.respected.find(other);
    const bool is_predecessor = plans_before(other, options_.vehicle);
    const bool is_silent = is_predecessor && respected == step_.respected.end();
    const bool stands = traffic.running.areas_m.size() <= 1;  // nothing but the step under way
    for (std::size_t j = 1; j <= options_.horizon_steps; ++j) {
      const StepIndex step{now + j};
      auto& areas = problem.obstacles_m[j - 1];
      if (is_silent) areas.push_back(traffic.reachable_area_m);
      if (respected != step_.respected.end() && (respected->second.is_new || !strict)) {
        areas.push_back(respected->second.areas.during(step));
      }
      if (strict || (!is_predecessor && stands)) areas.push_back(traffic.running.during(step));
    }
  }
}

void Controller::add_missing_obstacles(HorizonProblem& problem) const {
  const double step_s = subgraph_->automaton().step_s;
  for (const VehicleId other : step_.report.missing) {
    const MeasuredVehicle& state = *measured(other);
    const bool stands = stands_for_good({.now = step_.observation.step,
                                         .last_sign_of_life = last_sign_of_life_.at(other),
                                         .last_not_standing = last_not_standing_.at(other)},
                                        options_.horizon_steps);
    for (std::size_t j = 1; j <= options_.horizon_steps; ++j) {
      problem.obstacles_m[j - 1].push_back(
          stands ? standing_area(state, missing_rules_)
                 : reachable_disc(state, static_cast<double>(j + 1) * step_s, missing_rules_));
    }
  }
}

HorizonProblem Controller::pose_problem() {
  const UniversalAutomaton& automaton = subgraph_->automaton();
  const Traffic& own = step_.traffic;
  const double reach_m = reachable_->max_distance_m(own.next_trim, options_.horizon_steps, 0);
  const Point position = own.next_pose.position_m();
  const auto projection = path_s_m_ ? path_.project_within(position, *path_s_m_ - kProjectionBack_m,
                                                           *path_s_m_ + reach_m + kProjectionBack_m)
                                    : path_.project(position);
  path_s_m_ = projection.s_m;

  HorizonProblem problem{.start = own.next_pose, .start_trim = own.next_trim};
  Reference reference =
      reference_points(path_, projection.s_m, automaton.trims[own.next_trim.index].speed_mps,
                       options_.reference_speed_mps, options_.horizon_steps, automaton.step_s,
                       options_.reference_rule);
  problem.reference_m = std::move(reference.points_m);
  problem.reference_speed_mps = std::move(reference.speeds_mps);
  problem.obstacles_m.resize(options_.horizon_steps);
  add_coupled_obstacles(problem);
  add_missing_obstacles(problem);
  problem.boundary_m = corridor_.boundary_m(projection.s_m - kBoundaryReserve_m,
                                            projection.s_m + reach_m + kBoundaryReserve_m);
  return problem;
}

/// Solves the problem; what it finds is the candidate, unless its drift leads into something.
void Controller::search_candidate(StepIndex next) {
  const SearchResult result = planner_->plan(*step_.problem);
  step_.report.generated += result.generated;
  step_.report.expanded += result.expanded;
  if (result.status != SearchStatus::kOptimal) {
    step_.obstacle = result.status == SearchStatus::kBudget ? FallbackReason::kBudget
                                                            : FallbackReason::kInfeasible;
    return;
  }
  step_.report.cost_m2 = result.cost;
  step_.candidate = (step_.moved ? *step_.moved : *plan_).continued(next, result.maneuvers);
  step_.candidate_areas_m = areas_of_candidate();
  if (!is_candidate_free()) {
    step_.candidate.reset();
    step_.obstacle = FallbackReason::kConflict;
  }
}

Prediction Controller::plan(std::span<const Prediction> heard) {
  const StepIndex now = step_.observation.step;
  const StepIndex next{now.value + 1};
  for (const VehicleId other : step_.predecessors) {
    if (const Prediction* message = find_message(heard, other, now))
      step_.respected[other] = *message;
  }
  for (const VehicleId other : step_.report.missing) {
    // Nothing at all is known of it: it may be anywhere.
    if (measured(other) == nullptr) step_.obstacle = FallbackReason::kMissing;
  }
  if (!drives_out_ && step_.obstacle == FallbackReason::kNone) {
    step_.problem = pose_problem();
    search_candidate(next);
    if (step_.obstacle == FallbackReason::kConflict) {  // only for its drift: try without any
      step_.problem->avoids_steering_limit = true;
      step_.obstacle = FallbackReason::kNone;
      search_candidate(next);
    }
  }
  step_.prediction = {.vehicle = options_.vehicle,
                      .step = now,
                      .is_new = step_.candidate.has_value(),
                      .areas = step_.candidate ? step_.candidate_areas_m : areas_to_tell(next)};
  return step_.prediction;
}

/// A plan that only uses trims with steering to spare is followed within the margin by a vehicle
/// that is on it; for any other the drive is predicted.
OccupiedAreas Controller::areas_of_candidate() const {
  const UniversalAutomaton& automaton = subgraph_->automaton();
  const Plan& plan = *step_.candidate;
  const StepIndex next{step_.observation.step.value + 1};
  const double tolerated_m = options_.tolerated_drift_share * automaton.vehicle.safety_margin_m;
  bool may_drift = step_.report.deviation_m > tolerated_m;
  for (StepIndex step = step_.seen.step; step <= plan.end() && !may_drift; ++step.value) {
    may_drift = is_at_steering_limit(automaton.trims[plan.trim_at(step).index], automaton.vehicle,
                                     automaton.identified);
  }
  if (!may_drift) return plan.areas_from(next);
  return areas_with_drift(plan, next, step_.seen, automaton, tolerated_m);
}

/// The search has kept the swept areas free, and they are within reach; those that hold a drift may
/// be larger.
bool Controller::is_candidate_free() const {
  const std::uint64_t next = step_.observation.step.value + 1;
  const auto is_in_reach = [this](const ConvexPolygon& area) {
    return std::ranges::all_of(area.vertices_m, [this](const Point& vertex) {
      return contains(step_.traffic.reachable_area_m, vertex, kReachRounding_m);
    });
  };
  if (!std::ranges::all_of(step_.candidate_areas_m.areas_m, is_in_reach) ||
      !is_in_reach(step_.candidate_areas_m.final_area_m)) {
    return false;
  }
  for (std::size_t j = 0; j < step_.problem->obstacles_m.size(); ++j) {
    const ConvexPolygon& area = step_.candidate_areas_m.during({next + j});
    if (std::ranges::any_of(step_.problem->obstacles_m[j], [&area](const ConvexPolygon& obstacle) {
          return intersects(area, obstacle);
        })) {
      return false;
    }
  }
  return true;
}

Outcome Controller::vote() const {
  return {.vehicle = options_.vehicle,
          .step = step_.observation.step,
          .wants_fallback = !step_.candidate.has_value()};
}

SettleVerdict Controller::strict_verdict(std::span<const Prediction> predictions) const {
  const StepIndex now = step_.observation.step;
  std::vector<HeardCoupled> coupled;
  for (const VehicleId other : step_.coupled) {
    if (step_.respected.contains(other)) continue;  // an obstacle of the search
    const Prediction* message = find_message(predictions, other, now);
    coupled.push_back({.reachable_area_m = &step_.heard.at(other).reachable_area_m,
                       .predicted = message == nullptr ? nullptr : &message->areas});
  }
  return settle_strictly(step_.prediction.areas, coupled, {now.value + 1}, options_.horizon_steps);
}

SettleVerdict Controller::agreed_verdict(std::span<const Outcome> outcomes) const {
  std::vector<const Outcome*> votes;
  for (const VehicleId other : step_.component) {
    if (other == options_.vehicle) continue;
    votes.push_back(find_message(outcomes, other, step_.observation.step));
  }
  return settle_by_votes(votes);
}

Report Controller::settle(std::span<const Prediction> predictions,
                          std::span<const Outcome> outcomes) {
  if (!step_.candidate) return finish(false, step_.obstacle);
  const SettleVerdict verdict = options_.settle_rule == SettleRule::kStrict
                                    ? strict_verdict(predictions)
                                    : agreed_verdict(outcomes);
  return finish(verdict == SettleVerdict::kInForce, reason_of(verdict));
}

Report Controller::give_up(FallbackReason reason) { return finish(false, reason); }

Report Controller::finish(bool accepted, FallbackReason reason) {
  Report& report = step_.report;
  if (accepted) {
    const StepIndex now = step_.observation.step;
    OccupiedAreas told{.first = now, .areas_m = {told_.during(now)}, .final_area_m = {}};
    told.areas_m.insert(told.areas_m.end(), step_.candidate_areas_m.areas_m.begin(),
                        step_.candidate_areas_m.areas_m.end());
    told.final_area_m = step_.candidate_areas_m.final_area_m;
    told_ = std::move(told);
    plan_ = std::move(*step_.candidate);
    report.status = StepStatus::kPlanned;
  } else {
    report.status = drives_out_ ? StepStatus::kDriveOut : StepStatus::kFallback;
    report.reason = drives_out_ ? FallbackReason::kNone : reason;
  }
  step_.candidate.reset();
  return report;
}

}  // namespace hlc
