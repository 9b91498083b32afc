// What a controller searches in a step: the problems that it poses, and its candidate.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "planner/common/demand.hpp"
#include "planner/controller/controller.hpp"
#include "planner/controller/held_up.hpp"
#include "planner/controller/making_room.hpp"
#include "planner/controller/plan_end.hpp"
#include "planner/controller/set_off.hpp"
#include "planner/controller/way_off.hpp"

namespace hlc::controller {
namespace {

/// Costs are sums of squares of metres; rounding is far below.
constexpr double kLeastGain_m2 = 1e-9;
/// A plan that gets less far stands; one that gets so much farther than another one is a gain.
constexpr double kStanding_m = 1e-3;
constexpr double kSamePlace_m = 1e-4;  ///< of two ends of plans; and rad
/// Shares of the way to the end that is not permitted, at which the reference ends instead.
constexpr std::array kNearerEnds{0.75, 0.5, 0.25, 0.1};
/// The search of each may use one expansion in so many of those that a search may use.
constexpr std::size_t kNearerEndShare = 4;
/// The search of a way off from where a plan ends, of which there are at most twelve for a problem.
constexpr std::size_t kWayOffShare = 16;
/// No expansion at all: the incumbent is found if it is a path.
constexpr std::size_t kIncumbentOnly = search::SearchOptions::kMostExpansions;

bool moves(const coordination::Plan& plan, StepIndex next) {
  const Pose end = plan.pose_at(std::max(plan.end(), next));
  return (end.position_m() - plan.pose_at(next).position_m()).norm() > kStanding_m;
}

bool ends_as(const coordination::Plan& one, const coordination::Plan& other, StepIndex next) {
  const StepIndex end = std::max(one.end(), next);
  const StepIndex other_end = std::max(other.end(), next);
  const Pose apart = between(other.pose_at(other_end), one.pose_at(end));
  return apart.position_m().norm() < kSamePlace_m && std::abs(apart.heading_rad) < kSamePlace_m &&
         one.trim_at(end) == other.trim_at(other_end);
}

/// Those of a plan found before, and the counts of all searches since.
void take_figures(coordination::Report of_plan, coordination::Report& report) {
  of_plan.generated = report.generated;
  of_plan.expanded = report.expanded;
  report = std::move(of_plan);
}

/// A candidate after further searches: of all their problems that of its plan is the last.
PlanCandidate found_before(PlanCandidate candidate, std::vector<SearchedProblem> problems) {
  const auto own = problems.begin() + static_cast<std::ptrdiff_t>(candidate.problems.size()) - 1;
  std::rotate(own, own + 1, problems.end());
  candidate.problems = std::move(problems);
  return candidate;
}

}  // namespace

search::HorizonProblem Controller::posed_alone(const ReferenceEnd& end) const {
  search::HorizonProblem problem = problem_in(entry_area() ? *entry_area() : route().corridor, end);
  if (!standing_m_.empty()) problem.obstacles_m.assign(problem.horizon_steps(), standing_m_);
  if (step_.left_out.boundary) problem.boundary_m.clear();
  return problem;
}

search::HorizonProblem Controller::pose_problem(CoupledObstacleRule rule) const {
  const bool has_end = authority_ && !step_.left_out.authority;
  search::HorizonProblem problem = posed_alone(
      has_end ? ReferenceEnd{authority_->end_s_m(tracker_.s_m().value())} : ReferenceEnd{});
  problem.obstacles_m = obstacles_m(rule);
  for (auto& areas_m : problem.obstacles_m)
    std::ranges::copy(standing_m_, std::back_inserter(areas_m));
  std::vector<VehicleId> guests = neighbours_.guests().seen();
  std::erase_if(guests, [this](VehicleId guest) { return step_.left_out.holds(guest); });
  problem.avoided_in_motion_m = neighbours_.guests().avoided_in_motion_m(
      guests, options_.horizon_steps, subgraph().automaton().step_s);
  if (has_end) {
    const ConvexPolygon bar_m =
        authority_->bar_m(tracker_, subgraph().automaton().vehicle.footprint);
    for (auto& areas_m : problem.obstacles_m) areas_m.push_back(bar_m);
  }
  // The plan in force, continued, is a plan too, as long as it starts where planning starts.
  if (!in_force_->is_moved()) {
    problem.incumbent =
        options_.strategies.incumbent(plan_in_force(), step_.next(), options_.horizon_steps);
  }
  return problem;
}

/// Where a standing vehicle would put off setting off, the plan in force is the candidate, as long
/// as it is a path of this step's problem: what has come into its way since is kept clear. Once the
/// plan is in force (`search_again`), there is no former one to compare with.
void Controller::search_candidate() {
  const search::HorizonProblem own = pose_problem(options_.strategies.coordination.obstacles);
  const bool is_first = authority_ && !step_.former_end_s_m;
  if (is_first) {
    step_.former_end_s_m = end_s_m(in_force_->base(), step_.next(), tracker_, reach_m());
  }
  const bool is_own = !make_room(own) && find_candidate(own, 1);
  const PlanCandidate& found = step_.candidate;
  if (is_first && is_own && !in_force_->is_moved() &&
      puts_off(*found.plan, in_force_->base(), step_.next())) {
    PlanCandidate later = found;
    coordination::Report report = step_.report;
    search::HorizonProblem problem = found.problems.back().problem;
    problem.incumbent = own.incumbent;
    search_plan(std::move(problem), kIncumbentOnly);
    std::vector<SearchedProblem> problems = later.problems;
    if (step_.candidate.plan) {
      step_.report.gap_m2 = step_.report.cost_m2 - (report.cost_m2 - report.gap_m2);
    } else {
      step_.candidate = std::move(later);
      take_figures(std::move(report), step_.report);
    }
    step_.candidate.problems = std::move(problems);
  }
  step_.obstacle = step_.candidate.obstacle;
}

bool Controller::find_candidate(const search::HorizonProblem& problem, std::size_t budget_share) {
  search_plan(problem, budget_share);
  step_.cost_m2 = step_.report.cost_m2;
  if (!authority_ || !step_.candidate.plan) return step_.candidate.plan.has_value();
  keep_in_lane_where_held_up(problem, budget_share);
  if (!ends_where_permitted(*step_.candidate.plan, problem)) find_nearer_end(problem, budget_share);
  return step_.candidate.plan.has_value();
}

/// Where the plan in force ends a plan may end, too, whatever has come beside that place since; and
/// if there is no way off from there either, it may end anywhere. The report does not count these
/// searches, whose problems are not those of a plan.
bool Controller::ends_where_permitted(const coordination::Plan& plan,
                                      const search::HorizonProblem& in) {
  const coordination::Plan& in_force = in_force_->base();
  const StepIndex next = step_.next();
  const double end_m = end_s_m(plan, next, tracker_, reach_m());
  if (!ends_along_lane(plan, in_force, next, tracker_, reach_m())) return false;
  if (step_.left_out.authority) return true;
  if (!authority_->reaches(end_m, tracker_.s_m().value())) return false;
  if (ends_as(plan, in_force, next)) return true;
  const vehicle::VehicleParameters& vehicle = subgraph().automaton().vehicle;
  const auto has_way_off = [&](const coordination::Plan& from) {
    const std::optional<search::HorizonProblem> problem =
        way_off_problem(from, in, next, tracker_, reach_m(), vehicle);
    if (!problem) return true;
    return may_lead_off(search_.search(*problem, kWayOffShare), *problem, vehicle);
  };
  return has_way_off(plan) || !has_way_off(in_force);
}

/// With a reference that ends nearer, a plan gets less far around a bend, and ends elsewhere. It
/// has to get farther than the former plan, which is driven on otherwise, and the report keeps the
/// figures of the plan that is dropped. But if the former one is no longer a path, because
/// something has come into its way, a plan that keeps clear of it is better than one that ends
/// well, unless it ends beyond the authority.
void Controller::find_nearer_end(const search::HorizonProblem& problem, std::size_t budget_share) {
  const auto end_m = [&](const coordination::Plan& plan) {
    return end_s_m(plan, step_.next(), tracker_, reach_m());
  };
  const double s_m = tracker_.s_m().value();
  const double way_m = end_m(*step_.candidate.plan) - s_m;
  coordination::Report report = step_.report;
  PlanCandidate first = step_.candidate;
  for (const double share : kNearerEnds) {
    search_plan(
        with_reference_of(problem, posed_alone({.s_m = s_m + share * way_m, .is_held_up = true})),
        kNearerEndShare * budget_share);
    const std::optional<coordination::Plan>& plan = step_.candidate.plan;
    const bool gets_farther = plan && end_m(*plan) > step_.former_end_s_m.value() + kStanding_m;
    if (gets_farther && ends_where_permitted(*plan, problem)) return;
  }
  std::vector<SearchedProblem> problems = step_.candidate.problems;
  const bool makes_room = budget_share != 1;
  const bool is_beyond = !step_.left_out.authority && !authority_->reaches(end_m(*first.plan), s_m);
  bool is_former_free = true;
  if (!makes_room && !is_beyond && !problem.incumbent.empty()) {
    search_plan(problem, kIncumbentOnly);
    is_former_free = step_.candidate.plan.has_value();
  }
  take_figures(std::move(report), step_.report);
  step_.candidate = found_before(std::move(first), std::move(problems));
  if (!is_former_free) return;
  step_.candidate.plan.reset();
  step_.candidate.obstacle = coordination::FallbackReason::kInfeasible;
}

/// The second plan replaces the first one also if it ends askew, and it is searched also where the
/// first search has used up its expansions: the first may leave the lane. But where it stands and
/// the first one gets on to a permitted end, this one stays: a vehicle between a kerb and another
/// one may get on a little in each step, though first across its lane, and its knot waits for it.
void Controller::keep_in_lane_where_held_up(const search::HorizonProblem& problem,
                                            std::size_t budget_share) {
  const std::optional<double> held_up_m =
      held_up_at_m(*step_.candidate.plan, step_.next(), problem, tracker_, reach_m());
  if (!held_up_m) return;
  search::HorizonProblem within =
      with_reference_of(problem, posed_alone({.s_m = *held_up_m, .is_held_up = true}));
  within.incumbent =
      options_.strategies.incumbent(*step_.candidate.plan, step_.next(), options_.horizon_steps);
  PlanCandidate first = step_.candidate;
  coordination::Report report = step_.report;
  search_plan(std::move(within), budget_share);
  const std::optional<coordination::Plan>& second = step_.candidate.plan;
  const bool only_first_moves = second && !moves(*second, step_.next()) &&
                                moves(*first.plan, step_.next()) &&
                                ends_where_permitted(*first.plan, problem);
  if (second && !only_first_moves) return;
  step_.candidate = found_before(std::move(first), std::move(step_.candidate.problems));
  take_figures(std::move(report), step_.report);
}

/// The problems of former searches stay.
void Controller::search_plan(search::HorizonProblem problem, std::size_t budget_share) {
  std::vector<SearchedProblem> problems = std::move(step_.candidate.problems);
  step_.candidate = search_.find(std::move(problem),
                                 {.in_force = *in_force_,
                                  .now = step_.observation.step,
                                  .reachable_area_m = step_.traffic.reachable_area_m,
                                  .lab = options_.lab,
                                  .budget_share = budget_share},
                                 step_.report);
  std::ranges::move(step_.candidate.problems, std::back_inserter(problems));
  step_.candidate.problems = std::move(problems);
}

bool Controller::make_room(const search::HorizonProblem& own) {
  std::vector<const coordination::OccupiedAreas*> desired;
  for (const VehicleId other : predecessors()) {
    const CoupledVehicle one = coupled_vehicle(other);
    if (makes_room_for(one) && !step_.left_out.holds(other))
      desired.push_back(&*one.prediction->desired);
  }
  if (desired.empty()) return false;
  const auto is_found_beyond = [&](std::size_t from) {
    return find_candidate(making_room(own, desired, step_.next(), from), kMakingRoomShare);
  };
  return is_found_beyond(0) || is_found_beyond(options_.horizon_steps - 1);
}

std::optional<coordination::OccupiedAreas> Controller::desired_areas() {
  const bool is_last = coupled().size() == predecessors().size();
  if (!options_.strategies.coordination.makes_room || is_last) return std::nullopt;
  const search::SearchResult result =
      search_.search(pose_problem(&desired_plans_of_predecessors), kMakingRoomShare);
  const bool is_better = !step_.candidate.plan || result.cost < step_.cost_m2 - kLeastGain_m2;
  if (result.maneuvers.empty() || !is_better) return std::nullopt;
  return in_force_->areas_of(plan_of(result.maneuvers), step_.next());
}

void Controller::note_bound(coordination::Report& report) {
  report.bound_m2.reset();
  if (report.status != coordination::StepStatus::kPlanned) return;
  HLC_DEMAND(!problems().empty());
  const SearchedProblem& own = problems().back();
  if (own.subgraph != prepared_subgraph().subgraph) return;  // found on the former one
  const search::HorizonProblem relaxed = with_reference_of(
      pose_problem(options_.strategies.coordination.lasting_obstacles), own.problem);
  if (relaxed.obstacles_m == own.problem.obstacles_m && !own.problem.avoids_steering_limit) {
    report.bound_m2 = report.cost_m2 - report.gap_m2;
    return;
  }
  // A search that stops early has a bound, too.
  const search::SearchResult result = search_.search(relaxed, kMakingRoomShare);
  if (!result.maneuvers.empty()) report.bound_m2 = result.lower_bound;
}

PlanWithout Controller::plan_without(const LeftOut& left_out) const {
  return Controller(*this).search_again(left_out);
}

PlanWithout Controller::plan_without(const LeftOut& left_out, const PreparedSubgraph& on) const {
  Controller other = *this;
  other.search_ = CandidateSearch(on, options_.search, options_.horizon_steps);
  return other.search_again(left_out);
}

/// The plan in force continues as in the step's own search: up to t(k+1) one that has come into
/// force is the former one. From there on it is the incumbent of these searches.
PlanWithout Controller::search_again(const LeftOut& left_out) {
  HLC_DEMAND(!problems().empty());
  step_.left_out = left_out;
  if (left_out.obstacles) standing_m_.clear();
  step_.candidate = {};
  search_candidate();
  return {.plan = step_.candidate.plan,
          .cost_m2 = step_.report.cost_m2,
          .problem = step_.candidate.problems.back().problem};
}

}  // namespace hlc::controller
