#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/joint_search/joint_solution.hpp"
#include "planner/scenario/engine_choice.hpp"
#include "planner/scenario/joint_problem_file.hpp"
#include "planner/scenario/problem_file.hpp"
#include "planner/search/search_engine.hpp"
#include "planner/search/search_options.hpp"
#include "vehicle_sim/python/module/arrays.hpp"
#include "vehicle_sim/python/module/bindings.hpp"

namespace hlc::python {
namespace {

struct SearchChoices {
  std::optional<std::string> engine;
  std::optional<std::string> cost_to_go;
  std::optional<std::size_t> max_expansions;

  void apply_to(search::SearchOptions& search) const {
    if (engine) scenario::choose_engine(*engine, search);
    if (cost_to_go) search.cost_to_go = search::cost_to_go_from_name(*cost_to_go);
    if (max_expansions) search.max_expansions = *max_expansions;
  }
};

scenario::ProblemFile read(const std::filesystem::path& path,
                           const std::optional<std::filesystem::path>& automaton,
                           const SearchChoices& choices) {
  if (scenario::is_joint_problem_file(path)) {
    throw std::invalid_argument(path.string() +
                                ": a joint problem, must be of one vehicle (plan_joint_problem)");
  }
  scenario::ProblemFile file = scenario::read_problem_file(path, automaton);
  try {
    choices.apply_to(file.search);
    scenario::check_can_be_searched(file);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(path.string() + ": " + error.what());
  }
  return file;
}

search::SearchResult solve(const scenario::ProblemFile& file) {
  const automaton::ReachableSets reachable(*file.subgraph, file.problem.horizon_steps());
  return search::make_search_engine(*file.subgraph, reachable, file.search)->search(file.problem);
}

py::dict dict_of(const search::HorizonProblem& problem, const search::SearchResult& result) {
  py::dict dict;
  dict["status"] = search::to_string(result.status);
  dict["reason"] = search::to_string(result.reason);
  const bool has_plan = result.status != search::SearchStatus::kFallback;
  dict["cost_m2"] = has_plan ? py::object(py::float_(result.cost)) : py::none();
  dict["lower_bound_m2"] = has_plan ? py::object(py::float_(result.lower_bound)) : py::none();
  dict["trims"] = column<std::int64_t>(
      result.maneuvers, [](const automaton::Maneuver* one) { return one->to.index; });
  py::list labels;
  for (const automaton::Maneuver* one : result.maneuvers) labels.append(one->label);
  dict["labels"] = labels;
  dict["poses"] = pose_table(result.poses);
  dict["generated"] = result.generated;
  dict["expanded"] = result.expanded;
  dict["start"] = pose_table(std::vector<Pose>{problem.start}).attr("reshape")(3);
  dict["reference_m"] = point_table(problem.reference_m);
  py::list obstacles;
  for (const std::vector<ConvexPolygon>& step : problem.obstacles_m) {
    py::list areas;
    for (const ConvexPolygon& one : step) areas.append(point_table(one.vertices_m));
    obstacles.append(areas);
  }
  dict["obstacles_m"] = obstacles;
  return dict;
}

py::object cost_or_none(const joint_search::JointPlan& plans) {
  return plans.empty() ? py::object(py::none())
                       : py::object(py::float_(joint_search::cost_of(plans)));
}

scenario::JointProblemFile read_joint(const std::filesystem::path& path,
                                      const std::optional<std::filesystem::path>& automaton,
                                      const SearchChoices& choices) {
  if (!scenario::is_joint_problem_file(path)) {
    throw std::invalid_argument(path.string() +
                                ": of one vehicle, must be a joint problem (key vehicles)");
  }
  scenario::JointProblemFile file = scenario::read_joint_problem_file(path, automaton);
  try {
    choices.apply_to(file.search);
    search::check_search_options(file.search);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(path.string() + ": " + error.what());
  }
  return file;
}

py::dict plan_joint_problem(const std::filesystem::path& path,
                            const std::optional<std::filesystem::path>& automaton,
                            const std::optional<std::string>& engine,
                            const std::optional<std::string>& cost_to_go,
                            std::optional<std::size_t> max_expansions) {
  scenario::JointProblemFile file;
  joint_search::JointSolution solution;
  {
    const py::gil_scoped_release release;
    joint_search::JointSearchOptions options;
    if (max_expansions) options.max_expansions = *max_expansions;
    file = read_joint(path, automaton, {.engine = engine, .cost_to_go = cost_to_go});
    try {
      solution = joint_search::solve(*file.subgraph, file.search, file.problems, options);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(path.string() + ": " + error.what());
    }
  }
  const joint_search::JointSearchResult& joint = solution.joint;
  const bool has_plan = !joint.plans.empty();
  py::dict dict;
  dict["status"] = search::to_string(joint.status);
  dict["reason"] = search::to_string(joint.reason);
  dict["cost_m2"] = cost_or_none(joint.plans);
  dict["lower_bound_m2"] = has_plan ? py::object(py::float_(joint.lower_bound)) : py::none();
  dict["alone_m2"] = cost_or_none(solution.alone);
  dict["constant_order_m2"] = cost_or_none(solution.constant_order);
  dict["best_order_m2"] = cost_or_none(solution.best_order);
  py::list plans;
  for (std::size_t i = 0; i < joint.plans.size(); ++i)
    plans.append(dict_of(file.problems[i], joint.plans[i]));
  dict["plans"] = plans;
  dict["nodes"] = joint.nodes;
  dict["expanded"] = joint.expanded;
  return dict;
}

py::dict plan_problem(const std::filesystem::path& path,
                      const std::optional<std::filesystem::path>& automaton,
                      const std::optional<std::string>& engine,
                      const std::optional<std::string>& cost_to_go,
                      std::optional<std::size_t> max_expansions) {
  scenario::ProblemFile file;
  search::SearchResult result;
  {
    const py::gil_scoped_release release;
    file = read(path, automaton,
                {.engine = engine, .cost_to_go = cost_to_go, .max_expansions = max_expansions});
    result = solve(file);
  }
  return dict_of(file.problem, result);
}

}  // namespace

void bind_problem(py::module_& module) {
  module.def("plan_problem", &plan_problem);
  module.def("plan_joint_problem", &plan_joint_problem);
}

}  // namespace hlc::python
