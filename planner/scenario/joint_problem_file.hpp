#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::scenario {

/// A joint planning problem (joint_search/joint_problem.hpp) as in a file: vehicles on one
/// subgraph.
struct JointProblemFile {
  std::filesystem::path automaton_file;
  std::shared_ptr<const automaton::Subgraph> subgraph;
  std::vector<search::HorizonProblem> problems;  ///< of each vehicle, without the others
  search::SearchOptions search;
};

inline constexpr std::size_t kMostJointVehicles = 8;

/// The file's text: as of a single problem (problem_file.hpp), but with the keys of a vehicle, that
/// is `start`, `reference`, `contouring`, `reference_speed`, `obstacles`, `corridor`,
/// `avoids_steering_limit` and `incumbent`, in a list of 1 to 8 objects:
///
///     vehicles         [{start: ..., reference: ..., ...}, ...]
///
/// @throws std::invalid_argument if a number is not finite
[[nodiscard]] std::string to_text(const JointProblemFile& file);

/// Writes the text to a temporary file and renames it.
/// @throws std::runtime_error naming the file if it cannot be written, or as to_text
void write_joint_problem_file(const JointProblemFile& file, const std::filesystem::path& path);

/// True if the file is one of a joint problem: if it has the key `vehicles`.
/// @throws std::invalid_argument if it is no JSON object
[[nodiscard]] bool is_joint_problem_file(const std::filesystem::path& path);

/// @param automaton_file  instead of the one that the file names
/// @throws std::invalid_argument as read_problem_file
[[nodiscard]] JointProblemFile read_joint_problem_file(
    const std::filesystem::path& path,
    const std::optional<std::filesystem::path>& automaton_file = std::nullopt);

}  // namespace hlc::scenario
