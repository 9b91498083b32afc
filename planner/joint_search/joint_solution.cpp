#include "planner/joint_search/joint_solution.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/joint_search/prioritized.hpp"
#include "planner/search/search_options.hpp"

namespace hlc::joint_search {

JointSolution solve(const automaton::Subgraph& subgraph, const search::SearchOptions& search,
                    std::span<const search::HorizonProblem> problems,
                    const JointSearchOptions& options) {
  if (!search::is_admissible(search.cost_to_go)) {
    throw std::invalid_argument(fmt::format(
        "cost_to_go = {}, must be reachable or straight_line for a joint problem: its optimum is "
        "bounded by that of each vehicle",
        search::to_string(search.cost_to_go)));
  }
  const automaton::ReachableSets reachable(subgraph, problems.front().horizon_steps());
  const auto engine = search::make_search_engine(subgraph, reachable, search);
  JointProblem problem;
  for (const search::HorizonProblem& one : problems) {
    problem.push_back({.problem = one, .engine = engine.get()});
  }
  JointSolution solution;
  solution.alone = plan_alone(problem);
  solution.constant_order = plan_in_order(problem, constant_order(problem.size()));
  solution.best_order = plan_in_best_order(problem);
  solution.joint = search_jointly(problem, options, solution.best_order);
  return solution;
}

}  // namespace hlc::joint_search
