#include "planner/apps/joint_plan.hpp"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "planner/apps/fitted_table.hpp"
#include "planner/scenario/engine_choice.hpp"
#include "planner/search/search_options.hpp"

namespace hlc::apps {
namespace {

using Json = nlohmann::ordered_json;
using joint_search::JointPlan;
using search::SearchStatus;

Json cost_or_null(const JointPlan& plans) {
  return plans.empty() ? Json(nullptr) : Json(joint_search::cost_of(plans));
}

Json to_json(const search::SearchResult& plan) {
  Json json{{"cost", plan.cost}, {"trims", Json::array()}, {"poses", Json::array()}};
  for (const automaton::Maneuver* maneuver : plan.maneuvers) {
    json["trims"].push_back(maneuver->to.index + 1);
  }
  for (const Pose& pose : plan.poses) {
    json["poses"].push_back({pose.x_m, pose.y_m, pose.heading_rad});
  }
  return json;
}

std::string cost_text(const JointPlan& plans) {
  return plans.empty() ? "no plan" : fmt::format("{:.9g} m^2", joint_search::cost_of(plans));
}

std::string result_text(const scenario::JointProblemFile& file, const TimedSolution& timed) {
  const joint_search::JointSolution& solution = timed.solution;
  const joint_search::JointSearchResult& joint = solution.joint;
  const bool has_plan = !joint.plans.empty();
  std::string text = fmt::format(
      "vehicles         {}, engine {}, at most {} expansions in each of their searches\n"
      "status           {}{}\n"
      "alone            {}, without each other\n"
      "in this order    {}, each around those before it\n"
      "best order       {}\n",
      file.problems.size(), scenario::engine_name(file.search), file.search.max_expansions,
      search::to_string(joint.status),
      has_plan ? "" : fmt::format(": {}", search::to_string(joint.reason)),
      cost_text(solution.alone), cost_text(solution.constant_order),
      cost_text(solution.best_order));
  if (has_plan) {
    text += fmt::format("jointly          {:.9g} m^2, {}\n", joint.cost,
                        joint.status == SearchStatus::kOptimal
                            ? "no joint plan costs less"
                            : fmt::format("one that costs up to {:.9g} m^2 less may exist",
                                          joint.cost - joint.lower_bound));
  }
  return text +
         fmt::format("joint search     {} nodes, {} vertices expanded; {:.1f} us with all orders\n",
                     joint.nodes, joint.expanded, timed.planning_us);
}

std::string plan_table(const TimedSolution& timed) {
  const joint_search::JointSolution& solution = timed.solution;
  std::string text = fmt::format("{:>7}  {:>12}  {:>14}  trims after each step\n", "vehicle",
                                 "cost [m^2]", "alone [m^2]");
  for (std::size_t i = 0; i < solution.joint.plans.size(); ++i) {
    std::string trims;
    for (const automaton::Maneuver* maneuver : solution.joint.plans[i].maneuvers) {
      trims += fmt::format(" {}", maneuver->to.index + 1);
    }
    // Without the others a search may use up a budget that suffices with them.
    text += fmt::format(
        "{:>7}  {:>12.6f}  {:>14} {}\n", i + 1, solution.joint.plans[i].cost,
        solution.alone.empty() ? "-" : fmt::format("{:.6f}", solution.alone[i].cost), trims);
  }
  return text;
}

}  // namespace

TimedSolution solve(const scenario::JointProblemFile& file,
                    const joint_search::JointSearchOptions& options) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  TimedSolution timed{.solution =
                          joint_search::solve(*file.subgraph, file.search, file.problems, options)};
  timed.planning_us = std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
  return timed;
}

std::string json_of(const TimedSolution& timed) {
  const joint_search::JointSolution& solution = timed.solution;
  const joint_search::JointSearchResult& joint = solution.joint;
  const bool has_plan = !joint.plans.empty();
  Json json;
  json["status"] = search::to_string(joint.status);
  json["reason"] = search::to_string(joint.reason);
  json["cost"] = has_plan ? Json(joint.cost) : Json(nullptr);
  json["lower_bound"] = has_plan ? Json(joint.lower_bound) : Json(nullptr);
  json["gap"] = has_plan ? Json(joint.cost - joint.lower_bound) : Json(nullptr);
  json["alone"] = cost_or_null(solution.alone);
  json["constant_order"] = cost_or_null(solution.constant_order);
  json["best_order"] = cost_or_null(solution.best_order);
  json["vehicles"] = Json::array();
  for (const search::SearchResult& plan : joint.plans) json["vehicles"].push_back(to_json(plan));
  json["nodes"] = joint.nodes;
  json["expanded"] = joint.expanded;
  json["planning_us"] = timed.planning_us;
  return json.dump();
}

void print(const scenario::JointProblemFile& file, const TimedSolution& timed) {
  fmt::print("{}", fitted_lines(result_text(file, timed)));
  if (!timed.solution.joint.plans.empty()) fmt::print("\n{}", fitted_table(plan_table(timed)));
}

}  // namespace hlc::apps
