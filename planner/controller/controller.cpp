#include "planner/controller/controller.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "planner/automaton/deviation.hpp"
#include "planner/common/demand.hpp"
#include "planner/controller/planning_basis.hpp"
#include "planner/controller/problem_alone.hpp"
#include "planner/controller/self_loop.hpp"
#include "planner/coordination/priority.hpp"
#include "planner/geometry/footprint.hpp"

namespace hlc::controller {
namespace {

coordination::FallbackReason reason_of(coordination::CommitVerdict verdict) {
  switch (verdict) {
    case coordination::CommitVerdict::kInForce:
      break;
    case coordination::CommitVerdict::kConflict:
      return coordination::FallbackReason::kConflict;
    case coordination::CommitVerdict::kNotReceived:
      return coordination::FallbackReason::kMissing;
    case coordination::CommitVerdict::kFallback:
      return coordination::FallbackReason::kNeighbour;
  }
  return coordination::FallbackReason::kNone;
}

/// Areas of the plan in force from t(from) on.
coordination::OccupiedAreas rest_of(const coordination::OccupiedAreas& running, StepIndex from) {
  coordination::OccupiedAreas rest{
      .first = from, .areas_m = {}, .final_area_m = running.final_area_m};
  const std::size_t passed = from.value - running.first.value;
  if (passed < running.areas_m.size()) {
    rest.areas_m.assign(running.areas_m.begin() + static_cast<std::ptrdiff_t>(passed),
                        running.areas_m.end());
  }
  return rest;
}

}  // namespace

Controller::Controller(const ControllerOptions& options,
                       std::shared_ptr<const automaton::Subgraph> subgraph,
                       std::vector<road::DrivableRoute> routes)
    : Controller(options,
                 prepare_subgraph(std::move(subgraph), options.horizon_steps, options.search),
                 std::move(routes)) {}

Controller::Controller(const ControllerOptions& options,
                       std::shared_ptr<const automaton::Subgraph> subgraph,
                       road::ReferencePath path, road::Corridor corridor)
    : Controller(options, std::move(subgraph),
                 {{.name = "", .path = std::move(path), .corridor = std::move(corridor)}}) {}

Controller::Controller(ControllerOptions options, PreparedSubgraph on,
                       std::vector<road::DrivableRoute> routes)
    : options_(std::move(options)),
      search_(std::move(on), options_.search, options_.horizon_steps),
      tracker_(std::make_shared<const std::vector<road::DrivableRoute>>(std::move(routes))),
      drivable_area_(options_.strategies.standstill_timeout, options_.horizon_steps),
      neighbours_(options_.vehicle, rules_for_missing(subgraph().automaton()), options_.guests),
      routes_digest_(digest_of(tracker_.routes())) {
  if (options_.conflicts) authority_.emplace(options_.conflicts, *options_.strategies.grant_order);
}

coordination::Report Controller::stand_by(const Observation& observation) {
  step_ = Step{};
  step_.observation = observation;
  standing_steps_ = 0;
  is_agreed_ = false;
  neighbours_.begin_step(observation.step);
  if (const coordination::MeasuredVehicle* own = observation.measured(options_.vehicle)) {
    const automaton::UniversalAutomaton& automaton = subgraph().automaton();
    in_force_.emplace(subgraph().shared_automaton(), self_loop(automaton, subgraph().standstill()),
                      options_.deviation, options_.horizon_steps, own->pose, observation.step);
    tracker_.select_route(
        automaton::pose_of_measured(own->pose, 0.0, automaton.vehicle, automaton.identified),
        automaton.vehicle.footprint);
    drivable_area_.depart();
  }
  coordination::Report report{.vehicle = options_.vehicle, .step = observation.step};
  if (placement() && !fits_route()) {
    report.reason = coordination::FallbackReason::kOffRoute;
    report.deviation_m = std::max(0.0, placement()->beyond_m());
  }
  report.subgraph = subgraph().spec().name;
  if (in_force_) report_plan_in_force(report);
  return report;
}

void Controller::report_plan_in_force(coordination::Report& report) const {
  const coordination::Plan& plan = plan_in_force();
  report.planned_pose = plan.pose_at(report.step);
  report.planned_trim = plan.trim_at(report.step);
  report.maneuver = plan.maneuver_during(report.step).label;
}

coordination::Traffic Controller::observe(const Observation& observation) {
  HLC_DEMAND(has_plan());
  const StepIndex now = observation.step;
  former_problem_.reset();
  if (!problems().empty()) former_problem_ = std::move(step_.candidate.problems.front().problem);
  step_ = Step{};
  step_.observation = observation;
  neighbours_.begin_step(now);
  step_.report = {.vehicle = options_.vehicle, .step = now};
  const DeviationCheck check =
      in_force_->check_deviation(observation.measured(options_.vehicle), now);
  step_.report.deviation_m = check.deviation_m;
  if (check.is_disturbed) step_.obstacle = coordination::FallbackReason::kDeviation;
  step_.is_vehicle_lost = check.is_lost;
  step_.is_vehicle_elsewhere = check.is_elsewhere;
  step_.is_disturbed = check.is_disturbed;
  is_agreed_ = is_agreed_ && !check.is_reanchored && in_force_->announces_only_plan();
  if (check.is_reanchored) depart_from(plan_in_force().pose_at(now));
  step_.report.subgraph = subgraph().spec().name;
  report_plan_in_force(step_.report);

  coordination::Traffic& traffic = step_.traffic;
  traffic.vehicle = options_.vehicle;
  traffic.step = now;
  traffic.next_pose = in_force_->base().pose_at(step_.next());
  traffic.next_trim = in_force_->base().trim_at(step_.next());
  traffic.running = in_force_->announced_areas(now);
  traffic.reachable_area_m = reachable_area_m();
  traffic.silent = neighbours_.silent(observation.active);
  const auto stands_at = [this](StepIndex step) {
    return subgraph().automaton().trims[plan_in_force().trim_at(step).index].is_equilibrium();
  };
  standing_steps_ = stands_at(now) && stands_at(step_.next()) ? standing_steps_ + 1 : 0;
  traffic.standing_steps = standing_steps_;
  if (options_.strategies.priorities.strategy->compares_references) {
    traffic.reference_areas_m = reference_areas_m();
  }
  if (authority_) {
    authority_->begin_step(plan_in_force(), now, tracker_, reach_m());
    traffic.claim = authority_->claim();
  }
  if (options_.others) traffic.planning = planning_input();
  return traffic;
}

/// The vehicle stands where its plan did not lead.
void Controller::depart_from(const Pose& pose) {
  drivable_area_.depart();
  tracker_.place(pose, subgraph().automaton().vehicle.footprint);
  if (authority_) authority_->release();
}

/// Area reachable on every subgraph that may be planned on, or along the plan in force, also from
/// where the vehicle really is: beside its plan it needs areas that reach beyond those of the plan,
/// also to stand where it stands.
ConvexPolygon Controller::reachable_area_m() const {
  const coordination::Traffic& traffic = step_.traffic;
  std::vector<ConvexPolygon> reach;
  reach.reserve(traffic.running.areas_m.size() + 3);
  const auto add = [&reach](const ConvexPolygon& area) {  // most areas lie within the first one
    if (reach.empty() || !contains(reach.front(), area)) reach.push_back(area);
  };
  const auto add_reachable = [&](const automaton::ReachableSets* sets) {
    add(transformed(sets->swept_area_until_m(traffic.next_trim, options_.horizon_steps + 1),
                    traffic.next_pose));
  };
  const std::vector<const automaton::ReachableSets*> reachable = search_.reachable();
  add_reachable(reachable.front());
  std::ranges::for_each(traffic.running.areas_m, add);
  add(traffic.running.final_area_m);
  std::ranges::for_each(reachable.begin() + 1, reachable.end(), add_reachable);
  if (in_force_->deviates()) {
    const coordination::OccupiedAreas driven = in_force_->areas_of(in_force_->base(), step_.next());
    std::ranges::for_each(driven.areas_m, add);
    add(driven.final_area_m);
  }
  return convex_hull(reach);
}

std::uint64_t Controller::warm_up() {
  if (!former_problem_ && !path_s_m()) return 0;
  const search::HorizonProblem problem =
      former_problem_ ? one_step_later(std::move(*former_problem_), step_.traffic)
                      : problem_in(route().corridor);
  former_problem_.reset();
  return search_.warm_up(problem);
}

void Controller::couple(const coordination::ReceivedMessages<coordination::Traffic>& received) {
  SharedStep alone;
  couple(received, alone);
}

void Controller::couple(const coordination::ReceivedMessages<coordination::Traffic>& received,
                        SharedStep& shared) {
  neighbours_.receive(received, step_.observation);
  std::vector<const coordination::Traffic*> traffic = neighbours_.received();
  traffic.push_back(&step_.traffic);
  step_.report.missing = neighbours_.missing();
  extend_authority(shared);
  const auto& [graph, plans_before, levels] = shared.coupling(
      std::move(traffic), options_.strategies.priorities, *options_.strategies.coupling);
  step_.report.level = levels.at(options_.vehicle);
  take_coupling(graph, plans_before);
}

void Controller::take_coupling(const coordination::CouplingGraph& graph,
                               const coordination::PriorityOrder& plans_before) {
  step_.coupling = graph;
  step_.plans_before = plans_before;
  step_.predecessors = coordination::predecessors(graph, options_.vehicle, plans_before);
  step_.component = graph.component(options_.vehicle);
  step_.report.coupled = graph.neighbours(options_.vehicle);
  // A coupled vehicle that does not receive our messages may soon drive as if we stood for good
  // (missing.hpp).
  const bool is_silent_to_any = std::ranges::any_of(coupled(), [this](VehicleId other) {
    return holds(neighbours_.traffic_of(other).silent, options_.vehicle);
  });
  if (is_silent_to_any && step_.obstacle == coordination::FallbackReason::kNone) {
    step_.obstacle = coordination::FallbackReason::kMissing;
  }
}

std::optional<double> Controller::path_s_m_of(const Point& position_m) const {
  if (!path_s_m()) return std::nullopt;
  return tracker_.project(position_m, reach_m());
}

search::HorizonProblem Controller::problem_in(const road::Corridor& corridor,
                                              const ReferenceEnd& end) const {
  return problem_alone(step_.traffic, tracker_, corridor, reach_m(), subgraph(), options_, end);
}

void Controller::update_drivable_area() {
  const coordination::Plan& base = in_force_->base();
  const StepIndex next = step_.next();
  const StepIndex end = std::max(base.end(), next);
  const automaton::UniversalAutomaton& automaton = subgraph().automaton();
  drivable_area_.update_drivable_area(
      {.next = next,
       .is_ended = base.end() <= next,
       .stands = automaton.trims[base.trim_at(next).index].is_equilibrium() &&
                 base.pose_at(next) == base.pose_at(end),
       .lies_in_lanes =
           [&] {
             return keeps_to(base, next, problem_in(route().corridor).boundary_m) &&
                    lies_inside(route(), base.pose_at(end), automaton.vehicle.footprint);
           },
       .find_entry = [this] { return find_lane_entry(); }});
  step_.obstacle = drivable_area_.obstacle();
}

LaneEntry Controller::find_lane_entry() {
  const Footprint& footprint = subgraph().automaton().vehicle.footprint;
  const Pose& start = step_.traffic.next_pose;
  const road::Placement placement = tracker_.place(start, footprint);
  return controller::find_lane_entry(
      route(), placement, start, reach_m(), footprint,
      [this](const road::Corridor& corridor) { return problem_in(corridor); },
      [this](const search::HorizonProblem& problem) {
        step_.entry_problems.push_back(problem);
        return search_.search(problem);
      });
}

bool Controller::may_plan() const {
  return !minimal_risk_stop_ && step_.obstacle == coordination::FallbackReason::kNone;
}

coordination::Prediction Controller::plan(
    const coordination::ReceivedMessages<coordination::Prediction>& received) {
  if (has_kept_plan_for(received)) {
    step_.before_plan.reset();
    return step_.prediction;
  }
  drop_kept_plan();
  respect_predecessors(received);
  check_start();
  if (may_plan()) {
    tracker_.advance(step_.traffic.next_pose.position_m(), reach_m());
    update_drivable_area();
  }
  std::optional<coordination::OccupiedAreas> desired;
  if (may_plan()) {
    search_candidate();
    desired = desired_areas();
  }
  step_.prediction = {.vehicle = options_.vehicle,
                      .step = step_.observation.step,
                      .is_new = step_.candidate.plan.has_value(),
                      .areas = step_.candidate.plan ? std::move(step_.candidate.areas)
                                                    : rest_of(step_.traffic.running, step_.next()),
                      .desired = std::move(desired)};
  return step_.prediction;
}

/// Whether a plan may start at the vehicle's predicted pose.
void Controller::check_start() {
  const bool is_any_unknown = std::ranges::any_of(neighbours_.missing(), [this](VehicleId other) {
    return step_.observation.measured(other) == nullptr;  // it may be anywhere
  });
  if (is_any_unknown) step_.obstacle = coordination::FallbackReason::kMissing;
  // missing.hpp; a plan in force that begins with standing counts as standing.
  const bool stands = subgraph().automaton().trims[step_.traffic.next_trim.index].is_equilibrium();
  if (stands && is_cut_off()) step_.obstacle = coordination::FallbackReason::kMissing;
  // A disabled trim may have no way out, or a long one.
  if (step_.obstacle == coordination::FallbackReason::kNone &&
      subgraph().distance_to_standstill(step_.traffic.next_trim) > options_.horizon_steps) {
    step_.obstacle = coordination::FallbackReason::kInfeasible;
  }
}

coordination::Outcome Controller::vote() const {
  return {.vehicle = options_.vehicle,
          .step = step_.observation.step,
          .wants_fallback = !step_.candidate.plan.has_value()};
}

/// None: an obstacle of the search.
std::optional<coordination::CoupledAreas> Controller::compared_areas(VehicleId coupled) const {
  if (step_.respected.contains(coupled)) return std::nullopt;
  const auto received = step_.awaited.find(coupled);
  return coordination::CoupledAreas{
      .reachable_area_m = &neighbours_.traffic_of(coupled).reachable_area_m,
      .predicted = received == step_.awaited.end() ? nullptr : &received->second->areas};
}

coordination::CommitVerdict Controller::decide(
    const coordination::ReceivedMessages<coordination::Outcome>& outcomes) const {
  const StepIndex now = step_.observation.step;
  std::vector<coordination::CoupledAreas> coupled_areas;
  for (const VehicleId other : coupled()) {
    if (const auto areas = compared_areas(other)) coupled_areas.push_back(*areas);
  }
  std::vector<const coordination::Outcome*> votes;
  for (const VehicleId other : step_.component) {
    if (other != options_.vehicle) votes.push_back(outcomes.find(other, now).get());
  }
  return options_.strategies.coordination.commit.decide({.planned = &step_.prediction.areas,
                                                         .coupled = coupled_areas,
                                                         .votes = votes,
                                                         .from = step_.next(),
                                                         .steps = options_.horizon_steps});
}

coordination::Report Controller::commit(
    const coordination::ReceivedMessages<coordination::Prediction>& predictions,
    const coordination::ReceivedMessages<coordination::Outcome>& outcomes) {
  if (!options_.strategies.coordination.commit.needs_votes) note_awaited(predictions);
  if (!step_.candidate.plan) return finish(false, step_.obstacle);
  const coordination::CommitVerdict verdict = decide(outcomes);
  if (verdict == coordination::CommitVerdict::kFallback) note_opposed(outcomes);
  return finish(verdict == coordination::CommitVerdict::kInForce, reason_of(verdict));
}

/// The predecessors' are known already.
void Controller::note_awaited(
    const coordination::ReceivedMessages<coordination::Prediction>& predictions) {
  for (const VehicleId other : coupled()) {
    if (step_.respected.contains(other)) continue;
    if (auto message = predictions.find(other, step_.observation.step)) {
      step_.awaited[other] = std::move(message);
    }
  }
}

coordination::Report Controller::fall_back(coordination::FallbackReason reason) {
  drop_kept_plan();
  return finish(false, reason);
}

coordination::Report Controller::finish(bool accepted, coordination::FallbackReason reason) {
  coordination::Report& report = step_.report;
  if (accepted) {
    in_force_->replace(std::move(*step_.candidate.plan), step_.prediction.areas,
                       step_.observation.step);
    report.status = coordination::StepStatus::kPlanned;
  } else {
    report.status = minimal_risk_stop_ ? coordination::StepStatus::kMinimalRiskStop
                                       : coordination::StepStatus::kFallback;
    report.reason = minimal_risk_stop_ ? coordination::FallbackReason::kNone : reason;
  }
  is_agreed_ |= accepted;
  report.certificate = std::make_shared<const coordination::Certificate>(certificate(accepted));
  step_.candidate.plan.reset();
  report.plan = plan_in_force().maneuvers_from(report.step);
  if (authority_) {
    const coordination::LaneClaim& claim = authority_->claim();
    report.held = {claim.route, claim.place_m, claim.ahead_m};
  }
  return report;
}

}  // namespace hlc::controller
