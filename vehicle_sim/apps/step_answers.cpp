#include "vehicle_sim/apps/step_answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "planner/plot/search_words.hpp"
#include "planner/right_of_way/conflict_zones.hpp"
#include "planner/search/alternatives.hpp"
#include "planner/search/search_engine.hpp"
#include "planner/search/search_options.hpp"

namespace hlc::apps {
namespace {

using controller::Controller;
using controller::LeftOut;
using controller::PlanWithout;
using coordination::FallbackReason;
using coordination::PlanQuality;
using coordination::Report;
using coordination::StepStatus;

double ahead_m(const coordination::Plan& plan, StepIndex next) {
  double sum_m = 0.0;
  for (StepIndex step = next; step < plan.end(); ++step.value) {
    sum_m += (plan.pose_at({step.value + 1}).position_m() - plan.pose_at(step).position_m()).norm();
  }
  return sum_m;
}

/// Cost of the positions of a plan's steps from t(next) on in a problem that begins there [m^2]:
/// its whole cost but for the criteria of its maneuvers.
double position_cost_m2(const coordination::Plan& plan, StepIndex next,
                        const search::HorizonProblem& problem) {
  double sum_m2 = 0.0;
  for (std::size_t j = 0; j < problem.horizon_steps(); ++j) {
    sum_m2 += problem.position_cost_m2(j, plan.pose_at({next.value + j + 1}).position_m());
  }
  return sum_m2;
}

StepIndex next_of(const Controller& controller) { return {controller.last_step().value + 1}; }

/// True if the plan in force consists of these maneuvers from t(k+1) on.
bool is_in_force(const std::vector<const automaton::Maneuver*>& maneuvers,
                 const Controller& controller) {
  StepIndex step = controller.last_step();
  return std::ranges::all_of(maneuvers, [&](const automaton::Maneuver* maneuver) {
    ++step.value;
    return &controller.plan_in_force().maneuver_during(step) == maneuver;
  });
}

/// None if the plan in force is not that of the step's last problem, or the cost-to-go is no bound.
std::optional<ExplainedStep::Choice> choice_of(const Controller& controller) {
  search::SearchOptions options = controller.options().search;
  if (!search::is_admissible(options.cost_to_go)) return {};
  const auto& [problem, subgraph, max_expansions] = controller.problems().back();
  options.max_expansions = std::max<std::size_t>(max_expansions, 1);
  const controller::PreparedSubgraph& prepared = controller.prepared_subgraph();
  const controller::PreparedSubgraph on =
      subgraph == prepared.subgraph  // after a switch it may be the one before
          ? prepared
          : controller::prepare_subgraph(subgraph, problem.horizon_steps(), options);
  const search::SearchResult result =
      search::make_search_engine(*on.subgraph, *on.reachable, options, on.tables)->search(problem);
  if (result.maneuvers.empty() || !is_in_force(result.maneuvers, controller)) return {};
  const std::vector<search::Alternative> others = search::alternatives_to(
      result.maneuvers.front(), *on.subgraph, *on.reachable, options, problem, on.tables);
  ExplainedStep::Choice choice{.first = plot::name_of(*result.maneuvers.front()), .next_best = {}};
  if (const search::Alternative* const second = runner_up(others)) {
    choice.next_best = plot::name_of(*second->first);
    choice.extra_m2 = second->best.cost - result.cost;
  }
  return choice;
}

/// Searches the step's problem again without one limit after the other.
class Limits {
 public:
  explicit Limits(const Controller& controller)
      : controller_(controller), own_(controller.plan_without({})) {}

