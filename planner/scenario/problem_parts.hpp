#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "planner/automaton/subgraph.hpp"
#include "planner/common/node.hpp"
#include "planner/search/horizon_problem.hpp"

/// The parts of which files of planning problems consist (problem_file.hpp,
/// joint_problem_file.hpp).
namespace hlc::scenario {

using Json = nlohmann::ordered_json;

/// What all vehicles of a file share: the keys automaton, subgraph, horizon_steps, step_s, search.
struct ProblemFrame {
  std::filesystem::path automaton_file;
  std::shared_ptr<const automaton::Subgraph> subgraph;
  std::size_t horizon_steps{};
  search::SearchOptions search{};
};

/// Reads the automaton, too (read_subgraph).
/// @param path            of the file, for messages and relative paths
/// @param automaton_file  instead of the one that the file names
/// @throws std::invalid_argument with one line
[[nodiscard]] ProblemFrame read_frame(const Node& root, const std::filesystem::path& path,
                                      const std::optional<std::filesystem::path>& automaton_file);
/// The same with a given subgraph, which must be the file's; the automaton is not read.
[[nodiscard]] ProblemFrame read_frame(const Node& root, const std::filesystem::path& path,
                                      std::shared_ptr<const automaton::Subgraph> subgraph);

/// The problem of one vehicle. @throws std::invalid_argument with one line
[[nodiscard]] search::HorizonProblem read_problem(const Node& node, const ProblemFrame& frame);

/// Add their keys to the object, `search` apart.
/// @throws std::invalid_argument if a number is not finite
void write_frame(const ProblemFrame& frame, Json& root);
void write_problem(const search::HorizonProblem& problem, Json& root);
void write_search(const search::SearchOptions& search, Json& root);

/// A line per key: the lists of numbers are long.
[[nodiscard]] std::string text_of(const Json& root);

}  // namespace hlc::scenario
