#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/geometry/polygon.hpp"
#include "planner/road/lanelet_map.hpp"

namespace hlc::road {

/// From `from` to `to`, both included.
struct Interval {
  double from{};
  double to{};
  friend bool operator==(const Interval&, const Interval&) = default;
};

/// One of a planning problem's goals: to be anywhere in one of its regions, at a time, speed and
/// heading of the intervals. At least one region or lanelet.
struct GoalState {
  std::vector<ConvexPolygon> areas_m;
  std::vector<LaneletId> lanelets;
  Interval time_s;
  std::optional<Interval> speed_mps;    ///< none: any
  std::optional<Interval> heading_rad;  ///< none: any; as in the file, not wrapped
  friend bool operator==(const GoalState&, const GoalState&) = default;
};

/// What one vehicle is to do: a <planningProblem> of a CommonRoad file.
struct PlanningProblem {
  int id{};
  Pose start;
  double speed_mps{};
  double yaw_rate_radps{};
  double slip_angle_rad{};
  double acceleration_mps2{};
  std::vector<GoalState> goals;  ///< alternatives, at least one
  friend bool operator==(const PlanningProblem&, const PlanningProblem&) = default;
};

/// The planning problems of a CommonRoad file, 2020a or 2018b, in the order of the file.
///
/// The initial state has an exact <position> (a point), <orientation>, <velocity> and <time>, which
/// is 0, and may have <yawRate>, <slipAngle> and <acceleration>. A goal state has a <position>, of
/// rectangles, circles (here the regular polygon within), convex polygons and lanelets by `ref`,
/// and a <time>, and may have a <velocity> and an <orientation>: exact, or from intervalStart to
/// intervalEnd. The attribute timeStepSize of the file is the unit of times.
/// @throws std::runtime_error one line, `file:line: fault and bound`: any other element in a
/// planning problem, an empty interval, a goal without position, two problems of one id, no problem
[[nodiscard]] std::vector<PlanningProblem> read_planning_problems(
    const std::filesystem::path& file);

/// The same from a text; `name` stands for the file in error messages.
[[nodiscard]] std::vector<PlanningProblem> parse_planning_problems(std::string_view xml,
                                                                   const std::string& name);

}  // namespace hlc::road