  /// Whether the step's search found what is in force, or nothing if that is why it fell back.
  [[nodiscard]] bool explain(const Report& report) const {
    if (report.status != StepStatus::kPlanned) return !own_.plan;
    if (!own_.plan) return false;
    StepIndex step = next_of(controller_);
    const StepIndex end{step.value + controller_.options().horizon_steps};
    for (; step < end; ++step.value) {
      if (&own_.plan->maneuver_during(step) != &controller_.plan_in_force().maneuver_during(step)) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] ExplainedStep::Limit without(std::string name, const LeftOut& left_out) const {
    return compared(std::move(name), controller_.plan_without(left_out));
  }

  /// On the other subgraph; adds nothing if it is that in force, or no plan can begin on it.
  void add_on(std::string name, const controller::PreparedSubgraph& on,
              std::vector<ExplainedStep::Limit>& limits) const {
    const TrimId from = controller_.problems().back().problem.start_trim;
    if (on.subgraph == controller_.prepared_subgraph().subgraph ||
        on.subgraph->distance_to_standstill(from) > controller_.options().horizon_steps) {
      return;
    }
    limits.push_back(compared(std::move(name), controller_.plan_without({}, on)));
  }

  /// With another reference speed; adds nothing if it is that of the step.
  void add_at(std::string name, double reference_speed_mps,
              std::vector<ExplainedStep::Limit>& limits) const {
    if (reference_speed_mps == controller_.options().reference_speed_mps) return;
    Controller other = controller_;
    other.set_reference_speed(reference_speed_mps);
    limits.push_back(compared(std::move(name), other.plan_without({})));
  }

 private:
  /// The problems differ in their references if the end of an authority cuts one of them, or the
  /// vehicle is held up elsewhere: both plans are compared in the problem without the limit.
  [[nodiscard]] ExplainedStep::Limit compared(std::string name, const PlanWithout& found) const {
    ExplainedStep::Limit limit{.name = std::move(name), .vehicle = {}, .note = {}};
    if (!found.plan) return limit;
    const StepIndex next = next_of(controller_);
    limit.ahead_m = ahead_m(*found.plan, next);
    if (!own_.plan) return limit;
    const double own_m2 = own_.cost_m2 + position_cost_m2(*own_.plan, next, found.problem) -
                          position_cost_m2(*own_.plan, next, own_.problem);
    limit.extra_m2 = found.cost_m2 - own_m2;
    return limit;
  }

  const Controller& controller_;
  PlanWithout own_;
};

std::vector<VehicleId> in_problem(const Report& report) {
  std::vector<VehicleId> vehicles = report.coupled;
  vehicles.insert(vehicles.end(), report.missing.begin(), report.missing.end());
  return vehicles;
}

void add_chosen(const Limits& limits, const policy::SubgraphSelector& chosen,
                const std::string& policy, std::vector<ExplainedStep::Limit>& found) {
  const policy::SubgraphSelector::Decision decision = chosen.decision();
  if (decision.zone) {
    const std::string name = zone_name(chosen, policy);
    limits.add_on(name, decision.choice->under(std::nullopt), found);
    limits.add_at(name, chosen.reference_speed_mps(), found);
  }
  if (decision.choice != decision.own) {
    limits.add_on(request_name(chosen, policy), decision.own->under(decision.subgraph_limit_mps),
                  found);
  }
}

/// What begins where the road that the vehicle holds ends.
std::string road_ahead(const Controller& controller, const Report& report) {
  const right_of_way::ConflictMap& map = *controller.options().conflicts;
  const std::uint32_t zone =
      report.held ? right_of_way::zone_behind(map, report.held->route,
                                              report.held->place_m + report.held->ahead_m)
                  : 0;
  return zone == 0 ? "the road ahead" : fmt::format("conflict zone {}, next,", zone);
}

/// Whether the step's search decided on what was driven.
bool is_by_search(const Report& report) {
  if (report.status == StepStatus::kPlanned) return report.quality != PlanQuality::kBudget;
  return report.reason == FallbackReason::kInfeasible;
}

}  // namespace

double ahead_m(const Controller& controller) {
  return controller.has_plan() ? ahead_m(controller.plan_in_force(), next_of(controller)) : 0.0;
}

std::string request_name(const policy::SubgraphSelector& chosen, const std::string& policy) {
  const policy::SubgraphSelector::Decision decision = chosen.decision();
  if (decision.choice == decision.own) return "";
  const std::string what = decision.choice->under(std::nullopt).subgraph->spec().name;
  if (decision.is_operators || !decision.policy) {
    return fmt::format("the fork's request ({})", what);
  }
  return fmt::format("rule {} of policy {} ({})", *decision.policy + 1, policy, what);
}

std::string zone_name(const policy::SubgraphSelector& chosen, const std::string& policy) {
  const std::optional<std::size_t> zone = chosen.decision().zone;
  if (!zone) return "";
  return fmt::format("zone {} of policy {} (at most {:g} m/s)", *zone + 1, policy,
                     chosen.limit_mps(*zone));
}

StepAnswers answers_of(const Controller& controller, const policy::SubgraphSelector& chosen,
                       const Report& report, const std::string& policy) {
  StepAnswers answers;
  if (controller.problems().empty() || !is_by_search(report)) return answers;
  if (report.status == StepStatus::kPlanned) answers.choice = choice_of(controller);
  const Limits limits(controller);
  if (!limits.explain(report)) return answers;
  const std::vector<VehicleId> vehicles = in_problem(report);
  const std::vector<VehicleId> withheld_by = controller.road_withheld_by();
  if (!vehicles.empty() || !withheld_by.empty()) {
    answers.alone =
        limits.without("", {.vehicles = vehicles, .authority = controller.has_authority()});
  }
  for (const VehicleId vehicle : vehicles) {
    answers.limits.push_back(limits.without("", {.vehicles = {vehicle}}));
    answers.limits.back().vehicle = vehicle;
  }
  answers.limits.push_back(limits.without("the lane boundary", {.boundary = true}));
  if (controller.has_authority()) {
    answers.limits.push_back(limits.without("the end of its right of way", {.authority = true}));
    if (!withheld_by.empty()) {
      answers.limits.back().note = fmt::format("{} is held by {}", road_ahead(controller, report),
                                               coordination::vehicles_text(withheld_by));
    }
  }
  if (controller.has_obstacles()) {
    answers.limits.push_back(limits.without("the obstacles", {.obstacles = true}));
  }
  add_chosen(limits, chosen, policy, answers.limits);
  return answers;
}

}  // namespace hlc::apps
