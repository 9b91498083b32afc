#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/common/node.hpp"
#include "planner/controller/controller_options.hpp"
#include "planner/geometry/pose.hpp"
#include "planner/policy/policy_settings.hpp"
#include "planner/road/lanelet_map.hpp"
#include "planner/scenario/guest_values.hpp"
#include "planner/scenario/obstacle_values.hpp"
#include "planner/scenario/route_values.hpp"
#include "planner/scenario/strategy_values.hpp"
#include "planner/search/search_options.hpp"

namespace hlc::scenario {

/// An entry of `vehicles`.
struct VehicleValues {
  VehicleId id;
  std::string name;
  std::string route;  ///< empty with random routes, which begin in a lanelet
  road::LaneletId lanelet{};
  double start_m{};
  double start_left_m{};
  double start_turned_rad{};
  std::optional<double> reference_speed_mps{};  ///< none: the scenario's
  std::optional<ConvexPolygon> goal_m{};  ///< none: to the end of an open route, or on forever
  Node node;
};

/// `circle`.
struct CircleValues {
  std::size_t cars{};
  double radius_m{};
  Point centre_m{0.0, 0.0};
};

/// `draw`.
struct DrawValues {
  std::size_t cars{};
  std::vector<std::string> routes;  ///< none with random routes, which begin anywhere
  Node node;
};

/// The values of a scenario file, before the files that it names are read.
struct ScenarioValues {
  std::string name;
  std::filesystem::path automaton_file;
  std::string subgraph;
  std::size_t steps{};
  std::size_t horizon_steps{};
  double reference_speed_mps{};
  double contouring_weight{};
  std::optional<double> held_up_contouring_weight{};  ///< none: the same
  StrategyValues strategies{};
  coordination::PriorityRule priorities{};
  std::optional<controller::Rounds> rounds{};  ///< none: as the priorities need
  std::optional<std::string> engine{};         ///< as choose_engine takes it
  std::size_t max_expansions{};
  std::vector<search::PlanningWeight> criterion_weights{};
  bool is_reconfigurable{};
  std::map<std::string, policy::ReconfigurationSettings> policies{};
  std::string policy;
  std::optional<std::filesystem::path> lab_file{};
  std::optional<CircleValues> circle{};  ///< none: `map`, `routes`, and `vehicles` or `draw`
  std::optional<std::filesystem::path> map_file{};
  bool has_random_routes{};
  bool has_right_of_way{};
  std::vector<RouteValues> routes{};  ///< none with random routes
  std::optional<DrawValues> draw{};   ///< none: `vehicles`
  std::vector<VehicleValues> vehicles{};
  std::uint64_t seed{1};  ///< of random routes and drawn cars
  std::vector<ObstacleValues> obstacles{};
  std::vector<GuestValues> guests{};
  Node node;  ///< the whole file, for messages
};

/// Reads the values of a scenario file. Relative paths in it start at the folder of `path`.
/// @throws std::invalid_argument with one line, "file:line: key = value, must be ..."
[[nodiscard]] ScenarioValues parse_scenario(const Node& node, const std::filesystem::path& path);

}  // namespace hlc::scenario
