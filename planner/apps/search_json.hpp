#pragma once

#include <cstddef>
#include <string>

#include "planner/scenario/problem_file.hpp"
#include "planner/search/recorded_search.hpp"

namespace hlc::apps {

/// Of a larger tree, so many vertices are written (search::vertices_to_show).
inline constexpr std::size_t kMostWritten = 200'000;

/// A recorded search as JSON, in m, rad and m^2; trims are numbered from 1, steps too; null: none.
///
///     status, reason, cost, lower_bound, generated, expanded   of the result
///     trims         of the plan, after each step
///     plans         numbers of plans: total, and by what ruled them out (collision, bound, open)
///     depths        [{generated, expanded, collision, bound, open, goal, least_f}, ...] from 0
///     runner_up     its place in `alternatives`, from 0
///     alternatives  [{maneuver: {trim, label}, cost, extra, status, reason, obstruction, trims},
///                   ...]: to the plan's first maneuver, or all first maneuvers without a plan
///     vertices      [{id, parent, depth, maneuver, x, y, g, f, fate, obstruction}, ...]; without
///                   parent and maneuver: the start, whose trim is the problem's
///     vertices_left_out  those that were not written
///
/// An obstruction is "boundary" or the obstacle's place in its step's list in the problem file,
/// from 0.
[[nodiscard]] std::string search_json(const scenario::ProblemFile& file,
                                      const search::RecordedSearch& recorded);

}  // namespace hlc::apps
