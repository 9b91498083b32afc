#include "planner/scenario/problem_file.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "planner/common/node.hpp"
#include "planner/common/text_file.hpp"
#include "planner/scenario/problem_parts.hpp"
#include "planner/search/search_options.hpp"

namespace hlc::scenario {
namespace {

Node read_root(const std::filesystem::path& path) {
  Node root = Node::read_json(path);
  root.check_keys({"automaton", "subgraph", "horizon_steps", "step_s", "start", "reference",
                   "contouring", "reference_speed", "obstacles", "avoided_in_motion", "corridor",
                   "avoids_steering_limit", "incumbent", "search"});
  return root;
}

ProblemFile read_rest(const Node& root, ProblemFrame frame) {
  search::HorizonProblem problem = read_problem(root, frame);
  return {.automaton_file = std::move(frame.automaton_file),
          .subgraph = std::move(frame.subgraph),
          .problem = std::move(problem),
          .search = std::move(frame.search)};
}

}  // namespace

std::string to_text(const ProblemFile& file) {
  Json root;
  write_frame({.automaton_file = file.automaton_file,
               .subgraph = file.subgraph,
               .horizon_steps = file.problem.horizon_steps()},
              root);
  write_problem(file.problem, root);
  write_search(file.search, root);
  return text_of(root);
}

void write_problem_file(const ProblemFile& file, const std::filesystem::path& path) {
  write_file(path, to_text(file));
}

ProblemFile read_problem_file(const std::filesystem::path& path,
                              const std::optional<std::filesystem::path>& automaton_file) {
  const Node root = read_root(path);
  return read_rest(root, read_frame(root, path, automaton_file));
}

ProblemFile read_problem_file(const std::filesystem::path& path,
                              std::shared_ptr<const automaton::Subgraph> subgraph) {
  const Node root = read_root(path);
  return read_rest(root, read_frame(root, path, std::move(subgraph)));
}

void check_can_be_searched(const ProblemFile& file) {
  search::check_search_options(file.search);
  if (search::needs_reference_speeds(file.search.cost_to_go) &&
      file.problem.reference_speed_mps.empty()) {
    throw std::invalid_argument(fmt::format(
        "reference_speed is missing, must be one per step: the cost-to-go {} needs them",
        search::to_string(file.search.cost_to_go)));
  }
}

}  // namespace hlc::scenario
