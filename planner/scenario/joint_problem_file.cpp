#include "planner/scenario/joint_problem_file.hpp"

#include <fmt/format.h>

#include <utility>

#include "planner/common/demand.hpp"
#include "planner/common/node.hpp"
#include "planner/common/text_file.hpp"
#include "planner/scenario/problem_parts.hpp"

namespace hlc::scenario {

std::string to_text(const JointProblemFile& file) {
  HLC_DEMAND(!file.problems.empty());
  Json root;
  write_frame({.automaton_file = file.automaton_file,
               .subgraph = file.subgraph,
               .horizon_steps = file.problems.front().horizon_steps()},
              root);
  for (const search::HorizonProblem& problem : file.problems) {
    write_problem(problem, root["vehicles"].emplace_back(Json::object()));
  }
  write_search(file.search, root);
  return text_of(root);
}

void write_joint_problem_file(const JointProblemFile& file, const std::filesystem::path& path) {
  write_file(path, to_text(file));
}

bool is_joint_problem_file(const std::filesystem::path& path) {
  return Node::read_json(path).has("vehicles");
}

JointProblemFile read_joint_problem_file(
    const std::filesystem::path& path, const std::optional<std::filesystem::path>& automaton_file) {
  const Node root = Node::read_json(path);
  root.check_keys({"automaton", "subgraph", "horizon_steps", "step_s", "vehicles", "search"});
  ProblemFrame frame = read_frame(root, path, automaton_file);
  std::vector<search::HorizonProblem> problems;
  const std::vector<Node> vehicles = root.list("vehicles");
  if (vehicles.empty() || vehicles.size() > kMostJointVehicles) {
    root.fail("vehicles", fmt::format("a list of 1 to {} vehicles", kMostJointVehicles));
  }
  for (const Node& vehicle : vehicles) {
    vehicle.check_keys({"start", "reference", "contouring", "reference_speed", "obstacles",
                        "avoided_in_motion", "corridor", "avoids_steering_limit", "incumbent"});
    problems.push_back(read_problem(vehicle, frame));
  }
  return {.automaton_file = std::move(frame.automaton_file),
          .subgraph = std::move(frame.subgraph),
          .problems = std::move(problems),
          .search = std::move(frame.search)};
}

}  // namespace hlc::scenario
