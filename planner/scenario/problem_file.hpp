#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::scenario {

/// A single planning problem as in a file: the problem, its subgraph and search options.
struct ProblemFile {
  std::filesystem::path automaton_file;
  std::shared_ptr<const automaton::Subgraph> subgraph;
  search::HorizonProblem problem;
  search::SearchOptions search;
};

/// Longest horizon of a file.
inline constexpr std::size_t kMaxProblemSteps = 64;

/// The file's text: a JSON object with these keys, in m, s, rad and the road's frame. Trims are
/// numbered from 1. Coordinates are from -1e9 to 1e9, psi from -1e6 to 1e6: see HorizonProblem.
///
///     automaton        file of an automaton or of a configuration; a relative path starts beside
///                      the JSON file
///     subgraph         name of a subgraph that the file holds
///     horizon_steps    n, 1 ... 64
///     step_s           the automaton's
///     start            {x, y, psi, trim}: pose and trim at the begin of step 1
///     reference        [[x, y], ...], one point per step
///     contouring       one [x, y] per step; may be absent: HorizonProblem::contouring
///     reference_speed  one per step, >= 0; may be absent unless the cost-to-go is 2022
///     obstacles        one list per step of convex polygons [[x, y], ...], counter-clockwise or
///                      clockwise, first vertex not repeated, area at least 1e-12 m^2; may be
///                      absent
///     corridor         [[[x1, y1], [x2, y2]], ...]: segments of the boundary; may be absent
///     avoids_steering_limit  true or false (default): see HorizonProblem
///     incumbent        [{trim, label}, ...], n maneuvers by the trim that they lead to and their
///                      label ("trim": a trim's self-loop), the first from start.trim; may be
///                      absent
///     search           {engine, cost_to_go, max_expansions, criterion_weights}, each may be
///                      absent: SearchOptions; criterion_weights: {criterion: weight in m^2 per
///                      unit}
///
/// Numbers are written so that they read back to the same bits; the order of a clockwise polygon's
/// vertices is reversed on reading, everything else is unchanged. Empty polygons, which contain no
/// point, are not written.
/// @throws std::invalid_argument if a number is not finite: JSON cannot represent it
[[nodiscard]] std::string to_text(const ProblemFile& file);

/// Writes the text to a temporary file and renames it, so that there is never a half-written file.
/// @throws std::runtime_error naming the file if it cannot be written, or as to_text
void write_problem_file(const ProblemFile& file, const std::filesystem::path& path);

/// Reads a file, its automaton (see read_subgraph) and checks it.
/// @param automaton_file  instead of the one that the file names
/// @throws std::invalid_argument with one line: file, place in the JSON, value, bound. Unknown and
/// repeated keys are refused.
[[nodiscard]] ProblemFile read_problem_file(
    const std::filesystem::path& path,
    const std::optional<std::filesystem::path>& automaton_file = std::nullopt);

/// The same with a given subgraph of the automaton: for programs that read many files. The file's
/// own `automaton` is not read, its `subgraph` must be this one.
[[nodiscard]] ProblemFile read_problem_file(const std::filesystem::path& path,
                                            std::shared_ptr<const automaton::Subgraph> subgraph);

/// @throws std::invalid_argument as check_search_options, or if that search needs data that the
/// problem lacks (reference speeds)
void check_can_be_searched(const ProblemFile& file);

}  // namespace hlc::scenario
