#pragma once

#include <filesystem>
#include <string>

#include "planner/scenario/scenario.hpp"

namespace hlc::scenario {

/// A CommonRoad file that is to be driven, and how.
struct CommonRoadImport {
  std::filesystem::path file;
  /// The scenario whose vehicle drives: its automaton, subgraph, horizon, speed and rules.
  std::filesystem::path like;
  bool from_standstill{};     ///< vehicles that move in their initial states begin standing there
  std::filesystem::path out;  ///< of the scenario
};

/// A CommonRoad file as a scenario.
struct ImportedScenario {
  std::string text;   ///< of its file (YAML)
  Scenario scenario;  ///< the same as read from that file
};

/// Most control steps of a scenario from a CommonRoad file: as many as launch_scripts/run_lab.sh
/// takes.
inline constexpr std::size_t kMostImportedSteps = 10000;

/// The CommonRoad file as a scenario (YAML): its planning problems are vehicles 1, 2, ... on open
/// routes, each to the region of a goal state (way_to_goal.hpp), its lanelets and static obstacles
/// the map, which the scenario names by its path: relative if the file lies in or beside the folder
/// of `out`. Every other key but those of places and vehicles is that of `like`. Writes no file.
///
/// The run has as many steps as end before the earliest end of the goal states' times, so that all
/// vehicles that arrive do so in time; a vehicle that has arrived stays, so that it is there also
/// at a later begin of that time.
///
/// What the scenario cannot honour is refused: as planning_problem.hpp, lanelets_for_cars.hpp,
/// map_obstacles.hpp and way_to_goal.hpp state; an initial state that moves or turns, or has a slip
/// angle, unless `from_standstill`, since vehicles begin standing; more than 30 problems; a goal
/// whose time ends within the first step, or begins after the run; what read_scenario refuses, such
/// as vehicles that overlap at their starts.
/// @throws std::runtime_error, std::invalid_argument with one line: file, place, value, bound
[[nodiscard]] ImportedScenario scenario_from_commonroad(const CommonRoadImport& import);

}  // namespace hlc::scenario
