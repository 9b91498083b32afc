#include "planner/controller/controller.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "planner/automaton/deviation.hpp"
#include "planner/controller/trajectory.hpp"
#include "planner/coordination/priority.hpp"

namespace hlc {
namespace {

/// The path is searched this far behind the last projection, for a vehicle that was moved a little.
constexpr double kProjectionBack_m = 0.3;
/// Boundary pieces this far beyond what the plan can reach are kept, so that no footprint looks
/// past them.
constexpr double kBoundaryReserve_m = 0.4;

/// Swept areas are rounded outwards on the way to the reachable area.
constexpr double kReachRounding_m = 1e-5;

/// A warm-up ends when the engine has asked so often whether to stop, every 64 expansions: after a
/// fraction of a millisecond.
constexpr int kWarmUpLooks = 16;

/// What a problem becomes a step later, if everybody keeps to what was known: from where the
/// vehicle will be, every step's reference and obstacles a step earlier, the last ones guessed.
/// Without its incumbent, whose maneuvers may be gone.
HorizonProblem one_step_later(HorizonProblem problem, const Traffic& own) {
  problem.start = own.next_pose;
  problem.start_trim = own.next_trim;
  problem.incumbent.clear();
  auto& reference_m = problem.reference_m;
  if (reference_m.size() < 2) return problem;
  reference_m.push_back(2.0 * reference_m.back() - reference_m[reference_m.size() - 2]);
  reference_m.erase(reference_m.begin());
  if (problem.obstacles_m.empty()) return problem;
  std::ranges::rotate(problem.obstacles_m, problem.obstacles_m.begin() + 1);
  problem.obstacles_m.back() = problem.obstacles_m[problem.obstacles_m.size() - 2];
  return problem;
}

/// A route that the vehicle fits is better than any that it does not.
constexpr double kFitsNot_m = 1e6;

const Maneuver* own_step(const UniversalAutomaton& automaton, TrimId trim) {
  const Maneuver* step = automaton.find(trim, trim, kOwnStepLabel);
  assert(step != nullptr && "every trim has its own step");
  return step;
}

/// Over all maneuvers: another vehicle may drive on any subgraph.
MissingVehicleRules rules_for_missing(const UniversalAutomaton& automaton) {
  const VehicleParameters& vehicle = automaton.vehicle;
  return {
      .max_speed_mps = top_speed_mps(automaton),
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

std::unique_ptr<SearchEngine> engine_on(const PreparedSubgraph& on, const SearchOptions& search) {
  return make_search_engine(*on.subgraph, *on.reachable, search, on.tables);
}

bool holds(const std::vector<VehicleId>& vehicles, VehicleId vehicle) {
  return std::ranges::find(vehicles, vehicle) != vehicles.end();
}

}  // namespace

Controller::Controller(ControllerOptions options, std::shared_ptr<const Subgraph> subgraph,
                       std::vector<DrivableRoute> routes)
    : Controller(options,
                 prepare_subgraph(std::move(subgraph), options.horizon_steps, options.search),
                 std::make_shared<const std::vector<DrivableRoute>>(std::move(routes))) {}

Controller::Controller(ControllerOptions options, std::shared_ptr<const Subgraph> subgraph,
                       ReferencePath path, Corridor corridor)
    : Controller(options, std::move(subgraph),
                 {{.name = "", .path = std::move(path), .corridor = std::move(corridor)}}) {}

Controller::Controller(ControllerOptions options, PreparedSubgraph on,
                       std::shared_ptr<const std::vector<DrivableRoute>> routes)
    : options_(std::move(options)),
      on_(std::move(on)),
      routes_(std::move(routes)),
      engine_(engine_on(on_, options_.search)),
      standstill_(own_step(subgraph().automaton(), subgraph().standstill())),
      missing_rules_(rules_for_missing(subgraph().automaton())) {
  assert(!routes_->empty());
}

std::unique_ptr<Controller> Controller::clone(std::optional<std::size_t> max_expansions) const {
  ControllerOptions options = options_;
  options.search.max_expansions = max_expansions.value_or(options.search.max_expansions);
  std::unique_ptr<Controller> result(new Controller(std::move(options), on_, routes_));
  result->step_.observation.step = last_step();
  result->in_force_ = in_force_;
  result->route_ = route_;
  result->placement_ = placement_;
  result->path_s_m_ = path_s_m_;
  result->joining_ = joining_;
  result->sets_out_ = sets_out_;
  result->rests_since_ = rests_since_;
  result->last_heard_ = last_heard_;
  result->last_sign_of_life_ = last_sign_of_life_;
  result->last_not_standing_ = last_not_standing_;
  result->drives_out_ = drives_out_;
  result->missing_rules_ = missing_rules_;
  if (former_) {
    result->former_ = Former{.on = former_->on,
                             .engine = engine_on(former_->on, result->options_.search),
                             .last = former_->last};
  }
  return result;
}

void Controller::switch_to(const PreparedSubgraph& next) {
  assert(next.subgraph->automaton().trims == subgraph().automaton().trims);
  assert(next.reachable->max_steps() > options_.horizon_steps);
  // Of several switches in a row: what the plan in force was found on.
  if (!former_) former_ = Former{on_, std::move(engine_), {}};
  former_->last = {last_step().value + options_.horizon_steps};
  engine_ = engine_on(next, options_.search);
  on_ = next;
  standstill_ = own_step(subgraph().automaton(), subgraph().standstill());
  sets_out_ = sets_out_ || !joining_.is_possible;
}

void Controller::switch_to(std::shared_ptr<const Subgraph> next) {
  switch_to(prepare_subgraph(std::move(next), options_.horizon_steps, options_.search));
}

std::uint64_t Controller::warm_up() {
  if (!former_problem_ && !path_s_m_) return 0;
  const Traffic& own = step_.traffic;
  const HorizonProblem problem = former_problem_ ? one_step_later(std::move(*former_problem_), own)
                                                 : problem_alone(route().corridor);
  former_problem_.reset();
  int looks = 0;
  return engine_->search(problem, [&looks] { return ++looks > kWarmUpLooks; }).expanded;
}

const MeasuredVehicle* Controller::measured(VehicleId vehicle) const {
  const auto& states = step_.observation.states;
  const auto found = std::ranges::find(states, vehicle, &MeasuredVehicle::vehicle);
  return found == states.end() ? nullptr : &*found;
}

Report Controller::stand_by(const Observation& observation) {
  step_ = Step{};
  step_.observation = observation;
  if (const MeasuredVehicle* own = measured(options_.vehicle)) {
    in_force_.emplace(subgraph().shared_automaton(), *standstill_, options_.deviation, own->pose,
                      observation.step);
    take_route(own->pose);
  }
  Report report{.vehicle = options_.vehicle, .step = observation.step};
  if (placement_ && !fits_route()) {
    report.reason = FallbackReason::kOffRoute;
    report.deviation_m = std::max(0.0, placement_->beyond_m());
  }
  report.subgraph = subgraph().spec().name;
  if (in_force_) say_what_is_in_force(report);
  return report;
}

void Controller::say_what_is_in_force(Report& report) const {
  const Plan& plan = plan_in_force();
  report.planned_pose = plan.pose_at(report.step);
  report.planned_trim = plan.trim_at(report.step);
  report.maneuver = plan.maneuver_during(report.step).label;
}

/// The route that the vehicle fits best, and its place there.
void Controller::take_route(const Pose& measured) {
  const UniversalAutomaton& automaton = subgraph().automaton();
  const Pose pose = pose_of_measured(measured, 0.0, automaton.vehicle, automaton.identified);
  std::optional<double> best_m;
  for (std::size_t i = 0; i < routes_->size(); ++i) {
    const DrivableRoute& route = (*routes_)[i];
    const Placement placement = placement_on(route, pose, automaton.vehicle.footprint);
    const double off_m = misfit_m(placement) + (fits(placement, route) ? 0.0 : kFitsNot_m);
    if (best_m && off_m >= *best_m) continue;
    best_m = off_m;
    route_ = i;
    placement_ = placement;
  }
  path_s_m_ = placement_->s_m;
  sets_out_ = true;
}

Traffic Controller::observe(const Observation& observation) {
  assert(has_plan());
  const StepIndex now = observation.step;
  former_heard_ = std::move(step_.heard);
  former_problem_.reset();
  if (!step_.problems.empty()) former_problem_ = std::move(step_.problems.front());
  step_ = Step{};
  step_.observation = observation;
  step_.report = {.vehicle = options_.vehicle, .step = now};
  const PlanWatch watched = in_force_->watch(measured(options_.vehicle), now);
  step_.report.deviation_m = watched.deviation_m;
  if (watched.is_disturbed) step_.obstacle = FallbackReason::kDeviation;
  sets_out_ = sets_out_ || watched.is_anchored_anew;
  step_.report.subgraph = subgraph().spec().name;
  say_what_is_in_force(step_.report);

  const StepIndex next{now.value + 1};
  Traffic& traffic = step_.traffic;
  traffic.vehicle = options_.vehicle;
  traffic.step = now;
  traffic.next_pose = in_force_->base().pose_at(next);
  traffic.next_trim = in_force_->base().trim_at(next);
  traffic.running = in_force_->areas_to_tell(now);
  std::vector<ConvexPolygon> reach;
  reach.reserve(traffic.running.areas_m.size() + 3);
  reach.push_back(
      transformed(on_.reachable->swept_area_until_m(traffic.next_trim, options_.horizon_steps + 1),
                  traffic.next_pose));
  const auto add = [&reach](const ConvexPolygon& area) {  // most lie within the first
    if (!contains(reach.front(), area)) reach.push_back(area);
  };
  std::ranges::for_each(traffic.running.areas_m, add);
  add(traffic.running.final_area_m);
  if (former_) {
    add(transformed(
        former_->on.reachable->swept_area_until_m(traffic.next_trim, options_.horizon_steps + 1),
        traffic.next_pose));
  }
  traffic.reachable_area_m = convex_hull(reach);
  for (const VehicleId other : observation.active) {
    if (other == options_.vehicle) continue;
    const auto heard = last_heard_.try_emplace(other, now).first->second;
    if (now.value >= heard.value + kSilentSteps) traffic.silent.push_back(other);
  }
  return traffic;
}

void Controller::couple(std::span<const Traffic> heard) {
  const StepIndex now = step_.observation.step;
  std::vector<const Traffic*> traffic{&step_.traffic};
  for (const VehicleId other : step_.observation.active) {
    if (other == options_.vehicle) continue;
    const Traffic* message = find_message(heard, other, now);
    if (message == nullptr) {
      step_.report.missing.push_back(other);
      continue;
    }
    traffic.push_back(&note_heard(*message));
    last_heard_[other] = now;
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

/// Written over what the same vehicle said a step ago: as many areas again.
const Traffic& Controller::note_heard(const Traffic& message) {
  auto node = former_heard_.extract(message.vehicle);
  if (node.empty()) return step_.heard[message.vehicle] = message;
  node.mapped() = message;
  return step_.heard.insert(std::move(node)).position->second;
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
  const std::size_t most = strict ? 2 * step_.coupled.size() : step_.predecessors.size();
  for (auto& areas : problem.obstacles_m) areas.reserve(most);
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
  const double step_s = subgraph().automaton().step_s;
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

/// How far the vehicle can get in a horizon.
double Controller::reach_m() const {
  const auto reach_in = [this](const ReachableSets& reachable) {
    return reachable.max_distance_m(step_.traffic.next_trim, options_.horizon_steps, 0);
  };
  return std::max(reach_in(*on_.reachable), former_ ? reach_in(*former_->on.reachable) : 0.0);
}

double Controller::project(const Point& position_m) const {
  const ReferencePath& path = route().path;
  if (!path_s_m_) return path.project(position_m).s_m;
  return path
      .project_within(position_m, *path_s_m_ - kProjectionBack_m,
                      *path_s_m_ + reach_m() + kProjectionBack_m)
      .s_m;
}

std::optional<double> Controller::path_s_m_of(const Point& position_m) const {
  if (!path_s_m_) return std::nullopt;
  return project(position_m);
}

/// Without the other vehicles.
HorizonProblem Controller::problem_alone(const Corridor& corridor) const {
  const UniversalAutomaton& automaton = subgraph().automaton();
  const Traffic& own = step_.traffic;
  HorizonProblem problem{.start = own.next_pose, .start_trim = own.next_trim};
  Reference reference =
      reference_points(route().path, *path_s_m_, automaton.trims[own.next_trim.index].speed_mps,
                       options_.reference_speed_mps, options_.horizon_steps, automaton.step_s,
                       options_.reference_rule);
  problem.reference_m = std::move(reference.points_m);
  problem.reference_speed_mps = std::move(reference.speeds_mps);
  problem.boundary_m = corridor.boundary_m(*path_s_m_ - kBoundaryReserve_m,
                                           *path_s_m_ + reach_m() + kBoundaryReserve_m);
  return problem;
}

/// Where the vehicle may drive: at the start in an area that leads into its lanes, if need be, and
/// in them as soon as the plan in force lies there.
void Controller::look_at_lanes() {
  const StepIndex next{step_.observation.step.value + 1};
  const Plan& base = in_force_->base();
  const Footprint& footprint = subgraph().automaton().vehicle.footprint;
  const auto lies_in_lanes = [&] {
    return keeps_to(base, next, problem_alone(route().corridor).boundary_m) &&
           lies_inside(route(), base.pose_at(std::max(base.end(), next)), footprint);
  };
  const bool stands = base.end() <= next;
  const auto area_from_here = [&] {
    const Placement placement = placement_on(route(), step_.traffic.next_pose, footprint);
    path_s_m_ = placement.s_m;
    return join(
        route(), placement, step_.traffic.next_pose, reach_m(), footprint,
        [this](const Corridor& corridor) { return problem_alone(corridor); },
        [this](const HorizonProblem& problem) {
          step_.joining_problems.push_back(problem);
          return engine_->search(problem);
        });
  };
  const bool has_rested = has_rested_for_long();
  if (stands && (sets_out_ || (joining_.is_possible && !joining_.area && !lies_in_lanes()))) {
    joining_ = area_from_here();
    sets_out_ = false;
  } else if (has_rested && joining_.is_possible && !joining_.area) {
    // It may as well wait for somebody: only a way out counts.
    if (Joining way_out = area_from_here(); way_out.area) joining_ = std::move(way_out);
  }
  if (!joining_.is_possible) {
    step_.obstacle = joining_.is_certain ? FallbackReason::kOffRoute : FallbackReason::kBudget;
  }
  // A vehicle that stands in its lanes may need the area to drive off.
  if (joining_.area && !stands && !rests_since_ && lies_in_lanes()) joining_.area.reset();
}

/// True once in every horizon in which the plan in force was to stay where it is. Not with the
/// cost-to-go of 2022, whose drives are to be the paper's.
bool Controller::has_rested_for_long() {
  const StepIndex next{step_.observation.step.value + 1};
  const Plan& base = in_force_->base();
  const Pose& from = base.pose_at(next);
  const bool rests = subgraph().automaton().trims[base.trim_at(next).index].is_equilibrium() &&
                     from == base.pose_at(std::max(base.end(), next));
  if (!rests) {
    rests_since_.reset();
    return false;
  }
  if (options_.search.cost_to_go == CostToGo::kReferenceSpeed) return false;
  rests_since_ = rests_since_.value_or(next);
  const std::uint64_t rested = next.value - rests_since_->value;
  return rested > 0 && rested % options_.horizon_steps == 0;
}

HorizonProblem Controller::pose_problem() {
  HorizonProblem problem = problem_alone(joining_.area ? *joining_.area : route().corridor);
  problem.obstacles_m.resize(options_.horizon_steps);
  add_coupled_obstacles(problem);
  add_missing_obstacles(problem);
  problem.incumbent = incumbent();
  return problem;
}

/// The rest of the plan in force, then standing: driven on, it is a plan too, as long as it starts
/// where planning starts. Not with the cost-to-go of 2022, whose counts are to be the paper's.
std::vector<const Maneuver*> Controller::incumbent() const {
  std::vector<const Maneuver*> maneuvers;
  maneuvers.reserve(options_.horizon_steps);
  if (in_force_->is_moved() || options_.search.cost_to_go == CostToGo::kReferenceSpeed)
    return maneuvers;
  const std::uint64_t now = step_.observation.step.value;
  for (std::size_t j = 1; j <= options_.horizon_steps; ++j) {
    maneuvers.push_back(&plan_in_force().maneuver_during({now + j}));
  }
  return maneuvers;
}

PlanQuality Controller::quality_of(SearchStatus found) {
  switch (found) {
    case SearchStatus::kOptimal:
      return PlanQuality::kOptimal;
    case SearchStatus::kUnproven:
      return PlanQuality::kUnproven;
    case SearchStatus::kBudget:
      return PlanQuality::kBudget;
    case SearchStatus::kFallback:
      break;
  }
  return PlanQuality::kNone;
}

/// What is found on a subgraph is the candidate, unless its drift leads into something.
void Controller::search_candidate(StepIndex next, SearchEngine& engine, const Subgraph& on) {
  const SearchResult result = engine.search(step_.problems.back());
  step_.report.generated += result.generated;
  step_.report.expanded += result.expanded;
  if (result.status == SearchStatus::kFallback) {
    step_.obstacle =
        result.reason == NoPath::kBudget ? FallbackReason::kBudget : FallbackReason::kInfeasible;
    return;
  }
  step_.report.subgraph = on.spec().name;
  step_.report.cost_m2 = result.cost;
  step_.report.quality = quality_of(result.status);
  step_.report.gap_m2 =
      result.status == SearchStatus::kOptimal ? 0.0 : result.cost - result.lower_bound;
  step_.candidate = in_force_->base().continued(
      next, result.maneuvers, *own_step(on.automaton(), result.maneuvers.back()->to),
      on.shared_automaton());
  step_.prediction.areas = in_force_->areas_of(*step_.candidate, next);
  if (!is_candidate_drivable()) {
    step_.candidate.reset();
    step_.obstacle = FallbackReason::kUndrivable;
  } else if (!is_candidate_free()) {
    step_.candidate.reset();
    step_.obstacle = FallbackReason::kConflict;
  }
}

void Controller::find_candidate(StepIndex next, SearchEngine& engine, const Subgraph& on) {
  search_candidate(next, engine, on);
  if (step_.obstacle != FallbackReason::kConflict) return;
  HorizonProblem without_drift = step_.problems.back();  // only for its drift: try without any
  without_drift.avoids_steering_limit = true;
  step_.problems.push_back(std::move(without_drift));
  step_.obstacle = FallbackReason::kNone;
  search_candidate(next, engine, on);
}

/// After a switch, if there is no candidate on what is planned on now.
void Controller::plan_on_former(StepIndex next) {
  if (step_.candidate || step_.observation.step > former_->last) {
    former_.reset();
    return;
  }
  // A second search would take as long again: what is left is for the next step.
  if (step_.obstacle == FallbackReason::kBudget) return;
  step_.obstacle = FallbackReason::kNone;
  if (step_.problems.size() > 1) step_.problems.push_back(step_.problems.front());
  find_candidate(next, *former_->engine, *former_->on.subgraph);
}

/// The command that the plan would become is looked at before anybody is told of it.
bool Controller::is_candidate_drivable() const {
  if (!options_.lab) return true;
  const UniversalAutomaton& automaton = subgraph().automaton();
  return !trajectory_fault(
      sample_trajectory(*step_.candidate, step_.observation.step, options_.lab->point_interval_s,
                        0.0, automaton.step_s, automaton.vehicle),
      options_.lab);
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
  if (step_.obstacle == FallbackReason::kNone &&
      subgraph().distance_to_standstill(step_.traffic.next_trim) > options_.horizon_steps) {
    step_.obstacle =
        FallbackReason::kInfeasible;  // a trim that is off, with no way out or a long one
  }
  if (!drives_out_ && step_.obstacle == FallbackReason::kNone) {
    path_s_m_ = project(step_.traffic.next_pose.position_m());
    look_at_lanes();
  }
  if (!drives_out_ && step_.obstacle == FallbackReason::kNone) {
    step_.problems.push_back(pose_problem());
    find_candidate(next, *engine_, subgraph());
    if (former_) plan_on_former(next);
  }
  step_.prediction.vehicle = options_.vehicle;
  step_.prediction.step = now;
  step_.prediction.is_new = step_.candidate.has_value();
  if (!step_.candidate) step_.prediction.areas = in_force_->areas_to_tell(next);
  return step_.prediction;
}

/// The search has kept the swept areas free, and they are within reach; those that hold a drift may
/// be larger.
bool Controller::is_candidate_free() const {
  const std::uint64_t next = step_.observation.step.value + 1;
  const OccupiedAreas& areas = step_.prediction.areas;
  const auto is_in_reach = [this](const ConvexPolygon& area) {
    return contains(step_.traffic.reachable_area_m, area, kReachRounding_m);
  };
  if (in_force_->may_drift(*step_.candidate) &&
      !(std::ranges::all_of(areas.areas_m, is_in_reach) && is_in_reach(areas.final_area_m))) {
    return false;
  }
  const auto& obstacles_m = step_.problems.back().obstacles_m;
  for (std::size_t j = 0; j < obstacles_m.size(); ++j) {
    const ConvexPolygon& area = areas.during({next + j});
    if (std::ranges::any_of(obstacles_m[j], [&area](const ConvexPolygon& obstacle) {
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

std::vector<Controller::ToldPlan> Controller::told_plans() const {
  std::vector<ToldPlan> plans;
  for (const auto& [other, traffic] : step_.heard) {
    const auto respected = step_.respected.find(other);
    const auto settled = step_.settled.find(other);
    if (respected != step_.respected.end() && respected->second.is_new) {
      plans.push_back({other, respected->second.areas});
    } else if (settled != step_.settled.end()) {
      plans.push_back({other, settled->second});
    } else {
      plans.push_back({other, traffic.running});
    }
  }
  return plans;
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
  if (options_.settle_rule == SettleRule::kStrict) note_settled(predictions);
  if (!step_.candidate) return finish(false, step_.obstacle);
  const SettleVerdict verdict = options_.settle_rule == SettleRule::kStrict
                                    ? strict_verdict(predictions)
                                    : agreed_verdict(outcomes);
  return finish(verdict == SettleVerdict::kInForce, reason_of(verdict));
}

/// For told_plans; the predecessors' are known already.
void Controller::note_settled(std::span<const Prediction> predictions) {
  for (const VehicleId other : step_.coupled) {
    if (step_.respected.contains(other)) continue;
    const Prediction* message = find_message(predictions, other, step_.observation.step);
    if (message != nullptr && message->is_new) step_.settled[other] = message->areas;
  }
}

Report Controller::give_up(FallbackReason reason) { return finish(false, reason); }

Report Controller::finish(bool accepted, FallbackReason reason) {
  Report& report = step_.report;
  if (accepted) {
    step_.replaced = in_force_->replace(std::move(*step_.candidate), step_.prediction.areas,
                                        step_.observation.step);
    report.status = StepStatus::kPlanned;
  } else {
    report.status = drives_out_ ? StepStatus::kDriveOut : StepStatus::kFallback;
    report.reason = drives_out_ ? FallbackReason::kNone : reason;
  }
  step_.candidate.reset();
  return report;
}

}  // namespace hlc
