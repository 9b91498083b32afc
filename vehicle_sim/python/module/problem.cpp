#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

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
};

scenario::ProblemFile read(const std::filesystem::path& path,
                           const std::optional<std::filesystem::path>& automaton,
                           const SearchChoices& choices) {
  if (scenario::is_joint_problem_file(path)) {
    throw std::invalid_argument(path.string() +
                                ": a joint problem, must be of one vehicle (plan_problem of the "
                                "command line plans joint ones)");
  }
  scenario::ProblemFile file = scenario::read_problem_file(path, automaton);
  try {
    if (choices.engine) scenario::choose_engine(*choices.engine, file.search);
    if (choices.cost_to_go)
      file.search.cost_to_go = search::cost_to_go_from_name(*choices.cost_to_go);
    if (choices.max_expansions) file.search.max_expansions = *choices.max_expansions;
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

py::dict dict_of(const scenario::ProblemFile& file, const search::SearchResult& result) {
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
  dict["start"] = pose_table(std::vector<Pose>{file.problem.start}).attr("reshape")(3);
  dict["reference_m"] = point_table(file.problem.reference_m);
  py::list obstacles;
  for (const std::vector<ConvexPolygon>& step : file.problem.obstacles_m) {
    py::list areas;
    for (const ConvexPolygon& one : step) areas.append(point_table(one.vertices_m));
    obstacles.append(areas);
  }
  dict["obstacles_m"] = obstacles;
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
  return dict_of(file, result);
}

}  // namespace

void bind_problem(py::module_& module) { module.def("plan_problem", &plan_problem); }

}  // namespace hlc::python
